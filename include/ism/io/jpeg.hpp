// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

/// @file
/// @brief JPEG by stb_image_write, for pictures that are looked at: a tenth of a PNG's size. A program that
/// includes this header compiles stb once by "ism/io/stb_implementation.hpp".
#pragma once

#include <cstdint>
#include <vector>

#include "ism/io/png.hpp"

namespace ism {

/// @brief An image as a JPEG file's bytes.
/// @param quality  1 … 100, larger is better
/// @throws Error where the image has no pixels or too many, or the quality is out of range.
[[nodiscard]] inline std::vector<std::uint8_t> encode_jpeg(ImageView<const Rgb> image, int quality = 85) {
    static_assert(sizeof(Rgb) == 3);
    expect(quality >= 1 && quality <= 100, "JPEG quality", "1 to 100", quality);
    const std::vector<Rgb> pixels = detail::gapless(image);
    std::vector<std::uint8_t> file;
    expect(stbi_write_jpg_to_func(detail::append_bytes, &file, image.width(), image.height(), 3,
                                  pixels.data(), quality) != 0,
           "JPEG", "memory to pack it", "none");
    return file;
}

}  // namespace ism
