// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "ism/core/error.hpp"

namespace ism {

/// @brief The most pixels an image or mask read from a file may have; what claims more is refused before
/// memory is taken for it.
inline constexpr std::int64_t max_image_pixels = std::int64_t(1) << 27;

/// @brief The longest side an image or mask read from a file may have, pixels.
inline constexpr std::int64_t max_image_side = std::int64_t(1) << 20;

/// @brief The sizes allowed, for messages.
inline constexpr std::string_view image_size_limits = "1 to 134217728 pixels, sides up to 1048576";

/// @brief Whether a file may hold an image of this size.
[[nodiscard]] constexpr bool is_image_size(std::int64_t width, std::int64_t height) {
    return width > 0 && height > 0 && width <= max_image_side && height <= max_image_side &&
           width * height <= max_image_pixels;
}

namespace detail {

/// @brief "640x480", for messages.
template <class Sized>
requires requires(const Sized& sized) {
    sized.width;
    sized.height;
}
[[nodiscard]] std::string sides_text(const Sized& sized) {
    return join_text(sized.width, "x", sized.height);
}

}  // namespace detail

}  // namespace ism
