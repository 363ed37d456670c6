// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "support/data_sets.hpp"

#include "ism/core/image.hpp"
#include "ism/io/images.hpp"

namespace bench {

using ByteImage = ism::Image<std::uint8_t>;

[[nodiscard]] inline ByteImage read_bytes(const std::filesystem::path& file) {
    const ism::GrayImage gray = ism::to_gray(ism::read_rgb(file));
    ByteImage bytes(gray.width(), gray.height());
    for (std::size_t i = 0; i < bytes.pixels().size(); ++i)
        bytes.pixels()[i] = std::uint8_t(std::lround(255 * gray.pixels()[i]));
    return bytes;
}

/// @brief The middle of an image, at most width × height pixels.
[[nodiscard]] inline ByteImage crop(const ByteImage& image, int width, int height) {
    width = std::min(width, image.width()), height = std::min(height, image.height());
    const auto part =
        image.view().region((image.width() - width) / 2, (image.height() - height) / 2, width, height);
    ByteImage result(width, height);
    for (int y = 0; y < height; ++y) std::copy_n(part.row(y).data(), width, result.row(y).data());
    return result;
}

/// @brief The files named, and those of folders named; without any the middle 640×480 of the first and fourth
/// image of five Oxford sequences.
[[nodiscard]] inline std::vector<ByteImage> photographs(const std::vector<std::string>& files) {
    std::vector<ByteImage> images;
    for (const std::filesystem::path file : files) {
        std::vector<std::filesystem::path> all = {file};
        if (std::filesystem::is_directory(file)) {
            all.clear();
            for (const auto& entry : std::filesystem::directory_iterator(file))
                for (const char* ending : {".png", ".jpg", ".jpeg", ".ppm", ".pgm"})
                    if (entry.path().extension() == ending) all.push_back(entry.path());
            std::sort(all.begin(), all.end());
        }
        for (const std::filesystem::path& one : all) images.push_back(read_bytes(one));
    }
    ism::expect(files.empty() || !images.empty(), "photographs", "image files",
                ism::lazy_text("none in ", (files.empty() ? std::string() : files.front())));
    if (!images.empty()) return images;
    for (const char* sequence : {"bikes", "boat", "graf", "leuven", "ubc"})
        for (const char* name : {"img1.png", "img4.png"})
            images.push_back(
                crop(read_bytes(data_file(data_folder() / "oxford-affine" / sequence / name)), 640, 480));
    return images;
}

}  // namespace bench
