// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "ism/core/vec3.hpp"

namespace toy {

/// @brief Three numbers: a point or direction in metres, or a linear colour (red, green, blue 0 … 1).
/// The world has x right, y away from the viewer, z up; the table is z = 0.
using Vec = ism::Vec3f;
using ism::cross;
using ism::dot;
using ism::length;
using ism::operator*;

[[nodiscard]] constexpr Vec operator*(Vec a, Vec b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
[[nodiscard]] constexpr Vec operator*(Vec a, float s) {
    return s * a;
}

/// @brief `a` with length 1; upwards where `a` has none.
[[nodiscard]] inline Vec normalised(Vec a) {
    const float l = length(a);
    return l > 0 ? a * (1 / l) : Vec{0, 0, 1};
}

/// @brief From `a` (t = 0) to `b` (t = 1), for numbers and vectors.
template <class T>
requires requires(T v, float t) {
    v* t + v* t;
}
[[nodiscard]] constexpr T mix(T a, T b, float t) {
    return a * (1 - t) + b * t;
}

/// @brief 0 below `low`, 1 above `high`, smooth between.
[[nodiscard]] inline float smooth_step(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

/// @brief Where a model stands: its axes and origin in the world.
struct Pose {
    Vec x_axis = {1, 0, 0}, y_axis = {0, 1, 0}, z_axis = {0, 0, 1}, origin = {};

    [[nodiscard]] Vec turn(Vec v) const { return x_axis * v.x + y_axis * v.y + z_axis * v.z; }
    [[nodiscard]] Vec turn_back(Vec v) const { return {dot(x_axis, v), dot(y_axis, v), dot(z_axis, v)}; }
    [[nodiscard]] Vec to_world(Vec p) const { return origin + turn(p); }
    [[nodiscard]] Vec to_local(Vec p) const { return turn_back(p - origin); }
};

/// @brief Upright at `origin`, turned by `yaw` radians around the vertical (x towards y).
[[nodiscard]] inline Pose standing(Vec origin, float yaw) {
    const float c = std::cos(yaw), s = std::sin(yaw);
    return {{c, s, 0}, {-s, c, 0}, {0, 0, 1}, origin};
}

}  // namespace toy
