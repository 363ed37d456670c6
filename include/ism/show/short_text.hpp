// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "ism/config.hpp"

namespace ism {

/// @brief A text (UTF-8) of at most `most` letters, 3 or more: of a longer one "…" stands for the middle, so
/// that names that begin alike stay different.
[[nodiscard]] inline std::string shortened(std::string_view text, std::size_t most) {
    std::vector<std::size_t> letters;  // where they begin
    for (std::size_t i = 0; i < text.size(); ++i)
        if ((text[i] & 0xC0) != 0x80) letters.push_back(i);
    if (letters.size() <= most) return std::string(text);
    const std::size_t tail = most / 3, head = most - 1 - tail;
    return std::string(text.substr(0, letters[head])) + "…" +
           std::string(text.substr(letters[letters.size() - tail]));
}

}  // namespace ism
