// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <vector>

#include "support/catch.hpp"
#include "support/files.hpp"

#include "ism/core/random.hpp"
#include "ism/dataset/polygon.hpp"

using ism::Mask;
using ism::Point2;
using ism::Polygon;
using ism::test::error_message;

namespace {

// How often the outline runs around the point, by the sum of the angles; odd = inside by the even-odd rule.
bool inside(const Polygon& polygon, Point2 point) {
    double turn = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point2 a{polygon[i].x - point.x, polygon[i].y - point.y};
        const Point2& next = polygon[(i + 1) % polygon.size()];
        const Point2 b{next.x - point.x, next.y - point.y};
        turn += std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
    }
    return std::lround(turn / 6.283185307179586) % 2 != 0;
}

Mask fill(const std::vector<Polygon>& polygons, int width, int height) {
    return ism::fill_polygons(polygons, width, height);
}

}  // namespace

TEST_CASE("A polygon with the corners of a box fills the box's pixels") {
    const Mask mask = fill({{{3, 4}, {5, 4}, {5, 7}, {3, 7}}}, 9, 9);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 9; ++x) CHECK(int(mask(x, y)) == int(x >= 3 && x < 5 && y >= 4 && y < 7));
    CHECK(fill({{{-5, -5}, {50, -5}, {50, 50}, {-5, 50}}}, 6, 4) == Mask(6, 4, 1));
    CHECK(fill({{{1.6, 1}, {2.4, 1}, {2.4, 3}, {1.6, 3}}}, 6, 4) == Mask(6, 4));  // no pixel's middle
}

TEST_CASE("Filled polygons agree with a test of each pixel's middle, crossing and reaching outside too") {
    ism::Random random(3);
    for (int round = 0; round < 200; ++round) {
        const int width = 5 + int(random.index(30)), height = 5 + int(random.index(30));
        std::vector<Polygon> polygons(1 + random.index(3));
        for (Polygon& polygon : polygons)
            for (std::size_t i = 0, corners = 3 + random.index(8); i < corners; ++i)
                polygon.push_back({random.uniform(-5, width + 5), random.uniform(-5, height + 5)});
        const Mask mask = fill(polygons, width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                bool expected = false;
                for (const Polygon& polygon : polygons) expected |= inside(polygon, {x + 0.5, y + 0.5});
                REQUIRE(int(mask(x, y)) == int(expected));
            }
    }
}

TEST_CASE("A pixel whose middle lies on an edge belongs to what is right of it and below") {
    // By hand: the edges run through the middles of rows and columns 2 and 4.
    const Mask square = fill({{{2.5, 2.5}, {4.5, 2.5}, {4.5, 4.5}, {2.5, 4.5}}}, 8, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) CHECK(int(square(x, y)) == int(x >= 2 && x < 4 && y >= 2 && y < 4));
    // Corners and edges of squares and diamonds through middles of pixels: the same as for points moved a
    // little to the right, and still less down. Sides of 2ⁿ halves leave no rounding.
    ism::Random random(7);
    for (int round = 0; round < 200; ++round) {
        const auto half = [&](int end) { return 0.5 * double(random.index(std::uint64_t(2 * end))); };
        const double x0 = half(16), y0 = half(16), r = 0.5 * double(1 << random.index(5));
        const Polygon shape = round % 2 == 0
                                  ? Polygon{{x0 - r, y0}, {x0, y0 - r}, {x0 + r, y0}, {x0, y0 + r}}
                                  : Polygon{{x0, y0}, {x0 + r, y0}, {x0 + r, y0 + r}, {x0, y0 + r}};
        const Mask mask = fill({shape}, 16, 16);
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x)
                REQUIRE(int(mask(x, y)) == int(inside(shape, {x + 0.5 + 1e-4, y + 0.5 + 1e-7})));
    }
}

TEST_CASE("Polygons that share an edge share no pixel and leave none out") {
    const Polygon left{{0, 0}, {3.5, 0}, {6.5, 8}, {0, 8}}, right{{3.5, 0}, {10, 0}, {10, 8}, {6.5, 8}};
    const Mask a = fill({left}, 10, 8), b = fill({right}, 10, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 10; ++x) CHECK(a(x, y) + b(x, y) == 1);
}

TEST_CASE("Polygons that are none are refused") {
    CHECK(error_message([] {
              (void)fill({{{0, 0}, {1, 1}}}, 4, 4);
          }) == "polygon: expected at least 3 corners, got 2");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(error_message([&] {
              (void)fill({{{0, 0}, {1, 1}, {nan, 2}}}, 4, 4);
          }) == "polygon corner: expected pixels up to 1e9, got nan, 2");
    CHECK(error_message([] {
              (void)fill({{{0, 0}, {1, 1}, {1, 1e300}}}, 4, 4);
          }) == "polygon corner: expected pixels up to 1e9, got 1, 1e+300");
    CHECK(fill({{{-1e9, -1e9}, {1e9, -1e9}, {1e9, 1e9}, {-1e9, 1e9}}}, 4, 4) == Mask(4, 4, 1));
    CHECK(error_message([] { (void)fill({}, -4, 4); }) ==
          "mask size: expected 1 to 134217728 pixels, sides up to 1048576, got -4x4");
}
