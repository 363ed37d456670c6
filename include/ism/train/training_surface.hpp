// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/order.hpp"
#include "ism/core/random.hpp"
#include "ism/core/region_mask.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/depth/local_frame.hpp"
#include "ism/depth/surface.hpp"
#include "ism/detect/surface_scene.hpp"
#include "ism/model/occurrence_frame.hpp"
#include "ism/model/training_object.hpp"
#include "ism/train/describe_object.hpp"
#include "ism/train/training_features.hpp"

namespace ism {

/// @brief Most points of its surface that a training object keeps.
inline constexpr std::size_t max_object_points = 150;

/// @brief Adds to a training object where it lies in the camera frame, how large it is and points of its
/// surface; unchanged where the mask has no readings.
/// @param position_m  of its middle, where the label tells it
[[nodiscard]] inline TrainingObject with_points(TrainingObject object, const Box& box, const RegionMask& mask,
                                                const std::optional<Point3>& position_m,
                                                const Surface& surface) {
    std::vector<Vec3f> points;
    for (int j = 0; j < mask.mask.height(); ++j)
        for (int i = 0; i < mask.mask.width(); ++i)
            if (mask.mask(i, j) != 0 && surface.has_point(mask.x + i, mask.y + j))
                points.push_back(surface.points_m(mask.x + i, mask.y + j));
    if (points.empty()) return object;
    std::vector<float> depths;
    for (const Vec3f& point : points) depths.push_back(point.z);
    const float depth_m = detail::nth_smallest(depths, depths.size() / 2);
    object = placed_in_space(std::move(object), box, position_m, depth_m, surface.camera);
    Random random(1);
    for (std::size_t i = 0; i < std::min(max_object_points, points.size()); ++i) {
        std::swap(points[i], points[i + random.index(points.size() - i)]);
        object.points_m.push_back(points[i] - object.centre_m);
    }
    return object;
}

/// @brief How an object lies as seen from a feature of its training image.
[[nodiscard]] inline OccurrenceFrame occurrence_frame(const Feature& feature, const LocalFrame& frame,
                                                      const TrainingObject& object, const Camera& camera) {
    return {.offset_m = rotate(inverse(frame.rotation), object.centre_m - frame.point_m),
            .rotation = frame.rotation,
            .scale_m = static_cast<float>(double(feature.scale) * frame.point_m.z / camera.fx)};
}

/// @brief Which of the masks each feature is on: the first of them, or none.
[[nodiscard]] inline std::vector<std::optional<std::uint32_t>> masks_under(
    std::span<const Feature> features, std::span<const RegionMask> masks) {
    std::vector<std::optional<std::uint32_t>> under(features.size());
    for (std::size_t i = 0; i < features.size(); ++i) {
        const int x = static_cast<int>(std::lround(features[i].x)),
                  y = static_cast<int>(std::lround(features[i].y));
        for (std::uint32_t m = 0; m < masks.size() && !under[i]; ++m)
            if (contains(masks[m], x, y)) under[i] = m;
    }
    return under;
}

}  // namespace ism
