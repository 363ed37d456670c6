// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "toy/model.hpp"

namespace toy {

/// @brief A tin robot, 0.20 to 0.25 m high, looking to −y.
[[nodiscard]] Model make_robot(int instance, std::uint64_t seed);

}  // namespace toy
