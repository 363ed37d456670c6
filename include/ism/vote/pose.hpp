// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include "ism/core/local_frame.hpp"
#include "ism/core/rotation.hpp"
#include "ism/core/vec3.hpp"
#include "ism/model/occurrence_frame.hpp"

namespace ism {

/// @brief Where an object lies in space, and how it is turned against its training image.
struct Pose {
    Vec3f centre_m = {};     ///< in the camera frame
    Rotation rotation = {};  ///< from the camera frame of the training image
};

/// @brief Where the object of an occurrence lies when its feature is seen in this local frame: the vote of
/// six degrees of freedom, C = p_f + R_f · o_i, turned by R_f · R_iᵀ.
[[nodiscard]] inline Pose pose(const LocalFrame& f, const OccurrenceFrame& o) {
    return {f.point_m + rotate(f.rotation, o.offset_m), f.rotation * inverse(o.rotation)};
}

}  // namespace ism
