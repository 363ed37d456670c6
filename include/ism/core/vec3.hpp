// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "ism/core/geometry.hpp"

namespace ism {

/// @brief Three numbers in the camera frame (x right, y down, z forward) as floats: a point in metres or a
/// direction. Images are made of it; single points of high precision are Point3.
struct Vec3f {
    float x = 0, y = 0, z = 0;
    [[nodiscard]] constexpr bool operator==(const Vec3f&) const = default;
};

[[nodiscard]] constexpr Vec3f operator+(Vec3f a, Vec3f b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[nodiscard]] constexpr Vec3f operator-(Vec3f a, Vec3f b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] constexpr Vec3f operator-(Vec3f a) {
    return {-a.x, -a.y, -a.z};
}
[[nodiscard]] constexpr Vec3f operator*(float s, Vec3f a) {
    return {s * a.x, s * a.y, s * a.z};
}
[[nodiscard]] constexpr float dot(Vec3f a, Vec3f b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[nodiscard]] constexpr Vec3f cross(Vec3f a, Vec3f b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] inline float length(Vec3f a) {
    return std::sqrt(dot(a, a));
}
/// @brief The direction of a vector; {0, 0, 0} stays as it is.
[[nodiscard]] inline Vec3f normalized(Vec3f a) {
    const float l = length(a);
    return l > 0 ? (1 / l) * a : a;
}

[[nodiscard]] constexpr Vec3f to_vec3f(const Point3& p) {
    return {float(p.x), float(p.y), float(p.z)};
}
[[nodiscard]] constexpr Point3 to_point3(Vec3f v) {
    return {v.x, v.y, v.z};
}

}  // namespace ism
