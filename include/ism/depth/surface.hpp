// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include "ism/core/camera.hpp"
#include "ism/core/image.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/core/vec3.hpp"
#include "ism/depth/fitted_planes.hpp"

namespace ism {

/// @brief The surface that a depth image shows, pixel by pixel.
struct Surface {
    Camera camera;
    Image<Vec3f> points_m;  ///< in the camera frame; {0, 0, 0} where there is no reading
    Image<Vec3f> normals;   ///< of length 1, towards the camera; {0, 0, 0} where there is none

    [[nodiscard]] int width() const { return points_m.width(); }
    [[nodiscard]] int height() const { return points_m.height(); }
    [[nodiscard]] bool has_point(int x, int y) const { return points_m(x, y).z > 0; }
    [[nodiscard]] bool has_normal(int x, int y) const { return normals(x, y) != Vec3f{}; }
};

/// @brief The points and normals that a depth image shows. At each pixel a plane is fitted to the readings
/// within 5 px, every other one, whose depth is within 1.5·(.012 z + .003) m of the pixel's, at least 8 of
/// them: least squares of inverse depth 1/z = a·u + b·v + c, which is exact on planes. The normal is that of
/// the plane that fits best among those of the pixel and 4 px around it, which keeps edges sharp.
/// @param depth_m  metres; what is not is_depth() is no reading
/// @throws Error where the image is empty or the camera not as check(const Camera&) wants it.
[[nodiscard]] inline Surface surface_of(ImageView<const float> depth_m, const Camera& camera,
                                        ThreadPool& pool) {
    expect(!depth_m.empty(), "depth image size", "at least 1x1", size_text(depth_m));
    check(camera);
    const int width = depth_m.width(), height = depth_m.height();
    Surface surface{camera, Image<Vec3f>(width, height), Image<Vec3f>(width, height)};
    const detail::FittedPlanes planes(depth_m, camera, pool);
    pool.for_each(std::size_t(height), [&](std::size_t row, unsigned) {
        const int y = int(row);
        for (int x = 0; x < width; ++x)
            if (const float z = depth_m(x, y); is_depth(z))
                surface.points_m(x, y) = to_vec3f(back_project(camera, {double(x), double(y)}, z));
        for (int x = 0; x < width; x += detail::FittedPlanes::block)
            planes.normals(x, y, std::min(width - x, detail::FittedPlanes::block), &surface.normals(x, y));
    });
    return surface;
}

}  // namespace ism
