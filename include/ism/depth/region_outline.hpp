// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "ism/core/region_mask.hpp"
#include "ism/core/vec3.hpp"
#include "ism/depth/fitted_planes.hpp"
#include "ism/depth/surface.hpp"

namespace ism {

/// @brief What is seen along the outline of a region and within it, as shares: a whole object ends where the
/// surface behind it begins, or where it rests on another; a part of one goes on.
struct RegionOutline {
    double continued = 0;  ///< of the outline: the surface goes on outside without an edge
    double hidden = 0;     ///< of the outline: something nearer begins there
    double broken = 0;     ///< of pixels side by side within: a step in depth lies between
};

/// @brief Looks along the outline of a region, at pixels two steps outside; those without a reading say
/// nothing.
[[nodiscard]] inline RegionOutline region_outline(const Surface& surface, const RegionMask& region) {
    constexpr float concave = 0.1f;
    constexpr std::array<std::array<int, 2>, 4> sides{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    std::size_t outline = 0, continued = 0, hidden = 0, pairs = 0, broken = 0;
    for (int j = 0; j < region.mask.height(); ++j)
        for (int i = 0; i < region.mask.width(); ++i) {
            const int x = region.x + i, y = region.y + j;
            if (region.mask(i, j) == 0 || !surface.has_point(x, y)) continue;
            const Vec3f p = surface.points_m(x, y);
            for (std::size_t s = 0; s < sides.size(); ++s) {
                const auto [dx, dy] = sides[s];
                if (contains(region, x + dx, y + dy)) {
                    if (s >= 2 || !surface.has_point(x + dx, y + dy)) continue;
                    ++pairs;
                    broken += std::fabs(surface.points_m(x + dx, y + dy).z - p.z) > depth_step_m(p.z);
                    continue;
                }
                const int u = x + 2 * dx, v = y + 2 * dy;
                if (!surface.points_m.contains(u, v) || !surface.has_point(u, v)) continue;
                ++outline;
                const Vec3f q = surface.points_m(u, v), between = q - p;
                if (q.z < p.z - depth_step_m(p.z)) {
                    ++hidden;
                } else if (q.z < p.z + depth_step_m(p.z)) {
                    const Vec3f turn = surface.normals(u, v) - surface.normals(x, y);
                    continued += !(dot(turn, between) < -concave * length(between));
                }
            }
        }
    const auto share = [](std::size_t part, std::size_t all) {
        return all > 0 ? double(part) / double(all) : 0;
    };
    return {share(continued, outline), share(hidden, outline), share(broken, pairs)};
}

}  // namespace ism
