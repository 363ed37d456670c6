// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/detect/detect_turned.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/camera.hpp"
#include "ism/core/error.hpp"
#include "ism/core/frame.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/core/image_turn.hpp"
#include "ism/detect/detection.hpp"
#include "ism/model/calibration.hpp"

namespace {

constexpr double right_angle = std::numbers::pi / 2;

/// A bar with a bright end.
ism::Frame bar(int width, int height, const ism::Box& whole, const ism::Box& bright) {
    ism::Frame frame{.gray = ism::GrayImage(width, height)};
    for (const auto& [box, value] : {std::pair{whole, 0.5f}, std::pair{bright, 1.0f}})
        for (int y = int(box.y); y < int(box.y + box.height); ++y)
            for (int x = int(box.x); x < int(box.x + box.width); ++x) frame.gray(x, y) = value;
    return frame;
}

/// Finds bars that lie with their bright end to the left, and no others.
ism::Detections find_bar(const ism::Frame& frame) {
    ism::Segmentation part;
    part.figure = part.ground = ism::GrayImage(frame.gray.width(), frame.gray.height());
    part.mask = ism::Mask(frame.gray.width(), frame.gray.height());
    ism::Mask bright = part.mask;
    for (int y = 0; y < part.mask.height(); ++y)
        for (int x = 0; x < part.mask.width(); ++x) {
            part.mask(x, y) = frame.gray(x, y) > 0.25f, bright(x, y) = frame.gray(x, y) > 0.75f;
            part.figure(x, y) = float(part.mask(x, y)), part.ground(x, y) = 1 - part.figure(x, y);
        }
    const ism::Box box = ism::mask_box(part.mask), end = ism::mask_box(bright);
    ism::Detections found{.stats = {.hypotheses = 1}};
    found.features.push_back({.x = float(end.centre().x), .y = float(end.centre().y)});
    if (box.width < 2 * box.height || end.centre().x > box.centre().x) return found;
    ism::Detection object;
    object.score = object.probability = 1;
    object.box = box, object.centre = box.centre();
    object.segmentation = part;
    object.support.push_back({.feature = 0, .weight = 1});
    found.objects.push_back(object);
    return found;
}

}  // namespace

TEST_CASE("places of a turned image are found again, and all of the image is in it") {
    for (const double angle_rad : {0.0, 0.3, right_angle, 2.5, -0.9}) {
        CAPTURE(angle_rad);
        const ism::ImageTurn turn(60, 40, angle_rad);
        for (const ism::Point2 at : {ism::Point2{0, 0}, {59, 0}, {0, 39}, {59, 39}, {17.5, 3}}) {
            const ism::Point2 there = turn.turned(at), again = turn.back(there);
            CHECK(again.x == Approx(at.x).margin(1e-9));
            CHECK(again.y == Approx(at.y).margin(1e-9));
            CHECK((there.x > -0.6 && there.y > -0.6));
            CHECK((there.x < turn.width() - 0.4 && there.y < turn.height() - 0.4));
        }
    }
    const ism::ImageTurn turn(60, 40, right_angle);  // from x towards y: what was on the left is above
    CHECK((turn.width() == 40 && turn.height() == 60));
    CHECK(turn.turned({0, 0}).x == Approx(39));
    CHECK(turn.turned({0, 0}).y == Approx(0).margin(1e-9));
    const ism::Box box = turn.back(ism::Box{5, 10, 8, 20});
    CHECK(box.x == Approx(10));
    CHECK(box.y == Approx(40 - 5 - 8));
    CHECK(box.width == Approx(20));
    CHECK(box.height == Approx(8));
}

TEST_CASE("a frame turned by a right angle has the same pixels, and no depth beyond its edges") {
    ism::Frame frame{.gray = ism::GrayImage(30, 20),
                     .color = ism::RgbImage(30, 20),
                     .depth_m = ism::DepthMap(30, 20),
                     .camera = ism::Camera{30, 30, 15, 10}};
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 30; ++x) {
            frame.gray(x, y) = float(x) / 32 + float(y) / 1024;
            frame.color(x, y) = {std::uint8_t(x), std::uint8_t(y), 200};
            frame.depth_m(x, y) = float(1 + x + y);
        }
    const ism::Frame turned = ism::turned_frame(frame, ism::ImageTurn(30, 20, right_angle));
    CHECK(!turned.camera);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 30; ++x) {
            REQUIRE(turned.gray(19 - y, x) == Approx(frame.gray(x, y)));
            REQUIRE(turned.color(19 - y, x) == frame.color(x, y));
            REQUIRE(turned.depth_m(19 - y, x) == frame.depth_m(x, y));
        }
    const ism::Frame askew = ism::turned_frame(frame, ism::ImageTurn(30, 20, 0.5));
    CHECK(std::isnan(askew.depth_m(0, 0)));
    CHECK(ism::is_depth(askew.depth_m(askew.gray.width() / 2, askew.gray.height() / 2)));
    CHECK(askew.gray(0, 0) > 0);
}

TEST_CASE("what is only known upright is found turned, where and how it lies") {
    const ism::Box whole{40, 12, 8, 24};
    const ism::Frame frame = bar(64, 48, whole, {40, 12, 8, 6});  // bright above: turned by a quarter
    CHECK(ism::detect_turned(frame, {.turns = 1}, find_bar).objects.empty());
    const ism::Detections found = ism::detect_turned(frame, {.turns = 4}, find_bar);
    REQUIRE(found.objects.size() == 1);
    const ism::Detection& object = found.objects[0];
    CHECK(object.angle == Approx(right_angle));
    CHECK(object.box == whole);
    CHECK(object.centre == whole.centre());
    CHECK(ism::mask_area(ism::whole_mask(object.segmentation, 64, 48).view()) == 8 * 24);
    REQUIRE(object.support.size() == 1);
    const ism::Feature& feature = found.features.at(object.support[0].feature);
    CHECK(feature.x == Approx(43.5f));
    CHECK(feature.y == Approx(14.5f));
    CHECK(feature.angle == Approx(right_angle));
    CHECK(found.stats.hypotheses == 4);

    const ism::Detections half =
        ism::detect_turned(bar(64, 48, {20, 30, 24, 8}, {38, 30, 6, 8}), {.turns = 4}, find_bar);
    REQUIRE(half.objects.size() == 1);
    CHECK(std::abs(half.objects[0].angle) == Approx(2 * right_angle));
    CHECK(half.objects[0].box == ism::Box{20, 30, 24, 8});
    const ism::Detections upright =
        ism::detect_turned(bar(64, 48, {20, 30, 24, 8}, {20, 30, 6, 8}), {.turns = 4}, find_bar);
    REQUIRE(upright.objects.size() == 1);
    CHECK(upright.objects[0].angle == 0);
}

TEST_CASE("of objects at one place that are found in several turns the strongest stays") {
    const ism::Frame frame{.gray = ism::GrayImage(64, 48), .camera = ism::Camera{60, 60, 32, 24}};
    int looks = 0, cameras = 0;
    const auto found = ism::detect_turned(frame, {.turns = 12}, [&](const ism::Frame& turned) {
        const double x = (turned.gray.width() - 1) / 2.0, y = (turned.gray.height() - 1) / 2.0;
        ism::Detection middle, corner;
        middle.centre = {x, y}, middle.box = ism::box_around(middle.centre, 20, 20);
        middle.score = middle.probability = looks == 7 ? 0.9 : 0.01 * looks;
        middle.class_index = looks % 2;
        corner.box = {0, 0, 3, 3},
        corner.centre = corner.box.centre();  // beyond the edges but at right angles
        corner.score = corner.probability = looks % 3 == 0 ? 0 : 0.5;
        ++looks, cameras += turned.camera.has_value();
        return ism::Detections{.objects = {middle, corner}, .next_best = looks == 5 ? middle : corner};
    });
    CHECK(looks == 12);
    CHECK(cameras == 1);
    REQUIRE(found.objects.size() == 5);
    CHECK(found.objects[0].score == 0.9);
    CHECK(found.objects[0].class_index == 1);
    CHECK(found.objects[0].angle == Approx(7 * std::numbers::pi / 6 - 2 * std::numbers::pi));
    for (std::size_t i = 1; i < 5; ++i) CHECK(found.objects[i].score == 0);
    REQUIRE(found.next_best.has_value());
    CHECK(found.next_best->probability == 0.04);
}

TEST_CASE("of one turn, too, what is not probable enough is left out") {
    const ism::Frame frame{.gray = ism::GrayImage(64, 48)};
    const auto found = ism::detect_turned(frame, {.turns = 1, .min_probability = 0.5}, [](const ism::Frame&) {
        ism::Detection sure, unsure;
        sure.box = {0, 0, 20, 20}, sure.score = sure.probability = 0.9;
        unsure.box = {40, 20, 20, 20}, unsure.score = unsure.probability = 0.1;
        return ism::Detections{.objects = {sure, unsure}};
    });
    REQUIRE(found.objects.size() == 1);
    CHECK(found.objects[0].probability == 0.9);
    REQUIRE(found.next_best.has_value());
    CHECK(found.next_best->probability == 0.1);
}

TEST_CASE("what is told from one look is not what comes next from another") {
    const ism::Frame frame{.gray = ism::GrayImage(64, 48)};
    int looks = 0;
    const auto found =
        ism::detect_turned(frame, {.turns = 2, .min_probability = 0.5}, [&](const ism::Frame&) {
            ism::Detection object;
            object.box = {22, 14, 20, 20}, object.centre = object.box.centre();
            object.score = object.probability = looks == 0 ? 0.9 : 0.4;
            return looks++ == 0 ? ism::Detections{.objects = {object}} : ism::Detections{.next_best = object};
        });
    CHECK(found.objects.size() == 1);
    CHECK_FALSE(found.next_best.has_value());
}

TEST_CASE("what templates judged yields to what is more probable at another angle") {
    const ism::Frame frame{.gray = ism::GrayImage(64, 48)};
    // In the middle class 0 is seen upright with odds of e, class 1 upside down with e^3.
    const ism::Calibration of_templates{{{.slope = 2, .offset = 0.5}, {.slope = 2, .offset = 0.5}}};
    const auto seen = [&](double min_probability) {
        int looks = 0;
        const auto find = [&](const ism::Frame&) {
            ism::Detection object;
            object.box = {22, 14, 20, 20}, object.centre = object.box.centre();
            object.class_index = std::uint32_t(looks);
            object.box_reasons = {.look = looks == 0 ? 0.5 : 2.5, .any = 0.5, .rivals = -0.25};
            object.score = std::exp((object.box_reasons.sum() - 0.5) / 2);
            object.probability = of_templates.probability(object.class_index, object.score);
            ++looks;
            return ism::Detections{.objects = {object}};
        };
        return ism::detect_turned(frame, {.turns = 2, .min_probability = min_probability}, find,
                                  of_templates);
    };
    const ism::Detections all = seen(0);
    REQUIRE(all.objects.size() == 2);
    CHECK(all.objects[0].class_index == 1);
    CHECK(all.objects[0].box_reasons.rivals == 0);
    CHECK(all.objects[0].score == Approx(std::exp(1.25)));
    CHECK(all.objects[0].probability == Approx(1 / (1 + std::exp(-3))));
    CHECK(all.objects[1].class_index == 0);
    CHECK(all.objects[1].box_reasons.rivals == Approx(-1));  // half of what the other leads by
    CHECK(all.objects[1].score == Approx(std::exp(-0.25)));
    CHECK(all.objects[1].probability == Approx(0.5));

    const ism::Detections told = seen(0.55);
    REQUIRE(told.objects.size() == 1);
    CHECK(told.objects[0].class_index == 1);
    REQUIRE(told.next_best.has_value());
    CHECK(told.next_best->class_index == 0);
    CHECK(told.next_best->probability == Approx(0.5));
}

TEST_CASE("turns that are none are refused") {
    const ism::Frame frame{.gray = ism::GrayImage(64, 48)};
    CHECK_THROWS_AS(ism::detect_turned(frame, {.turns = 0}, find_bar), ism::Error);
    CHECK_THROWS_AS(ism::detect_turned(frame, {.turns = 361}, find_bar), ism::Error);
    CHECK_THROWS_AS(ism::detect_turned(frame, {.rivals = {.other_classes = 1.5}}, find_bar), ism::Error);
    CHECK_THROWS_AS(ism::detect_turned(frame, {.min_probability = -0.1}, find_bar), ism::Error);
    CHECK_THROWS_AS(ism::detect_turned(ism::Frame{}, {.turns = 4}, find_bar), ism::Error);
}
