// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

namespace toy {

/// @brief Three numbers: a point or direction in metres, or a linear colour (red, green, blue 0 … 1).
/// The world has x right, y away from the viewer, z up; the table is z = 0.
struct Vec {
    float x = 0, y = 0, z = 0;
    [[nodiscard]] constexpr bool operator==(const Vec&) const = default;
};

[[nodiscard]] constexpr Vec operator+(Vec a, Vec b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[nodiscard]] constexpr Vec operator-(Vec a, Vec b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] constexpr Vec operator-(Vec a) {
    return {-a.x, -a.y, -a.z};
}
[[nodiscard]] constexpr Vec operator*(Vec a, Vec b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
[[nodiscard]] constexpr Vec operator*(Vec a, float s) {
    return {a.x * s, a.y * s, a.z * s};
}
[[nodiscard]] constexpr Vec operator*(float s, Vec a) {
    return a * s;
}
[[nodiscard]] constexpr float dot(Vec a, Vec b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[nodiscard]] constexpr Vec cross(Vec a, Vec b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] inline float length(Vec a) {
    return std::sqrt(dot(a, a));
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
