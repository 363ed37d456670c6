// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/core/vec3.hpp"
#include "ism/depth/supervoxel.hpp"
#include "ism/depth/surface.hpp"

namespace ism {

namespace detail {

/// Points and normals coordinate by coordinate, for loops along a row.
struct SurfaceRows {
    enum Plane { x, y, z, nx, ny, nz, without_normal, planes };
    static constexpr float far = 1e6f;  ///< a point that is in no supervoxel

    explicit SurfaceRows(const Surface& surface, ThreadPool& pool) : width_(std::size_t(surface.width())) {
        for (std::vector<float>& plane : planes_) plane.resize(width_ * std::size_t(surface.height()));
        pool.for_each(std::size_t(surface.height()), [&](std::size_t row, unsigned) {
            for (std::size_t i = 0; i < width_; ++i) {
                const Vec3f p = surface.points_m(int(i), int(row)), n = surface.normals(int(i), int(row));
                const std::size_t k = row * width_ + i;
                planes_[x][k] = p.x, planes_[y][k] = p.y, planes_[z][k] = p.z > 0 ? p.z : far;
                planes_[nx][k] = n.x, planes_[ny][k] = n.y, planes_[nz][k] = n.z;
                planes_[without_normal][k] = dot(n, n) > 0.5f ? 1.0f : 0.3f;
            }
        });
    }
    [[nodiscard]] const float* row(Plane plane, int y_px) const {
        return planes_[plane].data() + std::size_t(y_px) * width_;
    }

private:
    std::size_t width_;
    std::array<std::vector<float>, planes> planes_;
};

/// A supervoxel while it moves, or the sums of its pixels.
struct SupervoxelCentre {
    float x = 0, y = 0;  ///< pixels
    Vec3f point_m, normal;
    int pixels = 0;

    void operator+=(const SupervoxelCentre& other) {
        x += other.x, y += other.y, pixels += other.pixels;
        point_m = point_m + other.point_m, normal = normal + other.normal;
    }
    [[nodiscard]] SupervoxelCentre mean() const {
        if (pixels == 0) return {};
        const float part = 1.0f / float(pixels);
        return {part * x, part * y, part * point_m, normalized(normal), pixels};
    }
};

/// The pixel with a normal that is nearest to each point of a grid whose every other row is shifted by half a
/// step: so neighbours have neighbours in common, as squares in rows and columns have not.
[[nodiscard]] inline std::vector<SupervoxelCentre> first_centres(const Surface& surface, int step_px) {
    std::vector<SupervoxelCentre> centres;
    const int half = step_px / 2;
    bool shifted = false;
    for (int y = half; y < surface.height() + half; y += step_px, shifted = !shifted)
        for (int x = shifted ? 0 : half; x < surface.width() + half; x += step_px) {
            int nearest = 2 * half * half + 1, at_x = -1, at_y = -1;
            for (int j = std::max(0, y - half); j < std::min(surface.height(), y + half); ++j)
                for (int i = std::max(0, x - half); i < std::min(surface.width(), x + half); ++i) {
                    const int sq_distance = (i - x) * (i - x) + (j - y) * (j - y);
                    if (sq_distance < nearest && surface.has_normal(i, j))
                        nearest = sq_distance, at_x = i, at_y = j;
                }
            if (at_x >= 0)
                centres.push_back(
                    {float(at_x), float(at_y), surface.points_m(at_x, at_y), surface.normals(at_x, at_y), 1});
        }
    return centres;
}

/// Gives the pixels of the rows [top, bottom) to the nearest of the centres within a step.
inline void label_rows(const SurfaceRows& rows, const std::vector<SupervoxelCentre>& centres,
                       const SupervoxelOptions& options, int top, int bottom, Image<std::int32_t>& labels) {
    const int width = labels.width();
    const float reach = float(options.step_px);
    const float per_sq_m = 1 / float(options.size_m * options.size_m), per_sq_px = 0.5f / (reach * reach);
    const float weight = float(options.normal_weight);
    Image<float> best(width, bottom - top, 1e9f);
    for (int y = top; y < bottom; ++y) std::fill(labels.row(y).begin(), labels.row(y).end(), 0);
    for (std::size_t number = 0; number < centres.size(); ++number) {
        const SupervoxelCentre& c = centres[number];
        if (c.pixels == 0 || c.y + reach < float(top) || c.y - reach > float(bottom)) continue;
        const int left = std::max(0, int(c.x - reach)), right = std::min(width, int(c.x + reach) + 1);
        const int first = std::max(top, int(c.y - reach)), last = std::min(bottom, int(c.y + reach) + 1);
        const auto label = std::int32_t(number + 1);
        for (int y = first; y < last; ++y) {
            using R = SurfaceRows;
            const float *px = rows.row(R::x, y), *py = rows.row(R::y, y), *pz = rows.row(R::z, y);
            const float *nx = rows.row(R::nx, y), *ny = rows.row(R::ny, y), *nz = rows.row(R::nz, y);
            const float* without = rows.row(R::without_normal, y);
            float* __restrict best_row = best.row(y - top).data();
            std::int32_t* __restrict label_row = labels.row(y).data();
            const float sq_dy = (float(y) - c.y) * (float(y) - c.y);
            for (int x = left; x < right; ++x) {
                const float dx = px[x] - c.point_m.x, dy = py[x] - c.point_m.y, dz = pz[x] - c.point_m.z;
                const float off_plane = dx * c.normal.x + dy * c.normal.y + dz * c.normal.z;
                const float agreement = nx[x] * c.normal.x + ny[x] * c.normal.y + nz[x] * c.normal.z;
                const float step_x = float(x) - c.x;
                const float cost = (dx * dx + dy * dy + dz * dz + 8 * off_plane * off_plane) * per_sq_m +
                                   (step_x * step_x + sq_dy) * per_sq_px + weight * (without[x] - agreement);
                label_row[x] = cost < best_row[x] ? label : label_row[x];
                best_row[x] = cost < best_row[x] ? cost : best_row[x];
            }
        }
    }
}

/// Adds the pixels of the rows [top, bottom) to the sums of their supervoxels.
inline void add_rows(const Surface& surface, const Image<std::int32_t>& labels, int top, int bottom,
                     std::vector<SupervoxelCentre>& sums) {
    for (int y = top; y < bottom; ++y)
        for (int x = 0; x < labels.width(); ++x)
            if (const std::int32_t label = labels(x, y); label > 0)
                sums[std::size_t(label - 1)] +=
                    {float(x), float(y), surface.points_m(x, y), surface.normals(x, y), 1};
}

/// Numbers the centres that have pixels anew, and finds their boxes.
[[nodiscard]] inline std::vector<Supervoxel> number_anew(const std::vector<SupervoxelCentre>& centres,
                                                         Image<std::int32_t>& labels) {
    struct Range {
        int left = 1 << 30, top = 1 << 30, right = -1, bottom = -1;
    };
    std::vector<std::int32_t> number(centres.size() + 1);
    std::int32_t count = 0;
    for (std::size_t i = 0; i < centres.size(); ++i)
        if (centres[i].pixels > 0) number[i + 1] = ++count;
    std::vector<Range> ranges(centres.size() + 1);
    for (int y = 0; y < labels.height(); ++y)
        for (int x = 0; x < labels.width(); ++x) {
            std::int32_t& label = labels(x, y);
            Range& r = ranges[std::size_t(label)];
            r.left = std::min(r.left, x), r.right = std::max(r.right, x);
            r.top = std::min(r.top, y), r.bottom = std::max(r.bottom, y);
            label = number[std::size_t(label)];
        }
    std::vector<Supervoxel> all;
    all.reserve(std::size_t(count));
    for (std::size_t i = 0; i < centres.size(); ++i)
        if (const SupervoxelCentre& c = centres[i]; c.pixels > 0) {
            const Range& r = ranges[i + 1];
            all.push_back({c.point_m,
                           c.normal,
                           c.pixels,
                           {double(r.left), double(r.top), double(r.right - r.left + 1),
                            double(r.bottom - r.top + 1)}});
        }
    return all;
}

}  // namespace detail

}  // namespace ism
