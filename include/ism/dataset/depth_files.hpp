// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <ios>
#include <set>
#include <string_view>
#include <vector>

#include "ism/config.hpp"

/// Depth that lies among pictures: nothing but the kind of file tells it from them.
namespace ism::detail {

/// @brief Whether a file is a grey PNG of 16 bits, as depth is kept.
[[nodiscard]] inline bool is_depth_image(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::array<char, 26> head{};
    stream.read(head.data(), std::streamsize(head.size()));
    return stream && std::string_view(head.data() + 1, 3) == "PNG" && head[24] == 16 && head[25] == 0;
}

/// @brief Those of the pictures of a place that are depth beside the others. Where all are grey PNG of 16
/// bits, as of X-rays and thermal cameras, they are the pictures, and none is depth.
[[nodiscard]] inline std::set<std::filesystem::path> depth_among(
    const std::vector<std::filesystem::path>& pictures) {
    std::set<std::filesystem::path> depth;
    std::size_t others = 0;
    for (const auto& file : pictures) {
        if (is_depth_image(file))
            depth.insert(file);
        else
            ++others;
    }
    if (others == 0) depth.clear();
    return depth;
}

}  // namespace ism::detail
