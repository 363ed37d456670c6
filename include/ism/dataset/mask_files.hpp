// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

/// @file
/// @brief Masks that are images. By stb_image: see ism/io/images.hpp for what a program needs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <utility>

#include "ism/dataset/dataset.hpp"
#include "ism/dataset/image_files.hpp"
#include "ism/dataset/rle.hpp"
#include "ism/io/images.hpp"

namespace ism::detail {

/// @brief An image as a mask. Figure is what is not transparent; without transparent pixels it is what is
/// brighter, in any channel, than half of the brightest.
/// @throws FileError where it is damaged, grey of 16 bits, as depth is kept, or nothing in it is figure.
[[nodiscard]] inline Mask decode_mask(const ImageFile& file) {
    if (file.deep && file.channels == 1) file.refuse("a mask of 8 bits", "grey of 16 bits, as depth is kept");
    const auto samples = decode(file, 4, stbi_load_from_memory);
    Mask mask(file.width, file.height);
    std::uint8_t brightest = 0, least_alpha = 255;
    const auto light = [&](std::size_t i) {
        return std::max({samples[4 * i], samples[4 * i + 1], samples[4 * i + 2]});
    };
    const std::size_t count = mask.pixels().size();
    for (std::size_t i = 0; i < count; ++i) {
        brightest = std::max(brightest, light(i));
        least_alpha = std::min<std::uint8_t>(least_alpha, samples[4 * i + 3]);
    }
    const bool transparent = least_alpha < 128;
    for (std::size_t i = 0; i < count; ++i)
        mask.pixels()[i] = transparent ? samples[4 * i + 3] >= 128 : 2 * light(i) > brightest;
    if (mask_area(mask) == 0) file.refuse("a mask with figure", "one without");
    return turned(std::move(mask), file.orientation);
}

/// @brief A mask in a file of its own, as by decode_mask().
/// @throws FileError where it cannot be read, or nothing in it is figure.
[[nodiscard]] inline Mask read_mask_file(const std::filesystem::path& path) {
    return decode_mask(open_image(path));
}

/// @brief Whether an image has transparent pixels: they are then the ground of a mask.
[[nodiscard]] inline bool has_transparent_pixels(const std::filesystem::path& path) {
    if (lower(path.extension().string()) != ".png") return false;
    const ImageFile file = open_image(path);
    if (file.channels != 2 && file.channels != 4) return false;
    const auto samples = decode(file, 4, stbi_load_from_memory);
    const std::size_t count = std::size_t(file.width) * std::size_t(file.height);
    for (std::size_t i = 0; i < count; ++i)
        if (samples[4 * i + 3] < 128) return true;
    return false;
}

/// @brief Adds an object whose mask is known; its box is that of the mask.
inline void add_masked(DatasetImage& image, std::uint32_t class_index, const Mask& mask) {
    image.objects.push_back(
        {.class_index = class_index, .box = mask_box(mask), .segmentation = compress_mask(mask)});
}

}  // namespace ism::detail
