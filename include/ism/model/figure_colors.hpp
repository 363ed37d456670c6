// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "ism/config.hpp"

namespace ism {

/// @brief Bins along each axis of Lab in which colours of a class are known, and of all three.
inline constexpr std::size_t figure_color_levels = 16,
                             figure_color_bins =
                                 figure_color_levels * figure_color_levels * figure_color_levels;

/// @brief How much more often a colour is seen on objects of a class than around them: the logarithm of the
/// ratio, for each bin. Empty = not known.
using FigureColors = std::vector<float>;

}  // namespace ism
