// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "toy/render.hpp"

namespace toy {

/// @brief Faults of a structured-light depth camera of the Kinect's kind. Depth is measured as a disparity in
/// steps; one step at depth z is step·z² (Khoshelham & Elberink 2012: 2.85 mm at 1 m), the noise is half a
/// step.
struct DepthSensor {
    double step_per_m = 2.85e-3;     ///< metres of depth a disparity step makes at 1 m
    double noise_steps = 0.5;        ///< standard deviation of the disparity noise
    double baseline_m = 0.075;       ///< from the camera to the projector on its right
    double near_m = 0.4, far_m = 4;  ///< outside there is no reading
    double weakest_echo = 0.24;      ///< below, the pattern is lost
};

/// @brief What the depth sensor reads: millimetres, 0 = no reading. Holes are what the projector does not
/// reach (left of near things), faint and grazing surfaces, and ragged edges.
[[nodiscard]] ism::RawDepth sense_depth(const Rendering& scene, const ism::Camera& camera,
                                        const DepthSensor& sensor, std::uint32_t seed);

/// @brief Faults of a colour camera.
struct ColourSensor {
    float noise = 1.6f;      ///< standard deviation, 8-bit levels at mid grey
    float blur = 0.35f;      ///< weight of the four neighbours together, 0 … 1
    float vignette = 0.12f;  ///< darkening at the corners
};

/// @brief What the colour camera gives: exposure, blur, noise, and the screen's gamma.
[[nodiscard]] ism::RgbImage sense_colour(const Rendering& scene, float exposure, const ColourSensor& sensor,
                                         std::uint32_t seed);

}  // namespace toy
