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
    CHECK(error_message([] { (void)fill({}, -4, 4); }) ==
          "mask size: expected 1 to 134217728 pixels, got -4x4");
}
