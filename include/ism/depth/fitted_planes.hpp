// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "ism/core/camera.hpp"
#include "ism/core/image.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/core/vec3.hpp"

namespace ism {

/// @brief By how much depth may differ between pixels side by side of one surface, metres: a depth camera's
/// steps grow with the square of the distance.
[[nodiscard]] constexpr float depth_step_m(float depth_m) {
    return 0.012f * depth_m * depth_m + 0.003f;
}

namespace detail {

/// Numbers of pixels with a border around them, so that a window at any pixel is inside.
class BorderedImage {
public:
    static constexpr int border = 5, block = 16;  ///< a row is read in whole blocks

    BorderedImage(int width, int height, float value)
        : stride_((width + block - 1) / block * block + 2 * border),
          numbers_(std::size_t(stride_) * std::size_t(height + 2 * border), value) {}
    [[nodiscard]] float* at(int x, int y) { return numbers_.data() + offset(x, y); }
    [[nodiscard]] const float* at(int x, int y) const { return numbers_.data() + offset(x, y); }

private:
    [[nodiscard]] std::size_t offset(int x, int y) const {
        return std::size_t(y + border) * std::size_t(stride_) + std::size_t(x + border);
    }
    int stride_;
    std::vector<float> numbers_;
};

/// Planes fitted around the pixels of a depth image. All loops go along blocks of a row, for the compiler to
/// make of them what the processor has.
class FittedPlanes {
public:
    static constexpr int block = BorderedImage::block;

    FittedPlanes(ImageView<const float> depth_m, const Camera& camera, ThreadPool& pool)
        : camera_(camera),
          depth_m_(depth_m.width(), depth_m.height(), no_reading),
          inverse_depth_(depth_m.width(), depth_m.height(), 0),
          x_(depth_m.width(), depth_m.height(), 0),
          y_(x_),
          z_(x_),
          sq_residual_(depth_m.width(), depth_m.height(), no_plane) {
        pool.for_each(std::size_t(depth_m.height()), [&](std::size_t y, unsigned) {
            for (int x = 0; x < depth_m.width(); ++x)
                if (const float z = depth_m(x, int(y)); is_depth(z)) {
                    *depth_m_.at(x, int(y)) = z;
                    *inverse_depth_.at(x, int(y)) = 1 / z;
                }
        });
        pool.for_each(std::size_t(depth_m.height()), [&](std::size_t y, unsigned) {
            for (int x = 0; x < depth_m.width(); x += block)
                fit(x, int(y), std::min(block, depth_m.width() - x));
        });
    }

    /// The normals of `count` pixels of a row from (x0, y): of the planes fitted at a pixel and 4 px around
    /// it, that with the smallest residual which the pixel's point is on. So a window across an edge gives
    /// way to one beside it (Kuwahara et al. 1976).
    void normals(int x0, int y, int count, Vec3f* to) const {
        constexpr int shift = 4;
        Row x, down, z, residual, ray_x, tolerance;
        const float* depth = depth_m_.at(x0, y);
        const auto ray_y = float((y - camera_.cy) / camera_.fy);
        for (int i = 0; i < block; ++i) {
            ray_x[i] = float((x0 + i - camera_.cx) / camera_.fx);
            tolerance[i] = 0.25f * depth_step_m(depth[i]) / depth[i];
            x[i] = x_.at(x0, y)[i], down[i] = y_.at(x0, y)[i], z[i] = z_.at(x0, y)[i];
            residual[i] = sq_residual_.at(x0, y)[i];
        }
        for (int dy = -shift; dy <= shift; dy += shift)
            for (int dx = -shift; dx <= shift; dx += shift) {
                const float *ox = x_.at(x0 + dx, y + dy), *oy = y_.at(x0 + dx, y + dy);
                const float *oz = z_.at(x0 + dx, y + dy), *other = sq_residual_.at(x0 + dx, y + dy);
                for (int i = 0; i < block; ++i) {
                    const float a = ox[i], b = oy[i], c = oz[i], there = other[i];
                    const float off = std::fabs(depth[i] * (ray_x[i] * a + ray_y * b + c) - 1);
                    const bool better = std::max(there, off < tolerance[i] ? 0 : no_plane) < residual[i];
                    x[i] = better ? a : x[i], down[i] = better ? b : down[i], z[i] = better ? c : z[i];
                    residual[i] = better ? there : residual[i];
                }
            }
        for (int i = 0; i < count; ++i)
            to[i] = sq_residual_.at(x0, y)[i] < no_plane ? -normalized(Vec3f{x[i], down[i], z[i]}) : Vec3f{};
    }

private:
    using Row = float[block];
    static constexpr float no_reading = -1e30f;  ///< far from any depth
    static constexpr float no_plane = 1e30f;

    /// Least squares of 1/z = a·(column − x) + b·(row − y) + c at `count` pixels from (x0, y).
    void fit(int x0, int y, int count) {
        constexpr int reach = 5;
        static_assert(reach <= BorderedImage::border);
        const float *z = depth_m_.at(x0, y), *q = inverse_depth_.at(x0, y);
        Row tolerance, n{}, u{}, v{}, uu{}, uv{}, vv{}, s{}, su{}, sv{}, ss{};
        for (int i = 0; i < block; ++i) tolerance[i] = z[i] > 0 ? 1.5f * (0.012f * z[i] + 0.003f) : -1.0f;
        for (int dy = -reach; dy <= reach; dy += 2) {
            Row n_row{}, u_row{}, uu_row{}, s_row{}, su_row{};
            const float *z_row = depth_m_.at(x0, y + dy), *q_row = inverse_depth_.at(x0, y + dy);
            for (int dx = -reach; dx <= reach; dx += 2)
                for (int i = 0; i < block; ++i) {
                    const auto one = float(std::fabs(z_row[i + dx] - z[i]) <= tolerance[i]);
                    const float step = one * (q_row[i + dx] - q[i]);
                    n_row[i] += one, u_row[i] += float(dx) * one, uu_row[i] += float(dx * dx) * one;
                    s_row[i] += step, su_row[i] += float(dx) * step, ss[i] += step * step;
                }
            for (int i = 0; i < block; ++i) {
                n[i] += n_row[i], u[i] += u_row[i], uu[i] += uu_row[i], s[i] += s_row[i], su[i] += su_row[i];
                v[i] += float(dy) * n_row[i], uv[i] += float(dy) * u_row[i];
                vv[i] += float(dy * dy) * n_row[i], sv[i] += float(dy) * s_row[i];
            }
        }
        const auto fx = float(camera_.fx), fy = float(camera_.fy);
        for (int i = 0; i < count; ++i) {
            if (n[i] < 8) continue;
            const float a11 = uu[i] - u[i] * u[i] / n[i], a12 = uv[i] - u[i] * v[i] / n[i],
                        a22 = vv[i] - v[i] * v[i] / n[i];
            const float b1 = su[i] - s[i] * u[i] / n[i], b2 = sv[i] - s[i] * v[i] / n[i];
            const float det = a11 * a22 - a12 * a12;
            if (!(det > 1e-3f * a11 * a22 && det > 1)) continue;  // all in one line
            const float a = (b1 * a22 - b2 * a12) / det, b = (a11 * b2 - a12 * b1) / det;
            const float c = q[i] + (s[i] - a * u[i] - b * v[i]) / n[i];
            x_.at(x0, y)[i] = a * fx, y_.at(x0, y)[i] = b * fy;
            z_.at(x0, y)[i] =
                c + a * (float(camera_.cx) - float(x0 + i)) + b * (float(camera_.cy) - float(y));
            sq_residual_.at(x0, y)[i] = std::max(0.0f, ss[i] - s[i] * s[i] / n[i] - a * b1 - b * b2) / n[i];
        }
    }

    Camera camera_;
    BorderedImage depth_m_, inverse_depth_;  ///< no_reading and 0 where there is no reading
    BorderedImage x_, y_, z_;                ///< the plane of the points p with (x, y, z)·p = 1
    BorderedImage sq_residual_;              ///< the mean square of inverse depth off the plane; or no_plane
};

}  // namespace detail

}  // namespace ism
