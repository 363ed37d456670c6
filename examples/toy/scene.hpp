// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "toy/render.hpp"
#include "toy/sensor.hpp"

#include "ism/core/camera.hpp"
#include "ism/core/geometry.hpp"

namespace toy {

/// @brief What all pictures of a set share.
struct ToyOptions {
    std::uint64_t seed = 1;         ///< of the toys: the same seed and instance give the same toy
    int width = 640, height = 480;  ///< pixels; the principal point is the middle
    double focal_px = 525;
    DepthSensor depth = {};
    ColourSensor colour = {};
};

/// @brief A toy that is seen in a scene.
struct ToyObject {
    std::size_t class_index = 0;  ///< into class_names()
    int instance = 0;             ///< which toy of its class
    ism::Mask mask;               ///< its visible pixels
    ism::Box box;                 ///< around them
    ism::Point3 position_m;       ///< the middle of the box around the whole toy, camera frame
    double visible = 1;  ///< share of its outline's area that nothing hides and the frame does not cut
};

/// @brief An RGB-D picture with all that is known about it.
struct ToyScene {
    ism::RgbImage color;
    ism::RawDepth depth_mm;  ///< as a sensor reads it; 0 = no reading
    ism::DepthMap exact_m;   ///< without the sensor's faults
    ism::Camera camera;
    std::vector<ToyObject> objects;
};

/// @brief The camera of the options.
/// @throws ism::Error where the picture is smaller than 64 × 64 or the focal length not positive.
[[nodiscard]] ism::Camera toy_camera(const ToyOptions& options);

namespace detail {

/// Which toy a Placed stands for.
struct Label {
    std::size_t class_index;
    int instance;
};

/// The middle of a model's box in the camera frame.
ism::Point3 centre_in_camera(const Placed& thing, const Viewer& viewer);

/// Renders, lets the sensors look and writes down the truth. Placed::object ≥ 0 are indices into `labels`.
ToyScene take_picture(std::span<const Placed> things, const Geometry& geometry, std::span<const Label> labels,
                      const Room& room, const Light& light, const Viewer& viewer, ShadowArea area,
                      const ToyOptions& options, std::uint64_t seed);

}  // namespace detail

}  // namespace toy
