// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "ism/config.hpp"

namespace ism {

/// @brief Numbers of a shape histogram: 8 distances × 3 agreements of normals × concave or not.
inline constexpr std::size_t shape_bins = 48;
/// @brief See shape_histogram().
using ShapeHistogram = std::array<float, shape_bins>;

}  // namespace ism
