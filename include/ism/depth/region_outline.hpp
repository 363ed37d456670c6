// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ism/core/error.hpp"
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
/// @throws Error for a region that does not lie within the surface.
[[nodiscard]] inline RegionOutline region_outline(const Surface& surface, const RegionMask& region) {
    constexpr float concave = 0.1f;
    const int width = region.mask.width(), height = region.mask.height();
    expect(region.x >= 0 && region.y >= 0 && region.x + width <= surface.width() &&
               region.y + height <= surface.height(),
           "region_outline: region", lazy_text("within ", surface.width(), "x", surface.height()),
           lazy_text(width, "x", height, " at ", region.x, ", ", region.y));
    std::size_t outline = 0, continued = 0, hidden = 0, pairs = 0, broken = 0;
    const std::vector<std::uint8_t> no_row(std::size_t(width), 0);
    for (int j = 0; j < height; ++j) {
        const int y = region.y + j;
        const std::uint8_t* mask = region.mask.row(j).data();
        const std::uint8_t* above = j > 0 ? region.mask.row(j - 1).data() : no_row.data();
        const std::uint8_t* below = j + 1 < height ? region.mask.row(j + 1).data() : no_row.data();
        const Vec3f* points_m = surface.points_m.row(y).data() + region.x;
        const Vec3f* points_below_m = j + 1 < height ? points_m + surface.width() : points_m;
        for (int i = 0; i < width; ++i) {
            const Vec3f p = points_m[i];
            if (mask[i] == 0 || !(p.z > 0)) continue;
            const float step_m = depth_step_m(p.z);
            const bool right = i + 1 < width && mask[i + 1] != 0, left = i > 0 && mask[i - 1] != 0;
            const auto within = [&](float z) {
                if (!(z > 0)) return;
                ++pairs;
                broken += std::fabs(z - p.z) > step_m;
            };
            if (right) within(points_m[i + 1].z);
            if (below[i] != 0) within(points_below_m[i].z);
            if (right && left && above[i] != 0 && below[i] != 0) continue;
            const auto outside = [&](int u, int v) {
                if (!surface.points_m.contains(u, v) || !surface.has_point(u, v)) return;
                ++outline;
                const Vec3f q = surface.points_m(u, v), between = q - p;
                if (q.z < p.z - step_m) {
                    ++hidden;
                } else if (q.z < p.z + step_m) {
                    const Vec3f turn = surface.normals(u, v) - surface.normals(region.x + i, y);
                    continued += !(dot(turn, between) < -concave * length(between));
                }
            };
            if (!right) outside(region.x + i + 2, y);
            if (!left) outside(region.x + i - 2, y);
            if (below[i] == 0) outside(region.x + i, y + 2);
            if (above[i] == 0) outside(region.x + i, y - 2);
        }
    }
    const auto share = [](std::size_t part, std::size_t all) {
        return all > 0 ? double(part) / double(all) : 0;
    };
    return {share(continued, outline), share(hidden, outline), share(broken, pairs)};
}

}  // namespace ism
