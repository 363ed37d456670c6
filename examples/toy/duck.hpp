// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "toy/model.hpp"

namespace toy {

/// @brief A bath duck, 0.15 to 0.19 m long, looking to −x. Instances differ in build, colour and dress.
[[nodiscard]] Model make_duck(int instance, std::uint64_t seed);

}  // namespace toy
