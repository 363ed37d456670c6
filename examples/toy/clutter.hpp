// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "toy/model.hpp"

#include "ism/core/random.hpp"

namespace toy {

/// @brief How many kinds of thing make_clutter() knows, the small ones first.
inline constexpr int clutter_kinds = 7, small_clutter_kinds = 3;

/// @brief A thing of none of the classes: 0 toy blocks, 1 ball, 2 can, 3 carton, 4 books, 5 plate, 6 plant.
[[nodiscard]] Model make_clutter(int kind, std::uint64_t seed);

}  // namespace toy
