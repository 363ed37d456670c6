// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "ism/core/image.hpp"

namespace ism {

/// @brief Pixels of a letter and from one letter or line to the next, before magnification.
inline constexpr int font_width = 5, font_height = 7, font_step = 6, font_line = 10;

namespace detail {

/// The printable ASCII letters from blank to ~, 5 wide and 7 high with 2 rows below the line: bit 5·row +
/// column, from the left upper corner.
inline constexpr std::array<std::uint64_t, 95> font_letters = {
    0x0,          0x100421084,   0x294a,      0x295f57d4a,   0x11f4717c4,    0x672222273,   0x593511526,
    0x884,        0x208210888,   0x88842082,  0x9575480,     0x84f9080,      0x2218c000000, 0xf8000,
    0x18c000000,  0x42222210,    0x3a33ae62e, 0x3884210c4,   0x7c444422e,    0x3a306422e,   0x211f4a988,
    0x3a3083c3f,  0x3a317844c,   0x8442221f,  0x3a317462e,   0x1910f462e,    0x18c0018c0,   0x2218c0018c0,
    0x208208888,  0x1f07c00,     0x88882082,  0x10044422e,   0x783daf62e,    0x4631fc62e,   0x3e317c62f,
    0x3a210862e,  0x3e318c62f,   0x7c217843f, 0x4217843f,    0x7a31e862e,    0x4631fc631,   0x38842108e,
    0x19284211c,  0x452519531,   0x7c2108421, 0x4631ad771,   0x4639ad671,    0x3a318c62e,   0x4217c62f,
    0x59358c62e,  0x45257c62f,   0x3a307062e, 0x10842109f,   0x3a318c631,    0x114a8c631,   0x4775ac631,
    0x462a22a31,  0x108422a31,   0x7c222221f, 0x38421084e,   0x420820821,    0x39084210e,   0x4544,
    0xf800000000, 0x82,          0x7a3e83800, 0x3e318bc21,   0x3a218b800,    0x7a318fa10,   0x383f8b800,
    0x84213c4c,   0xe87a318f800, 0x46318bc21, 0x388421804,   0x64a10843008,  0x24a32a421,   0x388421086,
    0x56b5aac00,  0x46318bc00,   0x3a318b800, 0x10be318bc00, 0x1087a318f800, 0x4219b400,    0x3e0e0f800,
    0x304213c42,  0x7a318c400,   0x11518c400, 0x2ab58c400,   0x454454400,    0xe87a318c400, 0x7c4447c00,
    0x608411098,  0x108421084,   0xc8441083,  0x8a8800,
};

}  // namespace detail

/// @brief Whether the letter has ink at (x, y), x in 0 … 4, y in 0 … 8 (7 and 8 below the line). What is not
/// printable ASCII is a full block.
[[nodiscard]] constexpr bool font_ink(char letter, int x, int y) {
    if (x < 0 || y < 0 || x >= font_width || y >= font_height + 2) return false;
    if (letter < ' ' || letter > '~') return y < font_height;
    return (detail::font_letters[std::size_t(letter - ' ')] >> (5 * y + x) & 1) != 0;
}

/// @brief Width of one line of text, pixels.
[[nodiscard]] constexpr int text_width(std::string_view text, int magnify = 1) {
    return text.empty() ? 0 : (int(text.size()) * font_step - 1) * magnify;
}

/// @brief Writes one line of text whose first letter's left upper corner is (x, y), each of its pixels
/// `magnify` pixels wide; what lies outside the image is cut off.
inline void draw_text(ImageView<Rgb> image, int x, int y, std::string_view text, Rgb color, int magnify = 1) {
    for (std::size_t i = 0; i < text.size(); ++i)
        for (int v = 0; v < (font_height + 2) * magnify; ++v)
            for (int u = 0; u < font_width * magnify; ++u) {
                const int px = x + int(i) * font_step * magnify + u;
                if (font_ink(text[i], u / magnify, v / magnify) && image.contains(px, y + v))
                    image(px, y + v) = color;
            }
}

}  // namespace ism
