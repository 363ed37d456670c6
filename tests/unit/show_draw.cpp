// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <tuple>

#include "support/catch.hpp"
#include "support/painted.hpp"

#include "ism/core/random.hpp"
#include "ism/show/draw.hpp"
#include "ism/show/draw_mask.hpp"

using ism::Point2;
using ism::Rgb;
using ism::RgbImage;
using ism::test::painted;

namespace {

// how much ink is on a black image, in white pixels
double ink(const RgbImage& image) {
    double sum = 0;
    for (const Rgb c : image.pixels()) sum += c.r / 255.0;
    return sum;
}

}  // namespace

TEST_CASE("Lines and boxes along the pixels paint exactly these pixels") {
    RgbImage image(20, 10);
    ism::draw_line(image, {3, 4}, {8, 4}, {.color = ism::white});
    for (int x = 3; x <= 8; ++x) CHECK(image(x, 4) == ism::white);
    CHECK(image(10, 4) == Rgb{});
    CHECK(image(5, 3) == Rgb{});
    CHECK(image(5, 5) == Rgb{});

    RgbImage boxes(20, 10);
    ism::fill_box(boxes, {2, 3, 5, 4}, ism::white);
    CHECK(painted(boxes) == 20);
    CHECK(boxes(2, 3) == ism::white);
    CHECK(boxes(6, 6) == ism::white);

    RgbImage outline(20, 10);
    ism::draw_box(outline, {2, 3, 6, 5}, {.color = ism::white});
    CHECK(painted(outline) == 2 * 6 + 2 * 3);
    CHECK(outline(7, 7) == ism::white);
    CHECK(outline(3, 4) == Rgb{});
}

TEST_CASE("Discs, circles and slanting lines have the ink of their area") {
    const double pi = std::numbers::pi;
    RgbImage disc(100, 100), circle(100, 100), line(100, 100);
    ism::fill_disc(disc, {50.3, 49.8}, 20, ism::white);
    CHECK(ink(disc) == Approx(pi * 20 * 20).epsilon(0.005));
    ism::draw_circle(circle, {50.3, 49.8}, 30, {.color = ism::white, .width_px = 3});
    CHECK(ink(circle) == Approx(2 * pi * 30 * 3).epsilon(0.01));
    ism::draw_line(line, {10, 10}, {70, 90}, {.color = ism::white, .width_px = 4});
    CHECK(ink(line) == Approx(100 * 4 + pi * 4).epsilon(0.01));
}

TEST_CASE("A line paints every pixel near it and no other, whatever its slope") {
    ism::Random random(5);
    for (int round = 0; round < 24; ++round) {
        const Point2 a{random.uniform(-20, 60), random.uniform(-20, 60)};
        Point2 b{random.uniform(-20, 60), random.uniform(-20, 60)};
        if (round % 6 == 0) b.y = a.y;
        if (round % 6 == 1) b.x = a.x;
        if (round % 6 == 2) b = a;
        const double width = random.uniform(1, 6);
        RgbImage image(40, 40);
        ism::draw_line(image, a, b, {.color = ism::white, .width_px = width});
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 40; ++x) {
                double nearest = std::numeric_limits<double>::infinity();
                for (int i = 0; i <= 1000; ++i)
                    nearest = std::min(nearest, std::hypot(a.x + (b.x - a.x) * i / 1000 - x,
                                                           a.y + (b.y - a.y) * i / 1000 - y));
                const double cover = std::clamp(0.5 + width / 2 - nearest, 0.0, 1.0);
                REQUIRE(std::abs(image(x, y).r / 255.0 - cover) < 0.06);
            }
    }
}

TEST_CASE("Nothing is drawn outside the image, and nothing that is not finite") {
    const Rgb frame{1, 2, 3};
    RgbImage whole(60, 50, frame);
    const ism::ImageView<Rgb> part = whole.view().region(20, 15, 17, 13);
    for (int y = 0; y < part.height(); ++y)
        for (Rgb& pixel : part.row(y)) pixel = {};
    ism::Random random(8);
    const auto number = [&] {
        const std::array<double, 6> odd{1e300,
                                        -1e300,
                                        std::nan(""),
                                        std::numeric_limits<double>::infinity(),
                                        -std::numeric_limits<double>::infinity(),
                                        2e9};
        return random.uniform() < 0.2 ? odd[random.index(odd.size())] : random.uniform(-40, 60);
    };
    for (int i = 0; i < 3000; ++i) {
        const ism::Pen pen{.color = ism::white, .width_px = random.uniform(0, 9)};
        const double a = number(), b = number(), c = number(), d = number();
        ism::draw_line(part, {a, b}, {c, d}, pen);
        ism::draw_circle(part, {a, b}, c, pen);
        ism::fill_disc(part, {a, b}, c, ism::white, 0.5);
        ism::draw_box(part, {a, b, c, d}, pen);
        ism::fill_box(part, {a, b, c, d}, ism::white, 0.5);
    }
    for (int y = 0; y < whole.height(); ++y)
        for (int x = 0; x < whole.width(); ++x)
            if (x < 20 || y < 15 || x >= 37 || y >= 28) REQUIRE(whole(x, y) == frame);

    RgbImage nothing(9, 9);
    ism::draw_line(nothing, {std::nan(""), 4}, {4, 4}, {});
    ism::draw_circle(nothing, {4, 4}, std::nan(""), {});
    ism::fill_box(nothing, {1, 1, std::numeric_limits<double>::infinity(), 3}, ism::white);
    CHECK(painted(nothing) == 0);
    ism::draw_line(RgbImage{}, {0, 0}, {4, 4}, {});
}
