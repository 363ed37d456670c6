// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "ism/core/camera.hpp"
#include "ism/core/error.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/number_text.hpp"

/// Whether a camera and places before it fit an image: numbers in another order make no error by themselves.
namespace ism {

/// @brief What is doubtful about a camera beside images of this size, in a few words: the principal point is
/// outside the image, or the focal lengths look like a principal point. Empty where nothing is.
[[nodiscard]] inline std::string camera_doubt(const Camera& camera, int width, int height) {
    const bool inside = camera.cx >= 0 && camera.cx <= width && camera.cy >= 0 && camera.cy <= height;
    // A principal point lies near the middle; focal lengths are alike, whatever the sides of the image.
    const bool swapped = std::fabs(camera.fx - width / 2.0) < 0.1 * width &&
                         std::fabs(camera.fy - height / 2.0) < 0.1 * height &&
                         std::fabs(camera.cx - camera.cy) < 0.05 * camera.cx &&
                         (!inside || std::fabs(camera.fx - camera.fy) > 0.1 * camera.fx);
    if (inside && !swapped) return {};
    return join_text("the camera's principal point (", camera.cx, ", ", camera.cy, ") is ",
                     inside ? "not in the middle" : "outside", " of the image of ", width, "x", height,
                     " pixels", swapped ? "; are cx, cy given as fx, fy?" : "");
}

/// @brief What does not fit about the middle of a thing that a label tells; empty where it does.
/// @param readings  of depth on the object, metres
/// @param margin  how far outside its box it may be seen, in parts of the box's sides
[[nodiscard]] inline std::string position_doubt(const Point3& position_m, const Box& box,
                                                const Camera& camera, std::span<const float> readings,
                                                double margin) {
    const Point2 seen = project(camera, position_m);
    const double beside = std::max(std::fabs(seen.x - box.centre().x) / box.width,
                                   std::fabs(seen.y - box.centre().y) / box.height);
    if (!(beside <= 0.5 + margin))
        return join_text("position_m is seen at ", number_text(seen.x), ", ", number_text(seen.y),
                         ", far from the object's box");
    // The middle lies behind what is seen, by the size of the thing at most.
    const auto is_near = [&](float reading) {
        const double z = std::min(position_m.z, double(reading));
        const double size_m = std::max(box.width / camera.fx, box.height / camera.fy) * z;
        return std::fabs(position_m.z - double(reading)) <= size_m + 0.1 * z;
    };
    if (readings.empty() || std::any_of(readings.begin(), readings.end(), is_near)) return {};
    return join_text("position_m is ", number_text(position_m.z, 3),
                     " m ahead, no depth of the object is near");
}

}  // namespace ism
