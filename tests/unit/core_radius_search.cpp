// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/radius_search.hpp"
#include "ism/core/random.hpp"

namespace {

template <std::size_t D>
using Points = std::vector<std::array<double, D>>;

template <std::size_t D>
std::vector<std::uint32_t> scanned(const Points<D>& points, const std::array<double, D>& at, double radius) {
    std::vector<std::uint32_t> found;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        double sum = 0;
        for (std::size_t k = 0; k < D; ++k) sum += (points[i][k] - at[k]) * (points[i][k] - at[k]);
        if (sum <= radius * radius) found.push_back(i);
    }
    return found;
}

template <std::size_t D>
void check_against_scan() {
    ism::Random random(D);
    for (const std::size_t count : {0, 1, 9, 256, 257, 3000}) {
        Points<D> points(count);
        for (auto& point : points)
            for (double& value : point)  // on a lattice, so that many lie at the very radius, or are equal
                value = double(random.index(12)) - 6;
        const ism::RadiusSearch<D> search(points);
        CHECK(search.size() == count);
        for (const double radius : {0.0, 1.0, 3.0, 5.0, 2.5, 1e9}) {
            std::array<double, D> at;
            for (double& value : at) value = double(random.index(12)) - 6;
            CHECK(search.within(at, radius) == scanned(points, at, radius));
        }
    }
}

}  // namespace

TEST_CASE("a radius search finds just the points that a scan finds, in their order") {
    check_against_scan<1>();
    check_against_scan<3>();
    check_against_scan<5>();
}

TEST_CASE("a radius search among equal points, moved, of nothing and of what is no number") {
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity();
    ism::RadiusSearch<2> search(Points<2>(500, {3, 4}));
    CHECK(search.within({0, 0}, 5).size() == 500);
    CHECK(search.within({0, 0}, 4.999).empty());
    CHECK(search.within({0, 0}, infinity).size() == 500);
    CHECK(search.within({nan, 0}, 5).empty());
    CHECK(search.within({0, 0}, nan).empty());
    const ism::RadiusSearch<2> moved = std::move(search);
    CHECK(moved.within({3, 4}, 0).size() == 500);
    CHECK(ism::RadiusSearch<2>().within({0, 0}, 1).empty());
    CHECK_THROWS_AS(ism::RadiusSearch<2>({{0, nan}}), ism::Error);
    CHECK_THROWS_AS(ism::RadiusSearch<2>({{infinity, 0}}), ism::Error);
}
