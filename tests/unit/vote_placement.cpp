// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/model/figure_reach.hpp"
#include "ism/vote/placement.hpp"

TEST_CASE("a placement follows from feature and occurrence by hand") {
    // Seen twice as large and turned by a quarter, from x to y: 20 px to the right is now 40 px down.
    const ism::Feature f{.x = 100, .y = 50, .scale = 6, .angle = std::numbers::pi_v<float> / 2};
    const ism::Occurrence o{.x = 20, .y = -10, .scale = 3, .angle = 0};
    const ism::Placement placed = ism::placement(f, o);
    CHECK(placed.scale == 2);
    CHECK(placed.angle == Approx(std::numbers::pi / 2));
    CHECK(placed.centre.x == Approx(100 - 20));
    CHECK(placed.centre.y == Approx(50 - 40));
}

TEST_CASE("upright features need no sine: the centre is exact") {
    const ism::Placement placed = ism::placement(ism::Feature{.x = 100, .y = 50, .scale = 6},
                                                 ism::Occurrence{.x = 20, .y = -10, .scale = 3});
    CHECK(placed.centre == ism::Point2{60, 70});
    CHECK(placed.angle == 0);
}

TEST_CASE("placement and its inverses are inverses") {
    ism::Random random(1);
    for (int trial = 0; trial < 200; ++trial) {
        const bool turned = trial % 2 == 1;
        const ism::Placement object{{random.uniform(0, 500), random.uniform(0, 400)},
                                    random.uniform(0.2, 4),
                                    turned ? random.uniform(-3, 3) : 0};
        const ism::Feature f{.x = float(random.uniform(0, 500)),
                             .y = float(random.uniform(0, 400)),
                             .scale = float(random.uniform(1, 30)),
                             .angle = turned ? float(random.uniform(-3, 3)) : 0};
        const ism::Placement back = ism::placement(f, ism::as_occurrence(f, object));
        CHECK(back.centre.x == Approx(object.centre.x).margin(1e-3));
        CHECK(back.centre.y == Approx(object.centre.y).margin(1e-3));
        CHECK(back.scale == Approx(object.scale).epsilon(1e-5));
        CHECK(back.angle == Approx(object.angle).margin(1e-5));
        const ism::Point2 pixel{random.uniform(0, 500), random.uniform(0, 400)};
        const ism::Point2 again = ism::to_image(object, ism::to_object(object, pixel));
        CHECK(again.x == Approx(pixel.x).margin(1e-9));
        CHECK(again.y == Approx(pixel.y).margin(1e-9));
    }
}

TEST_CASE("the box around a turned object holds its figure and hardly more") {
    // An L of 100 × 60 px: its left column and its bottom row.
    ism::TrainingObject object{.width = 100, .height = 60, .mask = ism::Mask(50, 30)};
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 50; ++x) object.mask(x, y) = x == 0 || y == 29 ? 255 : 100;
    object.reach = ism::figure_reach(object.mask, object.width, object.height);
    const auto of_nothing = ism::figure_reach(ism::Mask(50, 30, 100), 100, 60);
    CHECK(of_nothing[0] == Approx(50));
    CHECK(of_nothing[ism::reach_directions / 8] == Approx(80 * std::sqrt(0.5)));
    CHECK(object.reach[0] == Approx(50));
    CHECK(object.reach[ism::reach_directions / 4] == Approx(30));
    CHECK(ism::placed_box({{50, 40}, 0.5, 0}, object) == ism::box_around({50, 40}, 50, 30));
    // Turned by next to nothing it is where it is upright.
    const ism::Box upright = ism::placed_box({{50, 40}, 0.5, 0}, object),
                   turned = ism::placed_box({{50, 40}, 0.5, 1e-9}, object);
    CHECK(turned.x == Approx(upright.x));
    CHECK(turned.y == Approx(upright.y));
    CHECK(turned.width == Approx(upright.width));
    CHECK(turned.height == Approx(upright.height));
    for (int k = -40; k <= 40; ++k) {
        const ism::Placement placed{{200, 150}, 0.7, 0.2 * k};
        double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;
        for (const ism::Point2 corner :
             {ism::Point2{-50, -30}, {-48, -30}, {-50, 30}, {50, 30}, {50, 28}, {-48, 28}}) {
            const ism::Point2 at = ism::to_image(placed, corner);
            left = std::min(left, at.x), right = std::max(right, at.x);
            top = std::min(top, at.y), bottom = std::max(bottom, at.y);
        }
        const ism::Box box = ism::placed_box(placed, object);
        CAPTURE(placed.angle);
        // The box ends at edges of pixels, half beside their centres.
        CHECK(box.x == Approx(left + 0.5).margin(1.75));
        CHECK(box.y == Approx(top + 0.5).margin(1.75));
        CHECK(box.x + box.width == Approx(right + 0.5).margin(1.75));
        CHECK(box.y + box.height == Approx(bottom + 0.5).margin(1.75));
    }
}
