// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include "ism/core/rotation.hpp"
#include "ism/core/vec3.hpp"

namespace ism {

/// @brief How a training object lies as seen from a feature on it: what an occurrence knows where its
/// training image has depth. By it a feature with a local frame (LocalFrame) tells where in space, and turned
/// how, the object would be.
struct OccurrenceFrame {
    Vec3f offset_m = {};     ///< from the feature to the object's centre, in the feature's local frame
    Rotation rotation = {};  ///< R_i: the feature's local frame in the camera frame of the training image
    float scale_m = 0;       ///< s_i · z_i / f: the feature's scale as a length; 0 = no frame is known
    [[nodiscard]] bool operator==(const OccurrenceFrame&) const = default;
};

}  // namespace ism
