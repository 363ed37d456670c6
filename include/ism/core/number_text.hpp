// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "ism/config.hpp"

/// Numbers as text: the same in every locale, so that a file is valid wherever it was written.
namespace ism {

/// @brief A number with at most `digits` digits that count, without needless zeros; NaN as "–".
[[nodiscard]] inline std::string number_text(double value, int digits = 4) {
    if (std::isnan(value)) return "\u2013";
    std::array<char, 64> text;
    return {
        text.data(),
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits).ptr};
}

/// @brief A number with `decimals` digits after the point.
[[nodiscard]] inline std::string fixed_text(double value, int decimals) {
    std::array<char, 400> text;  // the largest number has 309 digits before the point
    return {
        text.data(),
        std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals).ptr};
}

/// @brief The last `digits` hexadecimal digits of a number, zeros at the front too.
[[nodiscard]] inline std::string hex_text(std::uint64_t value, std::size_t digits) {
    std::string text(digits, '0');
    for (std::size_t i = digits; i-- > 0; value >>= 4) text[i] = "0123456789abcdef"[value & 15];
    return text;
}

}  // namespace ism
