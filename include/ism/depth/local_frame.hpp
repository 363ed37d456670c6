// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <optional>

#include "ism/core/local_frame.hpp"
#include "ism/core/rotation.hpp"
#include "ism/core/vec3.hpp"
#include "ism/depth/surface.hpp"

namespace ism {

/// @brief The frame at the place (x, y) of an image, pixels, for the direction `angle` (radians, from x
/// towards y). Depth and normal are those of the nearest pixel within 2 px that has both. None where there is
/// no such pixel, or the surface is seen at less than 6 degrees.
[[nodiscard]] inline std::optional<LocalFrame> local_frame(const Surface& surface, double x, double y,
                                                           double angle) {
    constexpr int reach = 2;
    if (!(x > -1 && y > -1 && x < surface.width() && y < surface.height())) return std::nullopt;
    const int x0 = int(std::lround(x)), y0 = int(std::lround(y));
    double nearest = reach * reach + 1e-9;
    int at_x = -1, at_y = -1;
    for (int j = y0 - reach; j <= y0 + reach; ++j)
        for (int i = x0 - reach; i <= x0 + reach; ++i) {
            const double sq_distance = (i - x) * (i - x) + (j - y) * (j - y);
            if (sq_distance < nearest && surface.normals.contains(i, j) && surface.has_normal(i, j))
                nearest = sq_distance, at_x = i, at_y = j;
        }
    if (at_x < 0) return std::nullopt;
    const Camera& camera = surface.camera;
    const Vec3f normal = surface.normals(at_x, at_y);
    const Vec3f ray = to_vec3f(back_project(camera, {x, y}, 1));
    const Vec3f along{float(std::cos(angle) / camera.fx), float(std::sin(angle) / camera.fy), 0};
    const float facing = dot(normal, ray);
    if (!(facing < -0.1f * length(ray))) return std::nullopt;
    const float depth_m = dot(normal, surface.points_m(at_x, at_y)) / facing;  // of the plane there
    const Vec3f t = normalized(along - dot(normal, along) / facing * ray);
    return LocalFrame{depth_m * ray, rotation_of_columns(t, cross(normal, t), normal)};
}

}  // namespace ism
