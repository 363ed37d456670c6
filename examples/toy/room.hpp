// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "toy/model.hpp"

#include "ism/core/random.hpp"

namespace toy {

/// @brief The table top (z = 0) and the wall behind it, with their looks.
struct Room {
    float wall_y = 2.2f;  ///< where the wall stands, metres
    int table = 0;        ///< 0 planks, 1 gingham, 2 woven cloth, 3 speckled stone, 4 striped cloth, 5 plain
    int wall = 0;         ///< 0 plaster, 1 stripes, 2 printed paper, 3 bricks
    float turn = 0;       ///< of the table's pattern, radians
    Vec table_colour = {0.5f, 0.33f, 0.18f}, table_second = {0.8f, 0.8f, 0.75f};
    Vec wall_colour = {0.6f, 0.58f, 0.5f}, wall_second = {0.7f, 0.68f, 0.6f};
    std::uint32_t seed = 0;
};

/// @brief A room by chance; `busy` ones have strong patterns.
[[nodiscard]] Room make_room(ism::Random& random, bool busy);

/// @brief The table at a point of z = 0; `blur_m` is the size of a pixel there, metres.
[[nodiscard]] Surface table_surface(const Room& room, Vec p, float blur_m);

/// @brief The wall at a point of y = wall_y; `blur_m` is the size of a pixel there, metres.
[[nodiscard]] Surface wall_surface(const Room& room, Vec p, float blur_m);

}  // namespace toy
