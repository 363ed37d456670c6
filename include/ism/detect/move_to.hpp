// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "ism/core/camera.hpp"
#include "ism/core/geometry.hpp"
#include "ism/detect/detection.hpp"
#include "ism/model/occurrence.hpp"

namespace ism {

/// @brief Gives a detection another box: with it centre and scale, and the position where depth and camera
/// are known.
inline void move_to(Detection& detection, const Box& box, const std::optional<Camera>& camera) {
    detection.box = box;
    detection.centre = box.centre();
    detection.scale = scale_of(box);
    if (camera && is_depth(detection.depth_m))
        detection.position_m = back_project(*camera, detection.centre, detection.depth_m);
}

}  // namespace ism
