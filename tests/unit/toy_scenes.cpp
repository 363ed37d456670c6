// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/catch.hpp"
#include "support/files.hpp"
#include "toy/toy_set.hpp"
#include <nlohmann/json.hpp>

#include "ism/core/thread_pool.hpp"
#include "ism/dataset/coco.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/io/write_file.hpp"

using ism::test::error_message;
using ism::test::TemporaryFolder;

namespace {

/// Half of the usual picture's sides, the same field of view.
toy::ToyOptions small_picture() {
    return {.width = 320, .height = 240, .focal_px = 262.5};
}

const std::vector<toy::ToyScene>& some_scenes() {
    static const std::vector<toy::ToyScene> scenes = [] {
        std::vector<toy::ToyScene> made(6);
        ism::parallel_for(made.size(), 0, [&](std::size_t i) {
            made[i] = toy::render_cluttered(i + 1, {}, small_picture());
        });
        return made;
    }();
    return scenes;
}

/// A scene without light whose depth is depth_at(x).
template <std::invocable<int> DepthAt>
toy::Rendering flat_scene(int width, int height, DepthAt&& depth_at) {
    toy::Rendering scene{ism::Image<toy::Vec>(width, height),
                         ism::DepthMap(width, height),
                         ism::Image<float>(width, height, 1.0f),
                         ism::Image<int>(width, height, -1),
                         {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) scene.depth_m(x, y) = float(depth_at(x));
    return scene;
}

bool same(const toy::ToyScene& a, const toy::ToyScene& b) {
    const auto same_object = [](const toy::ToyObject& p, const toy::ToyObject& q) {
        return p.class_index == q.class_index && p.instance == q.instance && p.mask == q.mask &&
               p.box == q.box && p.position_m == q.position_m && p.visible == q.visible;
    };
    return a.color == b.color && a.depth_mm == b.depth_mm && a.exact_m == b.exact_m &&
           std::equal(a.objects.begin(), a.objects.end(), b.objects.begin(), b.objects.end(), same_object);
}

std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files.push_back(std::filesystem::relative(entry.path(), folder));
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace

TEST_CASE("A toy scene is the same bits for the same seed and another for another") {
    const toy::ToyScene again = toy::render_cluttered(1, {}, small_picture());
    CHECK(same(again, some_scenes()[0]));
    CHECK_FALSE(again.color == some_scenes()[1].color);
    CHECK_FALSE(again.depth_mm == some_scenes()[1].depth_mm);
    // The set's seed changes the toys themselves.
    const toy::Model first = toy::make_toy(0, 3, 1), second = toy::make_toy(0, 3, 1),
                     other = toy::make_toy(0, 3, 2);
    CHECK(first.high == second.high);
    CHECK_FALSE(first.high == other.high);
}

TEST_CASE("Every pixel of a toy's mask lies within the toy in space") {
    std::size_t objects = 0;
    for (const toy::ToyScene& scene : some_scenes())
        for (const toy::ToyObject& object : scene.objects) {
            const toy::Model model = toy::make_toy(object.class_index, object.instance, 1);
            const double radius = toy::length(model.high - model.low) / 2;
            double farthest = 0;
            for (int y = 0; y < object.mask.height(); ++y)
                for (int x = 0; x < object.mask.width(); ++x) {
                    if (object.mask(x, y) == 0) continue;
                    const ism::Point3 p =
                        ism::back_project(scene.camera, {double(x), double(y)}, scene.exact_m(x, y));
                    farthest =
                        std::max(farthest, std::hypot(p.x - object.position_m.x, p.y - object.position_m.y,
                                                      p.z - object.position_m.z));
                }
            INFO("class " << object.class_index << " instance " << object.instance);
            CHECK(farthest < radius + 0.005);
            CHECK(farthest > 0.3 * radius);
            ++objects;
        }
    CHECK(objects >= 20);
}

TEST_CASE("Boxes of toys are those of their masks and masks do not overlap") {
    for (const toy::ToyScene& scene : some_scenes()) {
        ism::Image<int> owners(scene.color.width(), scene.color.height());
        for (const toy::ToyObject& object : scene.objects) {
            CHECK(object.box == ism::mask_box(object.mask));
            CHECK(object.box.area() > 0);
            for (int y = 0; y < owners.height(); ++y)
                for (int x = 0; x < owners.width(); ++x) owners(x, y) += object.mask(x, y) != 0;
        }
        CHECK(*std::max_element(owners.pixels().begin(), owners.pixels().end()) == 1);
    }
}

TEST_CASE("A toy's position is seen inside its box where little of it is hidden") {
    std::size_t clear = 0;
    for (const toy::ToyScene& scene : some_scenes())
        for (const toy::ToyObject& object : scene.objects) {
            if (object.visible < 0.95) continue;
            const ism::Point2 seen = ism::project(scene.camera, object.position_m);
            const ism::Point2 middle = object.box.centre();
            CHECK(std::abs(seen.x - middle.x) < 0.25 * object.box.width);
            CHECK(std::abs(seen.y - middle.y) < 0.25 * object.box.height);
            ++clear;
        }
    CHECK(clear >= 8);
}

TEST_CASE("Toys of cluttered scenes differ by a factor of 2 in distance and some are partly hidden") {
    double nearest = 9, farthest = 0, least = 1;
    std::set<std::size_t> classes;
    for (const toy::ToyScene& scene : some_scenes())
        for (const toy::ToyObject& object : scene.objects) {
            nearest = std::min(nearest, object.position_m.z),
            farthest = std::max(farthest, object.position_m.z);
            least = std::min(least, object.visible);
            classes.insert(object.class_index);
            CHECK(object.visible >= 0.3);
        }
    CHECK(farthest / nearest > 1.8);
    CHECK(farthest / nearest < 2.6);
    CHECK(least < 0.8);
    CHECK(classes.size() == toy::class_names().size());
}

TEST_CASE("Toy depth has holes, and its readings lie about the exact depth") {
    for (const toy::ToyScene& scene : some_scenes()) {
        std::vector<double> errors;
        std::size_t holes = 0;
        for (int y = 0; y < scene.depth_mm.height(); ++y)
            for (int x = 0; x < scene.depth_mm.width(); ++x) {
                const double z = scene.exact_m(x, y);
                if (scene.depth_mm(x, y) == 0)
                    ++holes;
                else
                    errors.push_back(std::abs(scene.depth_mm(x, y) * 0.001 - z) / (z * z));
            }
        std::nth_element(errors.begin(), errors.begin() + std::ptrdiff_t(errors.size() / 2), errors.end());
        const double all = double(holes + errors.size());
        CHECK(double(holes) / all > 0.005);
        CHECK(double(holes) / all < 0.2);
        CHECK(errors[errors.size() / 2] < 0.003);
        CHECK(errors[errors.size() / 2] > 0.0005);
    }
}

TEST_CASE("The depth sensor's noise grows with the square of the depth and comes in steps") {
    const ism::Camera camera{525, 525, 159.5, 119.5};
    const toy::DepthSensor sensor;
    const auto deviation_mm = [&](double z) {
        const ism::RawDepth raw =
            toy::sense_depth(flat_scene(320, 240, [&](int) { return z; }), camera, sensor, 5);
        double sum = 0, count = 0, off_step = 0;
        for (const std::uint16_t mm : raw.pixels())
            if (mm != 0) {
                sum += (mm - z * 1000) * (mm - z * 1000), ++count;
                const double steps = 1000 / (sensor.step_per_m * mm);
                const double nearest = 1000 / (sensor.step_per_m * std::round(steps));
                off_step += std::abs(nearest - mm) > 0.51;
            }
        CHECK(off_step == 0);
        CHECK(count > 0.7 * 320 * 240);
        return std::sqrt(sum / count);
    };
    // Half a step of noise and rounding to whole steps: √(1/4 + 1/12) steps of 2.85 mm · z².
    const double expected_mm = std::sqrt(0.25 + 1.0 / 12) * 2.85;
    CHECK(deviation_mm(1) == Approx(expected_mm).epsilon(0.15));
    CHECK(deviation_mm(2) == Approx(4 * expected_mm).epsilon(0.15));
}

TEST_CASE("The projector's shadow lies left of a near thing and is as wide as the baseline says") {
    const ism::Camera camera{525, 525, 159.5, 119.5};
    const double near_m = 0.8, far_m = 1.6;
    const auto scene = flat_scene(320, 60, [&](int x) { return x >= 160 && x < 240 ? near_m : far_m; });
    const ism::RawDepth raw = toy::sense_depth(scene, camera, {}, 3);
    const double width = 525 * 0.075 * (1 / near_m - 1 / far_m);  // 24.6 pixels
    double holes = 0, right = 0;
    for (int y = 0; y < raw.height(); ++y)
        for (int x = 100; x < 320; ++x) (x < 200 ? holes : right) += raw(x, y) == 0;
    CHECK(holes / raw.height() == Approx(width).margin(1.5));
    CHECK(right / raw.height() < 1);
}

TEST_CASE("Two triangles of a square leave no gap and nearness is linear between their corners") {
    const toy::RasterPoint a{2.3f, 3.1f, 1}, b{40.7f, 5.2f, 2}, c{37.9f, 33.3f, 4}, d{-0.5f, 31.2f, 3};
    toy::RasterTarget target(48, 40);
    target.draw({a, b, c}, 0);
    target.draw({a, c, d}, 1);
    const auto inside = [](const toy::RasterPoint& p, const toy::RasterPoint& q, int x, int y) {
        return (double(q.x) - p.x) * (y - p.y) - (double(q.y) - p.y) * (x - p.x);
    };
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 48; ++x) {
            const double edge =
                std::min({inside(a, b, x, y), inside(b, c, x, y), inside(c, d, x, y), inside(d, a, x, y)});
            if (std::abs(edge) > 0.01) CHECK((target.triangle(x, y) >= 0) == (edge > 0));
        }
    // The plane through a, b, c.
    const double ux = b.x - a.x, uy = b.y - a.y, vx = c.x - a.x, vy = c.y - a.y;
    const double s = ((30 - a.x) * vy - (10 - a.y) * vx) / (ux * vy - uy * vx),
                 t = (ux * (10 - a.y) - uy * (30 - a.x)) / (ux * vy - uy * vx);
    REQUIRE(target.triangle(30, 10) == 0);
    CHECK(target.nearness(30, 10) == Approx(1 + s * 1 + t * 3).epsilon(1e-5));
}

TEST_CASE("A toy alone is wholly visible and half as large at twice the distance") {
    for (std::size_t c = 0; c < toy::class_names().size(); ++c) {
        const auto near = toy::render_isolated(c, 1, {.distance_m = 0.7}, small_picture());
        const auto far = toy::render_isolated(c, 1, {.distance_m = 1.4}, small_picture());
        REQUIRE(near.objects.size() == 1);
        CHECK(near.objects[0].visible == 1);
        CHECK(near.objects[0].class_index == c);
        CHECK(near.objects[0].box.width / far.objects[0].box.width == Approx(2).epsilon(0.1));
        const ism::Point3 p = near.objects[0].position_m;
        CHECK(std::hypot(p.x, p.y, p.z) == Approx(0.7).epsilon(0.001));
    }
}

TEST_CASE("A toy set is the same bytes for one thread and for two, and reads back as it was made") {
    const TemporaryFolder one, two;
    toy::ToySetOptions options{.train_cars = 2,
                               .train_others = 1,
                               .views_per_toy = 1,
                               .train_width = 160,
                               .train_height = 120,
                               .backgrounds = 1,
                               .test_scenes = 2,
                               .threads = 1,
                               .picture = small_picture()};
    const toy::ToySet set = toy::write_toy_set(one.path(), options);
    options.threads = 2;
    static_cast<void>(toy::write_toy_set(two.path(), options));
    const auto files = files_below(one.path());
    REQUIRE(files == files_below(two.path()));
    CHECK(files.size() == 2 * (5 + 1 + 2) + 2);
    for (const auto& file : files)
        CHECK(ism::read_text(one.path() / file, 1u << 26) == ism::read_text(two.path() / file, 1u << 26));

    for (const ism::Dataset* written : {&set.train, &set.test}) {
        const ism::Dataset read = ism::read_dataset(written->source);
        CHECK(read.class_names == written->class_names);
        CHECK(read.category_ids == written->category_ids);
        CHECK(read.images == written->images);
    }
    REQUIRE(set.train.images.size() == 6);
    REQUIRE(set.test.images.size() == 2);
    CHECK(set.train.images.back().objects.empty());
    CHECK(set.train.class_names == toy::class_names());
    const auto root = nlohmann::json::parse(ism::read_text(one / "test.json", 1u << 26));
    std::size_t record = 0;
    for (std::size_t i = 0; i < set.test.images.size(); ++i) {
        const ism::Frame frame = ism::read_frame(set.test.images[i]);
        REQUIRE(frame.camera.has_value());
        CHECK(frame.depth_m.width() == 320);
        REQUIRE(set.test.images[i].objects.size() == set.test_truth[i].size());
        for (std::size_t k = 0; k < set.test_truth[i].size(); ++k, ++record) {
            const auto& truth = set.test_truth[i][k];
            const auto& read = set.test.images[i].objects[k];
            CHECK(read.class_index == truth.class_index);
            CHECK(read.box == truth.box);
            CHECK(ism::read_mask(set.test.images[i], read) == truth.mask);
            CHECK(root["annotations"][record]["position_m"][2].get<double>() == truth.position_m.z);
        }
    }
    std::set<std::pair<std::size_t, int>> learnt;
    for (const auto& objects : set.train_truth)
        for (const auto& object : objects) learnt.emplace(object.class_index, object.instance);
    CHECK(learnt.size() == 5);
    for (const auto& objects : set.test_truth)
        for (const auto& object : objects) CHECK(learnt.count({object.class_index, object.instance}) == 0);
}

TEST_CASE("Toy scenes that cannot be are refused with the value at fault") {
    CHECK(error_message([] { static_cast<void>(toy::make_toy(4, 0, 1)); }) ==
          "toy class index: expected below 4, got 4");
    CHECK(error_message([] { static_cast<void>(toy::make_toy(0, -1, 1)); }) ==
          "toy instance: expected 0 or more, got -1");
    CHECK(error_message([] { static_cast<void>(toy::render_isolated(0, 0, {.distance_m = 0.1})); }) ==
          "toy view distance: expected 0.4 to 2 m, got 0.1");
    CHECK(error_message([] {
              static_cast<void>(toy::render_cluttered(1, {.least_toys = 3, .most_toys = 2}));
          }) == "number of toys: expected least 0 or more, most not below, got 3 to 2");
    CHECK(error_message([] { static_cast<void>(toy::render_cluttered(1, {}, {.width = 10})); }) ==
          "toy picture size: expected at least 64x64, got 10x480");
}
