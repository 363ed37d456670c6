// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/train/other_ground.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/core/random.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/hog/box_template.hpp"
#include "ism/hog/hog_pyramid.hpp"
#include "ism/train/template_examples.hpp"

namespace {

ism::RgbImage filled(int width, int height, ism::Rgb color) {
    ism::RgbImage image(width, height);
    for (ism::Rgb& pixel : image.pixels()) pixel = color;
    return image;
}

/// Whose red tells the column, and green the row.
ism::RgbImage numbered(int width, int height) {
    ism::RgbImage image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image(x, y) = {std::uint8_t(x), std::uint8_t(y), 0};
    return image;
}

constexpr ism::Rgb sky{0, 0, 200};

}  // namespace

TEST_CASE("an object is cut out by its mask and put before other ground") {
    const ism::RgbImage image = filled(60, 60, sky), behind = numbered(100, 80);
    const ism::Box box{20, 10, 20, 30};
    ism::Mask mask(10, 15);  // cells of two pixels: the left half is figure
    for (int y = 0; y < 15; ++y)
        for (int x = 0; x < 5; ++x) mask(x, y) = 255;
    ism::detail::ObjectPicture object = ism::detail::turned_object(image, box, 0, 0.2);
    const ism::Box part{30, 20, double(object.picture.width()), double(object.picture.height())};
    ism::detail::put_before(object, mask, {behind, part});
    const auto at = [&](double x, double y) {  // from the corner of the box
        return object.picture(int(object.box.x + x), int(object.box.y + y));
    };
    for (const double y : {2, 15, 28}) {
        for (const double x : {2, 5, 8}) CHECK(at(x, y) == sky);
        for (const double x : {-4, 12, 16, 23}) {
            CHECK(int(at(x, y).r) == int(30 + object.box.x + x));
            CHECK(int(at(x, y).g) == int(20 + object.box.y + y));
            CHECK(int(at(x, y).b) == 0);
        }
        const int edge = at(10, y).b;  // between figure and ground both are seen
        CHECK((edge > 0 && edge < 200));
    }
    for (const double y : {-4, 33}) CHECK(int(at(5, y).b) == 0);
}

TEST_CASE("ground shows no object of the class where there is room, has its aspect and lies in its image") {
    const ism::RgbImage wide = filled(200, 100, sky);
    const ism::TemplateImage half{
        .color = wide, .labels = {{1, {0, 0, 90, 100}}, {0, {0, 0, 200, 100}}}, .proposals = {}},
        most{.color = wide, .labels = {{1, {0, 0, 180, 100}}}, .proposals = {}};
    ism::Random random(1);
    int within = 0;
    double covered = 0, covered_anywhere = 0;
    for (int k = 0; k < 100; ++k) {
        const ism::Box box = ism::detail::random_ground(half, 1, 30, 20, random).box;
        CHECK(box.width / box.height == Approx(1.5));
        CHECK(box.width >= 60 - 1e-9);
        CHECK((box.x >= 0 && box.y >= 0 && box.x + box.width <= 200 + 1e-9 &&
               box.y + box.height <= 100 + 1e-9));
        within += box.x >= 90;
        const auto covered_for = [&](std::uint32_t asked) {
            return ism::detail::covered(most, 1, ism::detail::random_ground(most, asked, 30, 20, random).box);
        };
        covered += covered_for(1) / 100, covered_anywhere += covered_for(0) / 100;
    }
    CHECK(within > 50);
    CHECK(covered < covered_anywhere - 0.05);
}

TEST_CASE("objects are examples before other grounds where their masks are known") {
    // a red block in each box, whose mask has cells of a pixel
    ism::RgbImage image = filled(120, 90, sky);
    const ism::Box box{70, 40, 40, 30};
    ism::Mask figure(40, 30);
    for (int y = 5; y < 25; ++y)
        for (int x = 5; x < 35; ++x) image(70 + x, 40 + y) = {200, 0, 0}, figure(x, y) = 255;
    const ism::TemplateImage shown{.color = image,
                                   .labels = {{0, {20, 10, 40, 30}}, {1, box}, {1, {5, 50, 40, 30}}},
                                   .proposals = {},
                                   .masks = {&figure, &figure, nullptr}};
    const ism::BoxGrid grid{.columns = 4, .rows = 3};
    const std::size_t row = grid.cells() * ism::cell_numbers;
    ism::HogPyramid pyramid;
    ism::ThreadPool pool(1);
    const auto examples = [&](ism::Rgb color, int copies) {
        const ism::RgbImage behind = filled(100, 80, color);
        const ism::TemplateImage other{.color = behind, .labels = {}, .proposals = {}};
        ism::Random random(7);
        ism::detail::TemplateExamples found;
        ism::detail::add_examples_before(std::vector{&other}, shown, 1, grid, copies, random, pyramid, pool,
                                         found);
        return found;
    };
    const auto two = examples(sky, 2);
    REQUIRE(two.plain.size() == 2 * row);
    CHECK(two.mirrored.size() == 2 * row);
    CHECK(two.negative.empty());
    CHECK(examples(sky, 0).plain.empty());
    // before ground as its own the object looks as it does, before other ground it does not
    ism::detail::TemplateExamples there;
    ism::detail::add_picture(ism::detail::turned_object(image, box, 0, ism::detail::picture_margin(grid)), 1,
                             grid, pyramid, pool, there);
    const auto difference = [&](const ism::detail::TemplateExamples& other) {
        int most = 0;
        for (std::size_t k = 0; k < row; ++k)
            most = std::max(most, std::abs(int(there.plain[k]) - int(other.plain[k])));
        return most * double(ism::detail::example_unit);
    };
    CHECK(difference(two) < 0.05);
    CHECK(difference(examples({0, 200, 0}, 1)) > 0.2);
}
