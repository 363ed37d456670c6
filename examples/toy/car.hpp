// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "toy/model.hpp"

namespace toy {

/// @brief A toy car, 0.19 to 0.24 m long, the front at −x. Its kind is instance modulo 7; `seed` gives the
/// rest.
[[nodiscard]] Model make_car(int instance, std::uint64_t seed);

}  // namespace toy
