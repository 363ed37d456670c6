// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/core/vec3.hpp"

namespace ism {

/// @brief How a surface is cut into supervoxels.
struct SupervoxelOptions {
    int step_px = 12;          ///< between their centres, to begin with
    double size_m = 0.02;      ///< the distance that weighs as much as one of √2 steps in the image
    double normal_weight = 4;  ///< of 1 − the cosine between normals
    int passes = 4;
};

/// @brief Validates `options`.
/// @throws Error for one out of range or NaN.
inline void check(const SupervoxelOptions& options) {
    expect(options.step_px >= 2 && options.step_px <= 1000, "SupervoxelOptions::step_px", "2 to 1000",
           options.step_px);
    expect(options.size_m >= 1e-4 && options.size_m <= 10, "SupervoxelOptions::size_m", "1e-4 to 10",
           options.size_m);
    expect(options.normal_weight >= 0 && options.normal_weight <= 1000, "SupervoxelOptions::normal_weight",
           "0 to 1000", options.normal_weight);
    expect(options.passes >= 1 && options.passes <= 100, "SupervoxelOptions::passes", "1 to 100",
           options.passes);
}

/// @brief A small piece of a surface.
struct Supervoxel {
    Vec3f point_m;   ///< the mean of its points
    Vec3f normal;    ///< the direction of the mean of its normals
    int pixels = 0;  ///< at least 1
    Box box;         ///< around its pixels
};

/// @brief An image cut into supervoxels.
struct Supervoxels {
    Image<std::int32_t> labels;  ///< 0 = none, l = number l − 1 of `all`
    std::vector<Supervoxel> all = {};
};

}  // namespace ism
