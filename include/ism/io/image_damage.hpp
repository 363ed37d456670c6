// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "ism/core/error.hpp"
#include "ism/io/jpeg_damage.hpp"
#include "ism/io/png_file.hpp"

/// What the decoder lets pass: it fills the missing part of a cut BMP or PNM file with anything, and
/// does not look at a PNG's checksums.
namespace ism::detail {

enum class ImageFormat { unknown, png, jpeg, bmp, pnm };

[[nodiscard]] inline bool starts_with(ByteSpan bytes, std::string_view magic) {
    return bytes.size() >= magic.size() &&
           std::equal(magic.begin(), magic.end(), bytes.begin(),
                      [](char a, std::uint8_t b) { return std::uint8_t(a) == b; });
}

[[nodiscard]] inline ImageFormat image_format(ByteSpan bytes) {
    if (starts_with(bytes, "\x89PNG\r\n\x1a\n")) return ImageFormat::png;
    if (starts_with(bytes, "\xff\xd8\xff")) return ImageFormat::jpeg;
    if (starts_with(bytes, "BM")) return ImageFormat::bmp;
    if (starts_with(bytes, "P5") || starts_with(bytes, "P6")) return ImageFormat::pnm;
    return ImageFormat::unknown;
}

[[nodiscard]] inline std::uint32_t big_endian(ByteSpan bytes, std::size_t at) {
    return std::uint32_t(bytes[at]) << 24 | std::uint32_t(bytes[at + 1]) << 16 |
           std::uint32_t(bytes[at + 2]) << 8 | bytes[at + 3];
}

[[nodiscard]] inline std::uint32_t little_endian(ByteSpan bytes, std::size_t at, int count) {
    std::uint32_t value = 0;
    for (int i = count - 1; i >= 0; --i) value = value << 8 | bytes[at + std::size_t(i)];
    return value;
}

[[nodiscard]] inline std::string png_damage(ByteSpan bytes) {
    std::size_t at = 8;
    while (bytes.size() - at >= 12) {
        const std::size_t length = big_endian(bytes, at);
        if (length > bytes.size() - at - 12) break;
        if (crc32(bytes.subspan(at + 4, length + 4)) != big_endian(bytes, at + 8 + length))
            return join_text("a damaged part at byte ", at);
        if (starts_with(bytes.subspan(at + 4), "IEND")) return {};
        at += length + 12;
    }
    return "a truncated PNG";
}

[[nodiscard]] inline std::string bmp_damage(ByteSpan bytes, std::int64_t width, std::int64_t height) {
    if (bytes.size() < 54) return "a truncated BMP";
    const bool old = little_endian(bytes, 14, 4) == 12;  // the shorter header of OS/2
    const std::int64_t bits = little_endian(bytes, old ? 24 : 28, 2);
    const std::int64_t needed = little_endian(bytes, 10, 4) + (width * bits + 31) / 32 * 4 * height;
    return std::int64_t(bytes.size()) < needed ? "a truncated BMP" : "";
}

[[nodiscard]] inline std::string pnm_damage(ByteSpan bytes, std::int64_t samples) {
    const auto is_space = [](std::uint8_t c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
    std::size_t at = 2;
    for (int number = 0; number < 3; ++number) {
        while (at < bytes.size() && (is_space(bytes[at]) || bytes[at] == '#'))
            if (bytes[at] == '#')
                while (at < bytes.size() && bytes[at] != '\n' && bytes[at] != '\r') ++at;
            else
                ++at;
        while (at < bytes.size() && bytes[at] >= '0' && bytes[at] <= '9') ++at;
    }
    return std::int64_t(bytes.size()) < std::int64_t(at) + 1 + samples ? "a truncated PNM" : "";
}

}  // namespace ism::detail
