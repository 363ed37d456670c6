// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "ism/core/image.hpp"
#include "ism/feature/workspace.hpp"

namespace ism {

/// @brief Brightness is 0 (black) … 1 (white) and may exceed this a little, as after sharpening. Beyond ±
/// this bound it is refused: it is of another unit, 0 … 255 say, of which even a dark picture has more.
inline constexpr float max_brightness = 4;

namespace detail {

inline void check_brightness_row(ImageView<const float> image, int y) {
    int wrong = 0;
    for (const float value : image.row(y)) wrong |= int(!(std::fabs(value) <= max_brightness));
    if (wrong == 0) return;
    for (int x = 0; x < image.width(); ++x)
        expect(std::fabs(image(x, y)) <= max_brightness, lazy_text("image brightness at (", x, ", ", y, ")"),
               lazy_text("0 to 1 (accepted: -", max_brightness, " to ", max_brightness, ")"), image(x, y));
}

}  // namespace detail

/// @brief Validates the pixels of `image`.
/// @throws Error where one is not a number or beyond ±max_brightness.
inline void check_brightness(ImageView<const float> image, Workspace& workspace) {
    workspace.each_row(image.height(), [&](int y) { detail::check_brightness_row(image, y); });
}

}  // namespace ism
