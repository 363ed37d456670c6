// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "toy/model.hpp"

namespace toy {

/// @brief A printed mug, 0.11 to 0.14 m high with the handle at +x.
[[nodiscard]] Model make_mug(int instance, std::uint64_t seed);

}  // namespace toy
