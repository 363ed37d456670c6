// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include "ism/core/rotation.hpp"
#include "ism/core/vec3.hpp"

namespace ism {

/// @brief Where a feature is and how the surface there is turned: a point x of the frame is at
/// point_m + rotate(rotation, x) in the camera frame. Its axes are the feature's direction along the surface,
/// what is at right angles to both, and the surface's normal.
struct LocalFrame {
    Vec3f point_m;
    Rotation rotation;
};

}  // namespace ism
