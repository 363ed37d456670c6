// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "ism/core/image.hpp"
#include "ism/io/limits.hpp"
#include "ism/io/png_file.hpp"
#include "ism/io/write_file.hpp"

namespace ism {

namespace detail {

/// @brief The image's samples as PNG wants them: `append(out, pixel)` adds one pixel's bytes.
template <class T, class Append>
requires std::invocable < Append, std::vector<std::uint8_t>
&, const T& > [[nodiscard]] std::vector<std::uint8_t> encode_png(ImageView<const T> image,
                                                                 std::uint8_t bit_depth,
                                                                 std::uint8_t color_type, Append append) {
    expect(is_image_size(image.width(), image.height()), "image to write", image_size_limits,
           size_text(image));
    std::vector<std::uint8_t> rows;
    rows.reserve(std::size_t(image.width()) * std::size_t(image.height()) * sizeof(T));
    for (int y = 0; y < image.height(); ++y)
        for (const T& pixel : image.row(y)) append(rows, pixel);
    return png_file(image.width(), image.height(), bit_depth, color_type, sizeof(T), rows);
}

}  // namespace detail

/// @brief A colour image as the bytes of a PNG file.
/// @throws Error where the image is empty or has more than max_image_pixels.
[[nodiscard]] inline std::vector<std::uint8_t> encode_png(ImageView<const Rgb> image) {
    return detail::encode_png(image, 8, 2, [](std::vector<std::uint8_t>& out, const Rgb& pixel) {
        out.insert(out.end(), {pixel.r, pixel.g, pixel.b});
    });
}

/// @brief An 8-bit grey image as the bytes of a PNG file.
/// @throws Error where the image is empty or has more than max_image_pixels.
[[nodiscard]] inline std::vector<std::uint8_t> encode_png(ImageView<const std::uint8_t> image) {
    return detail::encode_png(
        image, 8, 0, [](std::vector<std::uint8_t>& out, std::uint8_t pixel) { out.push_back(pixel); });
}

/// @brief A 16-bit grey image, such as a depth camera's, as the bytes of a PNG file.
/// @throws Error where the image is empty or has more than max_image_pixels.
[[nodiscard]] inline std::vector<std::uint8_t> encode_png16(ImageView<const std::uint16_t> image) {
    return detail::encode_png(image, 16, 0, [](std::vector<std::uint8_t>& out, std::uint16_t pixel) {
        out.insert(out.end(), {std::uint8_t(pixel >> 8), std::uint8_t(pixel & 0xff)});
    });
}

/// @brief Writes a colour image as a PNG file.
/// @throws Error as encode_png() does, FileError as write_file() does.
inline void write_png(const std::filesystem::path& path, ImageView<const Rgb> image) {
    write_file(path, encode_png(image));
}

/// @brief Writes an 8-bit grey image as a PNG file.
/// @throws Error as encode_png() does, FileError as write_file() does.
inline void write_png(const std::filesystem::path& path, ImageView<const std::uint8_t> image) {
    write_file(path, encode_png(image));
}

/// @brief Writes a 16-bit grey image as a PNG file.
/// @throws Error as encode_png16() does, FileError as write_file() does.
inline void write_png16(const std::filesystem::path& path, ImageView<const std::uint16_t> image) {
    write_file(path, encode_png16(image));
}

}  // namespace ism
