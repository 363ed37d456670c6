// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "ism/core/image.hpp"
#include "ism/core/random.hpp"

namespace ism::test {

/// @brief Independent pixels, each anything from `low` to `high` alike.
[[nodiscard]] inline GrayImage noise(int width, int height, std::uint64_t seed, double low = 0,
                                     double high = 1) {
    Random random(seed);
    GrayImage image(width, height);
    for (float& value : image.pixels()) value = float(random.uniform(low, high));
    return image;
}

}  // namespace ism::test
