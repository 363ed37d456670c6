// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/geometry.hpp"
#include "ism/core/order.hpp"
#include "ism/core/region_mask.hpp"
#include "ism/depth/supervoxels.hpp"
#include "ism/depth/surface.hpp"
#include "ism/detect/detection.hpp"
#include "ism/detect/posed_hypothesis.hpp"
#include "ism/detect/scene.hpp"

namespace ism {

namespace detail {

/// The convex hull of points, from left to right and back (Andrew 1979). One point is its own.
[[nodiscard]] inline std::vector<Point2> convex_hull(std::vector<Point2> points) {
    if (points.size() < 2) return points;
    sort_by(points, [](const Point2& p) { return rising(p.y); });
    sort_by(points, [](const Point2& p) { return rising(p.x); });
    std::vector<Point2> hull;
    const auto half = [&](auto first, auto last) {
        const std::size_t least = hull.size() + 2;
        for (; first != last; ++first) {
            const auto turns_right = [&] {
                const Point2 &a = hull[hull.size() - 2], &b = hull.back();
                return (b.x - a.x) * (first->y - a.y) - (b.y - a.y) * (first->x - a.x) <= 0;
            };
            while (hull.size() >= least && turns_right()) hull.pop_back();
            hull.push_back(*first);
        }
        hull.pop_back();
    };
    half(points.begin(), points.end());
    half(points.rbegin(), points.rend());
    return hull;
}

/// Calls visit(y, x0, x1) for the pixels x0 … x1 of each row of an image whose centres are in a convex
/// polygon.
template <class Visit>
void each_row_in(std::span<const Point2> hull, int width, int height, const Visit& visit) {
    double top = std::numeric_limits<double>::infinity(), bottom = -top;
    for (const Point2& p : hull) top = std::min(top, p.y), bottom = std::max(bottom, p.y);
    if (!(bottom >= top)) return;
    const int first = int(std::ceil(std::clamp(top, 0.0, double(height))));
    const int last = int(std::floor(std::clamp(bottom, -1.0, double(height - 1))));
    for (int y = first; y <= last; ++y) {
        double left = std::numeric_limits<double>::infinity(), right = -left;
        for (std::size_t i = 0; i < hull.size(); ++i) {
            const Point2 &a = hull[i], &b = hull[(i + 1) % hull.size()];
            if (std::min(a.y, b.y) > y || std::max(a.y, b.y) < y) continue;
            const double x = a.y == b.y ? a.x : a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
            left = std::min(left, x), right = std::max(right, x);
            if (a.y == b.y) left = std::min(left, b.x), right = std::max(right, b.x);
        }
        const int x0 = int(std::ceil(std::clamp(left, 0.0, double(width))));
        const int x1 = int(std::floor(std::clamp(right, -1.0, double(width - 1))));
        if (x0 <= x1) visit(y, x0, x1);
    }
}

}  // namespace detail

/// @brief The mask of a hypothesis of a space with poses: where the hulls of the turned training objects of
/// its heaviest votes lie, within their range of depth, decided a supervoxel at a time.
[[nodiscard]] inline RegionMask vote_mask(const Detection& hypothesis, const Supervoxels& supervoxels,
                                          const Scene& scene) {
    constexpr std::size_t votes = 5;
    constexpr float margin_m = 0.03f;
    const Surface& surface = *scene.surface;
    const ShapeModel& shapes = scene.model.shapes;
    std::vector<int> hits(supervoxels.all.size() + 1, 0);
    int cast = 0;
    for (const Support& s : std::span(hypothesis.support).first(std::min(votes, hypothesis.support.size()))) {
        const TrainingObject& object = shapes.objects[shapes.occurrence(s.occurrence).object];
        const Pose at = pose_of(s, scene);
        std::vector<Point2> seen;
        std::vector<float> depths;
        for (const Vec3f& point : object.points_m) {
            const Vec3f p = at.centre_m + rotate(at.rotation, point);
            if (!(p.z > 0.05f)) continue;
            seen.push_back(project(surface.camera, to_point3(p)));
            depths.push_back(p.z);
        }
        if (seen.size() < 3) continue;
        ++cast;
        const auto part = [&](double share) {
            return detail::nth_smallest(depths, std::size_t(share * double(depths.size() - 1)));
        };
        const float near = part(0.05) - margin_m, far = part(0.95) + margin_m;
        detail::each_row_in(detail::convex_hull(std::move(seen)), surface.width(), surface.height(),
                            [&](int y, int x0, int x1) {
                                const Vec3f* points_m = surface.points_m.row(y).data();
                                const std::int32_t* labels = supervoxels.labels.row(y).data();
                                for (int x = x0; x <= x1; ++x)
                                    if (points_m[x].z > near && points_m[x].z < far)
                                        ++hits[std::size_t(labels[x])];
                            });
    }
    Box around;
    for (std::size_t i = 0; i < supervoxels.all.size(); ++i) {
        const Supervoxel& one = supervoxels.all[i];
        if (cast == 0 || 2 * hits[i + 1] <= cast * one.pixels) {
            hits[i + 1] = 0;
            continue;
        }
        if (around.area() == 0) around = one.box;
        const double right = std::max(around.x + around.width, one.box.x + one.box.width);
        const double bottom = std::max(around.y + around.height, one.box.y + one.box.height);
        around.x = std::min(around.x, one.box.x), around.y = std::min(around.y, one.box.y);
        around.width = right - around.x, around.height = bottom - around.y;
    }
    if (around.area() == 0) return {};
    RegionMask region{int(around.x), int(around.y), Mask(int(around.width), int(around.height))};
    for (int y = 0; y < region.mask.height(); ++y)
        for (int x = 0; x < region.mask.width(); ++x) {
            const std::int32_t label = supervoxels.labels(region.x + x, region.y + y);
            region.mask(x, y) = label > 0 && hits[std::size_t(label)] > 0;
        }
    return region;
}

}  // namespace ism
