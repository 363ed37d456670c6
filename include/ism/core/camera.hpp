// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"

namespace ism {

/// @brief Stands for "no depth reading".
inline constexpr float no_depth = std::numeric_limits<float>::quiet_NaN();

/// @brief Whether a depth in metres is a reading: in front of the camera, and not so near or far, a
/// micrometre or a thousand kilometres, that it must be something else.
[[nodiscard]] constexpr bool is_depth(double depth_m) {
    return depth_m >= 1e-6 && depth_m <= 1e6;
}

/// @brief A pinhole camera without distortion: focal lengths and principal point, pixels.
struct Camera {
    double fx = 0, fy = 0, cx = 0, cy = 0;
    [[nodiscard]] constexpr bool operator==(const Camera&) const = default;
};

/// @brief Validates `camera`.
/// @throws Error where a focal length is not 1 to 10⁷ pixels or the principal point more than 10⁷ pixels away
/// from the first pixel.
inline void check(const Camera& camera) {
    constexpr double most = 1e7;
    const auto is_focal = [](double f) { return f >= 1 && f <= most; };
    const auto is_place = [](double c) { return std::fabs(c) <= most; };
    expect(is_focal(camera.fx) && is_focal(camera.fy), "camera focal lengths fx, fy (pixels)", "1 to 1e+07",
           lazy_text(camera.fx, ", ", camera.fy));
    expect(is_place(camera.cx) && is_place(camera.cy), "camera principal point cx, cy (pixels)",
           "-1e+07 to 1e+07", lazy_text(camera.cx, ", ", camera.cy));
}

/// @brief The camera of a matrix K, row by row.
/// @throws Error where it is not 0 below the diagonal, as of a transposed matrix, or does not end with 1, and
/// as check() does.
[[nodiscard]] inline Camera camera_of_matrix(const std::array<double, 9>& k) {
    expect(k[3] == 0 && k[6] == 0 && k[7] == 0, "camera matrix",
           "zeros below its diagonal (is it transposed?)", lazy_text(k[3], ", ", k[6], ", ", k[7]));
    expect(k[8] == 1, "camera matrix: its last number", 1, k[8]);
    const Camera camera{k[0], k[4], k[2], k[5]};
    check(camera);
    return camera;
}

/// @brief The point in the camera frame that is seen at `pixel` and lies `depth_m` along the optical axis.
[[nodiscard]] inline Point3 back_project(const Camera& camera, Point2 pixel, double depth_m) {
    return {(pixel.x - camera.cx) / camera.fx * depth_m, (pixel.y - camera.cy) / camera.fy * depth_m,
            depth_m};
}

/// @brief The pixel at which a point of the camera frame (metres, z > 0) is seen.
[[nodiscard]] inline Point2 project(const Camera& camera, const Point3& point_m) {
    return {camera.fx * point_m.x / point_m.z + camera.cx, camera.fy * point_m.y / point_m.z + camera.cy};
}

/// @brief A depth camera's units as metres; 0 stays 0, no reading.
/// @throws Error where `metres_per_unit` is not a positive number.
[[nodiscard]] inline DepthMap to_metres(ImageView<const std::uint16_t> raw, double metres_per_unit) {
    expect(std::isfinite(metres_per_unit) && metres_per_unit > 0, "depth scale (metres per unit)",
           "a positive number", metres_per_unit);
    DepthMap depth_m(raw.width(), raw.height());
    for (int y = 0; y < raw.height(); ++y)
        for (int x = 0; x < raw.width(); ++x) depth_m(x, y) = float(raw(x, y) * metres_per_unit);
    return depth_m;
}

}  // namespace ism
