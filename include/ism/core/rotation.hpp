// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

#include "ism/core/vec3.hpp"

namespace ism {

/// @brief A rotation as a unit quaternion w + x·i + y·j + z·k. That and its negative are the same rotation.
struct Rotation {
    float w = 1, x = 0, y = 0, z = 0;
    [[nodiscard]] constexpr bool operator==(const Rotation&) const = default;
};

/// @brief First `b`, then `a`.
[[nodiscard]] constexpr Rotation operator*(const Rotation& a, const Rotation& b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

/// @brief The rotation that takes back `r`.
[[nodiscard]] constexpr Rotation inverse(const Rotation& r) {
    return {r.w, -r.x, -r.y, -r.z};
}

/// @brief `v` turned by `r`.
[[nodiscard]] constexpr Vec3f rotate(const Rotation& r, Vec3f v) {
    const Vec3f axis{r.x, r.y, r.z}, t = 2 * cross(axis, v);
    return v + r.w * t + cross(axis, t);
}

/// @brief The same rotation with length 1 again, for products of many.
[[nodiscard]] inline Rotation normalized(const Rotation& r) {
    const float l = std::sqrt(r.w * r.w + r.x * r.x + r.y * r.y + r.z * r.z);
    return {r.w / l, r.x / l, r.y / l, r.z / l};
}

/// @brief The rotation around an axis (of any length but 0) by an angle in radians, right-handed.
[[nodiscard]] inline Rotation rotation_around(Vec3f axis, double angle) {
    const Vec3f v = float(std::sin(angle / 2)) * normalized(axis);
    return {float(std::cos(angle / 2)), v.x, v.y, v.z};
}

/// @brief What becomes of the axes x, y and z: the columns of the rotation's matrix.
[[nodiscard]] constexpr std::array<Vec3f, 3> columns(const Rotation& r) {
    return {rotate(r, {1, 0, 0}), rotate(r, {0, 1, 0}), rotate(r, {0, 0, 1})};
}

/// @brief The rotation whose matrix has the columns `a`, `b` and `c`: of length 1, at right angles, and
/// right-handed (c = a × b). The quaternion is the one with its largest number above 0, so that each rotation
/// has one form (Shepperd 1978).
[[nodiscard]] inline Rotation rotation_of_columns(Vec3f a, Vec3f b, Vec3f c) {
    const float ww = 1 + a.x + b.y + c.z, xx = 1 + a.x - b.y - c.z;
    const float yy = 1 - a.x + b.y - c.z, zz = 1 - a.x - b.y + c.z;
    if (ww >= xx && ww >= yy && ww >= zz) return normalized({ww, b.z - c.y, c.x - a.z, a.y - b.x});
    if (xx >= yy && xx >= zz) return normalized({b.z - c.y, xx, a.y + b.x, a.z + c.x});
    if (yy >= zz) return normalized({c.x - a.z, a.y + b.x, yy, b.z + c.y});
    return normalized({a.y - b.x, a.z + c.x, b.z + c.y, zz});
}

}  // namespace ism
