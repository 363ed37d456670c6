// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "ism/core/random.hpp"
#include "ism/core/region_mask.hpp"
#include "ism/core/vec3.hpp"
#include "ism/depth/shape_bins.hpp"
#include "ism/depth/surface.hpp"

namespace ism {

/// @brief The shape of a region, however it is turned: pairs of random points of it, counted by their
/// distance (8 bins of `bin_m`, the last open), the agreement of their normals (cosine above .9, above .5,
/// less) and whether the surface is concave between them; as shares of the pairs, square roots, so that the
/// product of two histograms is their likeness (after surflet pairs; Wahl, Hillenbrand, Hirzinger 2003). All
/// 0 where fewer than 20 points of the region have a normal. The same region has the same histogram each
/// time.
/// @throws Error where `bin_m` is not above 0.
[[nodiscard]] inline ShapeHistogram shape_histogram(const Surface& surface, const RegionMask& region,
                                                    double bin_m) {
    constexpr std::size_t min_points = 20, max_points = 600, pairs = 4000;
    expect(std::isfinite(bin_m) && bin_m > 0, "shape histogram: bin (metres)", "a number above 0", bin_m);
    struct Place {
        Vec3f point_m, normal;
    };
    std::vector<Place> places;
    for (int j = 0; j < region.mask.height(); ++j)
        for (int i = 0; i < region.mask.width(); ++i) {
            const int x = region.x + i, y = region.y + j;
            if (region.mask(i, j) != 0 && surface.normals.contains(x, y) && surface.has_normal(x, y))
                places.push_back({surface.points_m(x, y), surface.normals(x, y)});
        }
    ShapeHistogram histogram{};
    if (places.size() < min_points) return histogram;
    Random random(1);
    const std::size_t count = std::min(places.size(), max_points);
    for (std::size_t i = 0; i < count; ++i) std::swap(places[i], places[i + random.index(places.size() - i)]);
    float counted = 0;
    for (std::size_t k = 0; k < pairs; ++k) {
        const Place &a = places[random.index(count)], &b = places[random.index(count)];
        const Vec3f between = b.point_m - a.point_m;
        const float distance = length(between);
        if (!(distance > 0.25f * float(bin_m))) continue;
        const float agreement = dot(a.normal, b.normal);
        const bool concave = dot(b.normal - a.normal, between) < -0.1f * distance;
        const std::size_t bin = std::size_t(std::min(distance / float(bin_m), 7.0f));
        ++histogram[6 * bin + (agreement > 0.9f ? 0 : agreement > 0.5f ? 1 : 2) + (concave ? 3 : 0)];
        ++counted;
    }
    if (counted > 0)
        for (float& value : histogram) value = std::sqrt(value / counted);
    return histogram;
}

}  // namespace ism
