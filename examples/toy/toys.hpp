// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "toy/model.hpp"

namespace toy {

/// @brief The classes of the toy scenes, in the order of their indices.
[[nodiscard]] std::vector<std::string> class_names();

/// @brief How far toys of a class are turned from their best view, at most, degrees.
[[nodiscard]] double largest_turn_deg(std::size_t class_index);

/// @brief Toy number `instance` of a class; the same for the same `seed`.
/// @throws ism::Error where there is no such class or the instance is negative.
[[nodiscard]] Model make_toy(std::size_t class_index, int instance, std::uint64_t seed);

}  // namespace toy
