// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "toy/light.hpp"
#include "toy/raster.hpp"

#include "ism/core/camera.hpp"

namespace toy {

/// @brief Where the camera stands in the world: its lens and the pose of its frame (x right, y down, z
/// forward).
struct Viewer {
    ism::Camera camera;
    Pose pose;
};

/// @brief A camera at `eye` that looks at `target`, turned by `roll` radians around its axis.
[[nodiscard]] Viewer look_at(const ism::Camera& camera, Vec eye, Vec target, float roll);

namespace detail {

inline constexpr int samples = 2;  ///< a pixel has samples × samples of them

struct Corner {
    Vec position, normal;  // world
};

struct Flat {
    std::array<std::uint32_t, 3> corners;
    std::uint32_t thing, part;
};

struct Geometry {
    std::vector<Corner> corners;
    std::vector<Flat> triangles;
    RasterTarget seen;
    std::vector<double> visible;
};

/// Draws all things, 2 × 2 samples a pixel: enough to know what is hidden.
Geometry draw(std::span<const Placed> things, const Viewer& viewer, int width, int height);

}  // namespace detail

}  // namespace toy
