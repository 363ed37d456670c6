// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ism/core/error.hpp"

namespace ism {

namespace detail {

inline constexpr std::string_view base64_letters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace detail

/// @brief Bytes as base64 text (RFC 4648).
[[nodiscard]] inline std::string base64(std::span<const std::uint8_t> bytes) {
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t k) {
            return i + k < bytes.size() ? std::uint32_t(bytes[i + k]) : 0;
        };
        const std::uint32_t bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : detail::base64_letters[bits >> (18 - 6 * k) & 63];
    }
    return text;
}

/// @brief The bytes of base64 text (RFC 4648), of which each letter counts: no white space, padded by '='.
/// @throws Error where it is none.
[[nodiscard]] inline std::vector<std::uint8_t> decode_base64(std::string_view text) {
    expect(text.size() % 4 == 0, "base64", "a number of letters that 4 divides", text.size());
    const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with("=") ? 1 : 0;
    std::vector<std::uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3);
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool pads = i >= text.size() - padding;
        const std::size_t letter = pads ? 0 : detail::base64_letters.find(text[i]);
        expect(letter != std::string_view::npos, "base64", "letters, digits, + and /",
               lazy_text("byte ", unsigned(static_cast<unsigned char>(text[i])), " at ", i));
        bits = bits << 6 | std::uint32_t(letter);
        if (i % 4 != 3) continue;
        for (const int shift : {16, 8, 0}) bytes.push_back(std::uint8_t(bits >> shift));
    }
    bytes.erase(bytes.end() - std::ptrdiff_t(padding), bytes.end());
    return bytes;
}

}  // namespace ism
