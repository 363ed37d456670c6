// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "support/catch.hpp"

#include "ism/show/overlay.hpp"

using ism::Rgb;
using ism::RgbImage;

namespace {

const std::vector<std::string> both_names{"cup", "bowl"};
constexpr ism::OverlayOptions plain_options{.side_px = 200, .close_up = false};

// a 100×60 image, a detection with 20×10 figure pixels at (40, 30) in maps of 30×20 that begin at (35, 25)
RgbImage some_picture() {
    RgbImage image(100, 60);
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 100; ++x) image(x, y) = {200, std::uint8_t(x), std::uint8_t(2 * y)};
    return image;
}
ism::Detections some_detections() {
    ism::Detections detections;
    detections.features = {{.x = 45, .y = 32, .scale = 2}, {.x = 55, .y = 38, .scale = 3}};
    ism::Detection object;
    object.class_index = 1, object.score = 0.5, object.centre = {50, 35}, object.box = {40, 30, 20, 10};
    object.segmentation = {
        .x = 35, .y = 25, .figure = {30, 20, 0.1f}, .ground = {30, 20, 0.2f}, .mask = {30, 20}};
    for (int y = 5; y < 15; ++y)
        for (int x = 5; x < 25; ++x)
            object.segmentation.mask(x, y) = 1, object.segmentation.figure(x, y) = 0.8f,
                                        object.segmentation.ground(x, y) = 0;
    object.support = {
        {.feature = 0, .weight = 0.3f}, {.feature = 1, .weight = 0.1f}, {.feature = 0, .weight = 0.1f}};
    detections.objects = {object};
    return detections;
}

}  // namespace

TEST_CASE("a label that is wider than its picture loses the end of its first words") {
    const ism::Font font = ism::system_font({});
    if (font.empty()) return;
    using ism::detail::shortened_label;
    CHECK(shortened_label("car", " 93 %", font, 19, 500) == "car 93 %");
    const std::string name = "a very long n\u00e4me", rest = " 93 %";
    for (double most = font.width(name + rest, 19); most > font.width(".." + rest, 19); most -= 1) {
        const std::string label = shortened_label(name, rest, font, 19, most);
        CHECK(font.width(label, 19) <= most);
        CHECK(label.ends_with(rest));
        CHECK(font.covers(label));  // whole letters
    }
    CHECK(shortened_label("none", rest, font, 19, 1) == ".." + rest);
}

TEST_CASE("The four images show votes, both maps on one scale, and the figure untouched") {
    const RgbImage image = some_picture(), large = ism::magnified(image, 2);
    const RgbImage row = ism::draw_explanation(image, some_detections(), 0, both_names, plain_options);
    const int head = row.height() - 120, step = (row.width() - 200) / 3;
    REQUIRE(head == 0);  // without a font there are no captions
    REQUIRE(step >= 200);
    const auto panel = [&](int i, int x, int y) { return row(i * step + 2 * x, head + 2 * y); };

    CHECK(panel(1, 50, 35) == ism::heat_color(1));
    CHECK(panel(2, 50, 35) == ism::heat_color(0));
    CHECK(panel(2, 37, 27) == ism::heat_color(0.25));
    CHECK(panel(1, 5, 5) == ism::heat_color(0));
    for (int x = 43; x < 57; ++x)
        for (int y = 33; y < 37; ++y) REQUIRE(panel(3, x, y) == large(2 * x, 2 * y));
    const Rgb around = panel(3, 10, 10);
    CHECK(around.r == around.g);
    CHECK(ism::brightness(around) < ism::brightness(image(10, 10)));
    CHECK(panel(0, 5, 55) == ism::mix(large(10, 110), ism::black, 0.4));
    CHECK(panel(0, 40, 35) == ism::class_color(1));  // the box
    CHECK(row == ism::draw_explanation(image, some_detections(), 0, both_names, plain_options));
}

TEST_CASE("Large images are explained in panels that are no longer than asked for") {
    const RgbImage image = ism::magnified(some_picture(), 10);  // 1000 x 600
    ism::OverlayOptions options = plain_options;
    const RgbImage large = ism::draw_explanation(image, some_detections(), 0, both_names, options);
    options.panel_px = 250;
    const RgbImage small = ism::draw_explanation(image, some_detections(), 0, both_names, options);
    CHECK(small.height() == 150);
    const int gap = (small.width() - 4 * 250) / 3, large_gap = (large.width() - 4 * 1000) / 3;
    CHECK(gap <= 8);
    const Rgb mean = small(3 * (250 + gap) + 40, 100), one = large(3 * (1000 + large_gap) + 162, 402);
    CHECK(std::abs(int(mean.r) - int(one.r)) <= 8);  // the same place
    options.panel_px = 15;
    CHECK_THROWS_WITH(ism::draw_explanation(image, some_detections(), 0, both_names, options),
                      "OverlayOptions::panel_px: expected 16 or more pixels, got 15");
}

TEST_CASE("Cells of a template are green where they speak for the class, red where against it") {
    ism::Detections detections = some_detections();
    const RgbImage image = some_picture();
    const RgbImage four = ism::draw_explanation(image, detections, 0, both_names, plain_options);
    ism::CellShares& cells = detections.objects[0].cells;
    cells = {{2, 1, false}, detections.objects[0].box, {0.5f, -0.25f}};  // the box's left and right half
    const RgbImage five = ism::draw_explanation(image, detections, 0, both_names, plain_options);
    REQUIRE(five.width() == four.width() + (four.width() - 200) / 3);
    const auto second = [&](int x, int y) {
        return five((four.width() - 200) / 3 + 2 * x, five.height() - 120 + 2 * y);
    };
    const Rgb grey = ism::mix(ism::grey_color(ism::brightness(image(45, 35))), ism::white, 0.25);
    CHECK(second(45, 35) == ism::mix(grey, ism::detail::for_color, 0.85));
    CHECK(second(55, 35).r > second(55, 35).g);
    CHECK(second(30, 20).r == second(30, 20).g);
    ism::OverlayOptions options = plain_options;
    options.cells = false;
    CHECK(ism::draw_explanation(image, detections, 0, both_names, options) == four);
}

TEST_CASE("A close-up shows the detection and its surroundings as the whole image would") {
    const ism::Detections detections = some_detections();
    const ism::Box part = ism::detail::surroundings(detections, detections.objects[0], 100, 60, 3);
    CHECK(part.x <= 35);
    CHECK(part.y <= 22);
    CHECK(part.x + part.width >= 65);
    CHECK(part.width < 100);

    RgbImage cut(int(part.width), int(part.height));
    const RgbImage image = some_picture();
    for (int y = 0; y < cut.height(); ++y)
        for (int x = 0; x < cut.width(); ++x) cut(x, y) = image(x + int(part.x), y + int(part.y));
    const ism::Detections there =
        ism::detail::moved_to(detections, detections.objects[0], int(part.x), int(part.y));
    CHECK(ism::draw_explanation(image, detections, 0, both_names, {.side_px = 200}) ==
          ism::draw_explanation(cut, there, 0, both_names, plain_options));

    ism::Detections outside = detections;
    outside.objects[0] = {};
    outside.objects[0].centre = {500, 500}, outside.objects[0].box = {490, 490, 20, 20};
    CHECK(ism::detail::surroundings(outside, outside.objects[0], 100, 60, 3) == ism::Box{0, 0, 100, 60});
}

TEST_CASE("All detections are marked in one image, magnified so that labels can be read") {
    const RgbImage image = some_picture();
    CHECK(ism::draw_detections(image, {}, both_names, {.side_px = 640}) == ism::magnified(image, 6));
    CHECK(ism::draw_detections(image, {}, both_names, {.side_px = 50}) == image);

    ism::Detections detections = some_detections();
    detections.objects.push_back(detections.objects[0]);
    detections.objects[1].class_index = 0;
    detections.objects[1].segmentation = {};
    detections.objects[1].box = {90, 50, 30, 30};  // reaches outside
    const RgbImage all = ism::draw_detections(image, detections, both_names, plain_options);
    CHECK(all(2 * 42, 2 * 39 + 1) == ism::class_color(1));  // contour and box
    CHECK(all(2 * 50, 2 * 35) == ism::mix(ism::magnified(image, 2)(100, 70), ism::class_color(1), 0.35));
    CHECK(all(10, 10) == ism::magnified(image, 2)(10, 10));
}

TEST_CASE("Labels evade each other while there is room") {
    RgbImage image(400, 300);
    const ism::Font font = ism::system_font(both_names);  // or none: labels without words
    ism::Detection cup;
    cup.score = 0.5;
    std::vector<ism::Box> used;
    for (int i = 0; i < 4; ++i) ism::detail::draw_label(image, {100, 100, 80, 90}, cup, "cup", font, used);
    ism::detail::draw_label(image, {-50, -20, 80, 90}, cup, "cup", font, used);
    ism::detail::draw_label(image, {100, 250, 80, 40}, cup, std::string(200, 'm'), font, used);
    REQUIRE(used.size() == 6);
    for (std::size_t a = 0; a < used.size(); ++a) {
        CHECK(ism::intersection(used[a], {0, 0, 400, 300}).area() == used[a].area());
        for (std::size_t b = 0; b < a; ++b) CHECK(ism::intersection(used[a], used[b]).area() == 0);
    }
    if (font.empty()) return;
    ism::OverlayOptions options = plain_options;
    options.font = &font;
    const RgbImage picture = some_picture(),
                   bare = ism::draw_explanation(picture, some_detections(), 0, both_names, plain_options);
    CHECK(ism::draw_explanation(picture, some_detections(), 0, both_names, options).height() >
          bare.height() + 12);
    CHECK_FALSE(ism::draw_detections(picture, some_detections(), both_names, options) ==
                ism::draw_detections(picture, some_detections(), both_names, plain_options));
}

TEST_CASE("Detections without support or mask, at the edge or in the tiniest image can be shown") {
    ism::Detections bare;
    bare.objects.resize(1);
    bare.objects[0].centre = {-3, 2}, bare.objects[0].box = {-10, -10, 14, 300};
    for (const bool close_up : {false, true}) {
        const ism::OverlayOptions options{.side_px = 64, .close_up = close_up};
        CHECK_FALSE(ism::draw_explanation(some_picture(), bare, 0, both_names, options).empty());
        CHECK_FALSE(ism::draw_explanation(RgbImage(1, 1), bare, 0, both_names, options).empty());
        CHECK_FALSE(ism::draw_detections(RgbImage(1, 1), bare, both_names, options).empty());
    }
}

TEST_CASE("Overlays refuse what does not belong together") {
    const RgbImage image = some_picture();
    ism::Detections detections = some_detections();
    CHECK_THROWS_AS(ism::draw_explanation(image, detections, 1, both_names), ism::Error);
    CHECK_THROWS_AS(ism::draw_explanation(RgbImage{}, detections, 0, both_names), ism::Error);
    CHECK_THROWS_AS(ism::draw_detections(image, detections, std::span(both_names).first(1)), ism::Error);
    detections.objects[0].support[0].feature = 2;
    CHECK_THROWS_AS(ism::draw_explanation(image, detections, 0, both_names), ism::Error);
    CHECK_THROWS_AS(ism::draw_explanation(image, detections, 0, both_names, plain_options), ism::Error);
    detections = some_detections();
    detections.objects[0].segmentation.ground = ism::GrayImage(3, 3);
    CHECK_THROWS_AS(ism::draw_explanation(image, detections, 0, both_names), ism::Error);
}

TEST_CASE("a label tells the probability, or the score where that is not known") {
    const std::vector<std::string> two_names{"bowl", "cup"};
    ism::Detection object;
    object.class_index = 1, object.score = 0.4136;
    CHECK(ism::detail::label_text(object, two_names) == "cup 0.414");
    object.probability = 0.834;
    CHECK(ism::detail::label_text(object, two_names) == "cup 83 %");
    object.class_index = 2;
    CHECK_THROWS_WITH(ism::detail::label_text(object, two_names), Catch::Contains("class of a detection"));
}
