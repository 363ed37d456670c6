// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

/// @file
/// @brief Writing PNG files by stb_image_write; see ism/io/images.hpp for what a program needs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#if __has_include(<stb_image_write.h>)
#include <stb_image_write.h>
#else
#include <stb/stb_image_write.h>
#endif

#include "ism/core/image.hpp"
#include "ism/io/limits.hpp"
#include "ism/io/stb_guard.hpp"
#include "ism/io/write_file.hpp"

namespace ism {

namespace detail {

/// @brief The samples of an image, row after row without gaps.
template <class T>
[[nodiscard]] std::vector<T> gapless(ImageView<const T> image) {
    expect(is_image_size(image.width(), image.height()), "image to write", image_size_limits,
           size_text(image));
    std::vector<T> samples;
    samples.reserve(std::size_t(image.width()) * std::size_t(image.height()));
    for (int y = 0; y < image.height(); ++y)
        samples.insert(samples.end(), image.row(y).begin(), image.row(y).end());
    return samples;
}

/// @brief Takes bytes of a file from stb.
/// @param file  std::vector<std::uint8_t>*
inline void append_bytes(void* file, void* data, int size) {
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    auto& out = *static_cast<std::vector<std::uint8_t>*>(file);
    out.insert(out.end(), bytes, bytes + size);
}

/// @brief Gapless samples of 8 bits, `channels` a pixel, as the bytes of a PNG file.
[[nodiscard]] inline std::vector<std::uint8_t> stb_png(int width, int height, int channels,
                                                       const void* samples) {
    std::vector<std::uint8_t> file;
    expect(stbi_write_png_to_func(append_bytes, &file, width, height, channels, samples, 0) != 0, "PNG",
           "memory to pack it", "none");
    return file;
}

}  // namespace detail

/// @brief A colour image as the bytes of a PNG file.
/// @throws Error where the image is empty or has more than max_image_pixels.
[[nodiscard]] inline std::vector<std::uint8_t> encode_png(ImageView<const Rgb> image) {
    static_assert(sizeof(Rgb) == 3);
    return detail::stb_png(image.width(), image.height(), 3, detail::gapless(image).data());
}

/// @brief An 8-bit grey image as the bytes of a PNG file.
/// @throws Error where the image is empty or has more than max_image_pixels.
[[nodiscard]] inline std::vector<std::uint8_t> encode_png(ImageView<const std::uint8_t> image) {
    return detail::stb_png(image.width(), image.height(), 1, detail::gapless(image).data());
}

/// @brief A 16-bit grey image, such as a depth camera's, as the bytes of a PNG file.
/// @throws Error where the image is empty or has more than max_image_pixels.
[[nodiscard]] inline std::vector<std::uint8_t> encode_png16(ImageView<const std::uint16_t> image) {
    std::vector<std::uint8_t> samples;
    for (const std::uint16_t sample : detail::gapless(image))
        samples.insert(samples.end(), {std::uint8_t(sample >> 8), std::uint8_t(sample & 0xff)});
    std::vector<std::uint8_t> file = detail::stb_png(image.width(), image.height(), 2, samples.data());
    // stb writes 8 bits a channel only. 8-bit grey with transparency has the same rows and filters as 16-bit
    // grey (PNG, section 9.2: both have two bytes a pixel), so only the header differs: it stands at byte 16
    // after the name of its part at byte 12, bit depth and colour type are its 9th and 10th byte.
    file[24] = 16, file[25] = 0;
    const std::uint32_t crc = detail::crc32(detail::ByteSpan(file).subspan(12, 17));
    for (std::size_t i = 0; i < 4; ++i) file[29 + i] = std::uint8_t(crc >> (24 - 8 * i));
    return file;
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
