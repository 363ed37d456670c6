// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

#include "ism/core/camera.hpp"
#include "ism/core/geometry.hpp"

namespace ism {

/// @brief The size every training object is brought to, pixels: the root of its box's area. Scale 1 in the
/// vote spaces means an object of this size, whatever size it had in its training image (Zhang and Kjellström
/// scale their training images to one width).
inline constexpr double reference_size_px = 200;

/// @brief How many pixels of an image an object with this box has for each of the reference size.
[[nodiscard]] inline double scale_of(const Box& box) {
    return std::sqrt(box.area()) / reference_size_px;
}

/// @brief One place on a training object where a word was seen (O_i of Eqs 1 and 4). Positions and scales are
/// those at the reference size.
struct Occurrence {
    float x = 0, y = 0;        ///< x_i, y_i: from the object's centre to the feature, pixels
    float scale = 1;           ///< s_i: of the feature, pixels
    float angle = 0;           ///< θ_i: of the feature, radians; 0 where features are upright
    float depth_m = no_depth;  ///< of the feature behind the object's centre, metres; NaN = not known
    float weight = 1;          ///< p(occurrence | word); those of one word and group add up to 1
    std::uint32_t class_index = 0;
    std::uint32_t object = 0;   ///< the training object it was seen on
    std::uint32_t feature = 0;  ///< number of the training feature it comes from
};

}  // namespace ism
