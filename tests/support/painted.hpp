// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include "ism/core/image.hpp"

namespace ism::test {

/// @brief A mask of 30 × 20 px with one rectangle.
[[nodiscard]] inline Mask rectangle(int x0, int y0, int width, int height) {
    Mask mask(30, 20);
    for (int y = y0; y < y0 + height; ++y)
        for (int x = x0; x < x0 + width; ++x) mask(x, y) = 1;
    return mask;
}

/// @brief How many pixels of an image are not black.
[[nodiscard]] inline std::size_t painted(const RgbImage& image) {
    return std::size_t(
        std::count_if(image.pixels().begin(), image.pixels().end(), [](Rgb c) { return c != Rgb{}; }));
}

}  // namespace ism::test
