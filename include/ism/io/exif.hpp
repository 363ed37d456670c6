// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "ism/core/image.hpp"
#include "ism/io/stb_guard.hpp"

/// Cameras store pixels as the sensor lay, and in EXIF how to turn them.
namespace ism {

namespace detail {

/// @brief The orientation in the first directory of a TIFF structure of either byte order; 1 where it is not
/// there or makes no sense.
[[nodiscard]] inline int tiff_orientation(ByteSpan tiff) {
    const bool little = starts_with(tiff, "II*");
    if (tiff.size() < 8 || (!little && !starts_with(tiff, "MM"))) return 1;
    const auto number = [&](std::size_t at, int bytes) {
        if (little) return little_endian(tiff, at, bytes);
        return bytes == 4 ? big_endian(tiff, at) : std::uint32_t(tiff[at]) << 8 | tiff[at + 1];
    };
    const std::size_t directory = number(4, 4);
    if (number(2, 2) != 42 || directory > tiff.size() - 2) return 1;
    const std::size_t entries = number(directory, 2);
    for (std::size_t i = 0, at = directory + 2; i < entries && at + 12 <= tiff.size(); ++i, at += 12) {
        if (number(at, 2) != 0x0112) continue;
        const std::uint32_t type = number(at + 2, 2);  // 3: a number of 16 bits
        const std::uint32_t value = type == 3 ? number(at + 8, 2) : 0;
        return value >= 1 && value <= 8 ? int(value) : 1;
    }
    return 1;
}

}  // namespace detail

/// @brief How the pixels of a JPEG file are to be turned (EXIF 2.3, tag 0x0112): 1 as they are, 2 mirrored
/// left to right, 3 by half a turn, 4 mirrored top to bottom, 5 mirrored at the main diagonal, 6 by a quarter
/// clockwise, 7 mirrored at the other diagonal, 8 by a quarter anticlockwise. 1 where the file does not say,
/// or what it says is damaged.
[[nodiscard]] inline int exif_orientation(std::span<const std::uint8_t> jpeg) {
    std::size_t at = 2;
    while (at + 4 <= jpeg.size()) {
        if (jpeg[at] != 0xff || jpeg[at + 1] == 0xff) {
            ++at;  // padding
            continue;
        }
        const std::uint8_t marker = jpeg[at + 1];
        const std::size_t length = std::size_t(jpeg[at + 2]) << 8 | jpeg[at + 3];
        if (marker == 0xda || marker == 0xd9 || length < 2 || length > jpeg.size() - at - 2) return 1;
        const auto content = jpeg.subspan(at + 4, length - 2);
        if (marker == 0xe1 && content.size() > 6 && detail::starts_with(content, {"Exif\0\0", 6}))
            return detail::tiff_orientation(content.subspan(6));
        at += 2 + length;
    }
    return 1;
}

/// @brief Stored pixels as they are to be shown.
/// @param orientation  of exif_orientation()
/// @throws Error where the orientation is none of 1 … 8.
template <Pixel T>
[[nodiscard]] Image<T> turned(Image<T> stored, int orientation) {
    expect(orientation >= 1 && orientation <= 8, "EXIF orientation", "1 to 8", orientation);
    if (orientation == 1) return stored;
    const bool swap = orientation >= 5;
    const bool flip_x = orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
    const bool flip_y = orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
    const int width = swap ? stored.height() : stored.width();
    const int height = swap ? stored.width() : stored.height();
    Image<T> shown(width, height);
    for (int v = 0; v < height; ++v)
        for (int u = 0; u < width; ++u) {
            int x = flip_x ? width - 1 - u : u, y = flip_y ? height - 1 - v : v;
            if (swap) std::swap(x, y);
            shown(u, v) = stored(x, y);
        }
    return shown;
}

}  // namespace ism
