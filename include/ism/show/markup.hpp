// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "ism/core/image.hpp"
#include "ism/core/number_text.hpp"

namespace ism {

namespace detail {

/// Length of the UTF-8 sequence that begins at `i`, 0 where there is none (RFC 3629).
[[nodiscard]] inline std::size_t utf8_length(std::string_view text, std::size_t i) {
    const auto byte = [&](std::size_t k) { return k < text.size() ? std::uint8_t(text[k]) : 0u; };
    const unsigned lead = byte(i);
    if (lead < 0x80) return 1;
    const std::size_t length = lead >= 0xC2 && lead <= 0xDF   ? 2
                               : (lead & 0xF0) == 0xE0        ? 3
                               : lead >= 0xF0 && lead <= 0xF4 ? 4
                                                              : 0;
    for (std::size_t k = 1; k < length; ++k)
        if ((byte(i + k) & 0xC0) != 0x80) return 0;
    const unsigned second = byte(i + 1);
    const bool refused = (lead == 0xE0 && second < 0xA0) || (lead == 0xED && second > 0x9F) ||
                         (lead == 0xF0 && second < 0x90) || (lead == 0xF4 && second > 0x8F);
    return refused ? 0 : length;
}

}  // namespace detail

/// @brief Text for use in HTML and SVG, within elements and quoted attributes; control characters become
/// blanks, bytes that are not UTF-8 the replacement character.
[[nodiscard]] inline std::string escape_markup(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = detail::utf8_length(text, i);
        const char c = text[i];
        if (length == 0) {
            result += "\xEF\xBF\xBD";
        } else if (c == '&') {
            result += "&amp;";
        } else if (c == '<') {
            result += "&lt;";
        } else if (c == '>') {
            result += "&gt;";
        } else if (c == '"') {
            result += "&quot;";
        } else if (c == '\'') {
            result += "&#39;";
        } else if (length == 1 && c != '\n' && (std::uint8_t(c) < 0x20 || c == 0x7F)) {
            result += ' ';
        } else {
            result += text.substr(i, length);
        }
        i += length == 0 ? 1 : length;
    }
    return result;
}

/// @brief "#rrggbb"
[[nodiscard]] inline std::string hex_color(Rgb color) {
    return join_text('#', hex_text(std::uint64_t(color.r) << 16 | std::uint64_t(color.g) << 8 | color.b, 6));
}

}  // namespace ism
