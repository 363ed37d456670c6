// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "toy/draw.hpp"
#include "toy/room.hpp"

namespace toy {

/// @brief A picture before the sensors add their faults. All images have one size.
struct Rendering {
    ism::Image<Vec> light;   ///< linear colour
    ism::DepthMap depth_m;   ///< exact, along the optical axis
    ism::Image<float> echo;  ///< how well an infra-red pattern comes back, 0 … 1
    ism::Image<int> object;  ///< Placed::object of what fills most of the pixel; −1 = table or wall, other
                             ///< things as given
    std::vector<double> visible;  ///< for each thing: seen samples / samples seen if it were alone
};

/// @brief Lights and paints `things` on the table of `room` as `viewer` sees them; `g` is what draw() made of
/// the same things.
[[nodiscard]] Rendering render(std::span<const Placed> things, const detail::Geometry& g, const Room& room,
                               const Light& light, const Viewer& viewer, ShadowArea area, int width,
                               int height);

}  // namespace toy
