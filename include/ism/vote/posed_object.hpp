// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "ism/core/camera.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/vec3.hpp"
#include "ism/feature/feature.hpp"
#include "ism/model/training_object.hpp"
#include "ism/vote/placement.hpp"
#include "ism/vote/pose.hpp"

namespace ism {

/// @brief The box in the image of points of an object (TrainingObject::points_m) that lies so, pixels;
/// without area where none is in front of the camera.
[[nodiscard]] inline Box posed_box(const Pose& pose, std::span<const Vec3f> points_m, const Camera& camera) {
    double left = std::numeric_limits<double>::infinity(), top = left, right = -left, bottom = -left;
    for (const Vec3f& point : points_m) {
        const Vec3f at = pose.centre_m + rotate(pose.rotation, point);
        if (!(at.z > 0.05f)) continue;
        const Point2 seen = project(camera, {at.x, at.y, at.z});
        left = std::min(left, seen.x), right = std::max(right, seen.x);
        top = std::min(top, seen.y), bottom = std::max(bottom, seen.y);
    }
    if (!(right >= left)) return {};
    return {left, top, right - left + 1, bottom - top + 1};
}

/// @brief Where an object that lies so in space lies in the image: its centre, and its scale by its distance.
/// Its turn in the image is not told.
[[nodiscard]] inline Placement placement(const Pose& pose, const TrainingObject& object,
                                         const Camera& camera) {
    const Vec3f& c = pose.centre_m;
    return {project(camera, {c.x, c.y, c.z}), object.size_m * camera.fx / c.z / reference_size_px, 0};
}

/// @brief Where the object of an occurrence lies in space; nothing where the frame of the feature is not
/// known, or where the feature is longer or shorter than that of training by more than a ratio.
[[nodiscard]] inline std::optional<Pose> posed(const Feature& feature, const std::optional<LocalFrame>& frame,
                                               const OccurrenceFrame& occurrence, const Camera& camera,
                                               double max_ratio) {
    if (!frame || !(occurrence.scale_m > 0)) return {};
    const double scale_m = double(feature.scale) * frame->point_m.z / camera.fx;
    const double ratio = scale_m / double(occurrence.scale_m);
    if (!(ratio <= max_ratio && ratio >= 1 / max_ratio)) return {};
    const Pose at = pose(*frame, occurrence);
    if (!(at.centre_m.z > 0.05f)) return {};
    return at;
}

}  // namespace ism
