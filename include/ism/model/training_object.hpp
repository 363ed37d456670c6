// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ism/core/image.hpp"
#include "ism/core/vec3.hpp"

namespace ism {

/// @brief Pixels of the reference size that one cell of a stored object mask covers, along each side.
inline constexpr double mask_cell_px = 2;

/// @brief In so many directions it is known how far a training object reaches, evenly from x over y around.
inline constexpr std::size_t reach_directions = 64;

/// @brief A training object at the reference size. The mask patch of an occurrence is the part of its
/// object's mask around the occurrence.
struct TrainingObject {
    std::uint32_t class_index = 0;
    float width = 0, height = 0;  ///< of its box, pixels at the reference size; the centre is the box's
    float size_px = 0;            ///< root of its box's area in the training image
    Mask mask = {};               ///< the box in cells of mask_cell_px: share of figure, 0 … 255
    std::string image = {};       ///< name of the training image, to tell why something was found
    std::array<float, reach_directions> reach = {};  ///< of its figure from the centre: figure_reach()
    float size_m = 0;     ///< root of its box's area as a length at centre_m; 0 = not known
    Vec3f centre_m = {};  ///< in the camera frame of its image, as its label tells it, else the box's centre
                          ///< at the mask's median depth; (0, 0, 0) = not known
    std::vector<Vec3f> points_m = {};  ///< of its surface, as far as it was seen, from its centre_m
};

/// @brief Share of figure, 0 … 1, of a training object at (x, y) from its centre, pixels at the reference
/// size; between cells interpolated, 0 outside its box.
[[nodiscard]] inline float figure_share(const TrainingObject& object, float x, float y) {
    const Mask& mask = object.mask;
    const float column = (x / object.width + 0.5f) * static_cast<float>(mask.width()) - 0.5f;
    const float row = (y / object.height + 0.5f) * static_cast<float>(mask.height()) - 0.5f;
    const float c0 = std::floor(column), r0 = std::floor(row);
    if (!(c0 >= -1 && r0 >= -1 && c0 < static_cast<float>(mask.width()) &&
          r0 < static_cast<float>(mask.height())))
        return 0;
    const int c = static_cast<int>(c0), r = static_cast<int>(r0);
    const float ac = column - c0, ar = row - r0;
    const auto at = [&](int i, int j) { return mask.contains(i, j) ? static_cast<float>(mask(i, j)) : 0.0f; };
    return ((1 - ar) * ((1 - ac) * at(c, r) + ac * at(c + 1, r)) +
            ar * ((1 - ac) * at(c, r + 1) + ac * at(c + 1, r + 1))) /
           255.0f;
}

}  // namespace ism
