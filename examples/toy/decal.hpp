// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "toy/noise.hpp"

namespace toy {

/// @brief Whether (u, v) lies on digit 0 … 9, drawn upright in the unit square, v up.
[[nodiscard]] bool on_digit(int digit, float u, float v);

/// @brief Whether (u, v) lies in a star of radius 1 around 0 with `points` rays, one of them up.
[[nodiscard]] bool on_star(float u, float v, int points, float depth = 0.5f);

/// @brief Whether (u, v) lies in a heart of about radius 1 around 0.
[[nodiscard]] bool on_heart(float u, float v);

/// @brief Whether (u, v), both 0 … 1, lies on made-up print: `rows` rows of words of pattern `seed`.
[[nodiscard]] bool on_print(float u, float v, int rows, std::uint32_t seed);

/// @brief A repeated motif over a flat pattern (u, v), in cells of 1: 0 dots, 1 stripes, 2 zigzag, 3 checks,
/// 4 stars, 5 hearts, 6 flowers, 7 waves. Gives 0 for the ground, 1 and 2 for its two inks.
[[nodiscard]] int motif(int kind, float u, float v, std::uint32_t seed);

}  // namespace toy
