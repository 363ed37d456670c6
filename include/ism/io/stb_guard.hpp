// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ism/core/text.hpp"

/// A shim in front of stb_image 2.27 (Debian 12), which
/// - fills the missing pixels of a cut JPEG, BMP or PNM file with arbitrary values and reports success,
/// - does not verify a PNG's checksums,
/// - writes beyond its tables where a JPEG's code table is too long, and reads tables the file never gave.
/// So the segments of a file are validated before stb decodes them. With a decoder that refuses such files
/// this header and its calls in io/images.hpp can be removed.
namespace ism::detail {

using ByteSpan = std::span<const std::uint8_t>;

/// @brief State of the validation of a JPEG's segments.
class JpegParts {
public:
    /// @brief Adds one segment; false where it is invalid or precedes a table it needs.
    [[nodiscard]] bool add(std::uint8_t marker, ByteSpan content) {
        if (marker == 0xc4) return add_codes(content);
        if (marker == 0xdb) return add_quantisers(content);
        if (marker == 0xc0 || marker == 0xc1 || marker == 0xc2) return add_frame(marker == 0xc2, content);
        return marker != 0xda || add_scan(content);
    }

    /// @brief Whether every component has been scanned.
    [[nodiscard]] bool complete() const {
        for (const Component& component : components_)
            if (!component.scanned) return false;
        return !components_.empty();
    }

private:
    struct Component {
        std::uint8_t id = 0, quantiser = 0;
        bool scanned = false;
    };

    bool add_codes(ByteSpan tables) {
        while (tables.size() >= 17) {
            std::size_t codes = 0;
            for (std::size_t i = 1; i <= 16; ++i) codes += tables[i];
            const int kind = tables[0] >> 4, number = tables[0] & 15;
            if (codes > 256 || codes > tables.size() - 17 || kind > 1 || number > 3) return false;
            codes_[kind][number] = true;
            tables = tables.subspan(17 + codes);
        }
        return tables.empty();
    }

    bool add_quantisers(ByteSpan tables) {
        while (!tables.empty()) {
            const std::size_t bytes = tables[0] >> 4 ? 129 : 65;
            const int number = tables[0] & 15;
            if (tables.size() < bytes || number > 3) return false;
            quantisers_[number] = true;
            tables = tables.subspan(bytes);
        }
        return true;
    }

    bool add_frame(bool progressive, ByteSpan content) {
        if (content.size() < 6 || content.size() != 6 + 3 * std::size_t(content[5]) || !components_.empty())
            return false;
        for (std::size_t i = 6; i < content.size(); i += 3)
            components_.push_back({.id = content[i], .quantiser = content[i + 2]});
        progressive_ = progressive;
        return true;
    }

    bool add_scan(ByteSpan content) {
        if (content.empty() || content.size() != 4 + 2 * std::size_t(content[0])) return false;
        const std::size_t last = content.size() - 3;
        const bool first_pass = content[last] == 0 && content[last + 2] >> 4 == 0;
        for (std::size_t i = 1; i < last; i += 2) {
            const int low = content[i + 1] >> 4, high = content[i + 1] & 15;
            if (low > 3 || high > 3) return false;
            if (first_pass && !codes_[0][low]) return false;
            if ((!progressive_ || content[last] > 0) && !codes_[1][high]) return false;
            bool known = false;
            for (Component& component : components_)
                if (component.id == content[i]) {
                    known = component.quantiser <= 3 && quantisers_[component.quantiser];
                    component.scanned = component.scanned || first_pass;
                    if (!component.scanned) return false;
                    break;  // the decoder takes the first of two with one id
                }
            if (!known) return false;
        }
        return true;
    }

    bool codes_[2][4] = {};
    bool quantisers_[4] = {};
    bool progressive_ = false;
    std::vector<Component> components_;
};

/// @brief What is wrong with a JPEG file; empty where nothing.
[[nodiscard]] inline std::string jpeg_damage(ByteSpan bytes) {
    JpegParts parts;
    std::size_t at = 2;
    while (at + 2 <= bytes.size()) {
        const std::uint8_t marker = bytes[at + 1];
        if (bytes[at] != 0xff || marker == 0 || marker == 0xff || (marker >= 0xd0 && marker <= 0xd8)) {
            ++at;  // pixels, padding, or a mark without content
            continue;
        }
        if (marker == 0xd9) return parts.complete() ? "" : "a JPEG without all its colours";
        if (at + 4 > bytes.size()) break;
        const std::size_t length = std::size_t(bytes[at + 2]) << 8 | bytes[at + 3];
        if (length < 2 || length > bytes.size() - at - 2) break;
        if (!parts.add(marker, bytes.subspan(at + 4, length - 2))) return "a damaged JPEG";
        at += 2 + length;
    }
    return "a truncated JPEG";
}

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

/// @brief What a file is that stb does not read, for messages.
[[nodiscard]] inline std::string_view other_image_format(ByteSpan bytes) {
    if (starts_with(bytes, "RIFF") && bytes.size() >= 12 && starts_with(bytes.subspan(8), "WEBP"))
        return "a WebP image";
    if (starts_with(bytes, {"II*\0", 4}) || starts_with(bytes, {"MM\0*", 4})) return "a TIFF image";
    if (starts_with(bytes, "GIF8")) return "a GIF image";
    if (bytes.size() >= 12 && starts_with(bytes.subspan(4), "ftypavi")) return "an AVIF image";
    if (bytes.size() >= 12 && starts_with(bytes.subspan(4), "ftyp"))
        for (const std::string_view brand : {"hei", "hev", "mif1", "msf1"})
            if (starts_with(bytes.subspan(8), brand)) return "a HEIC image";
    return "something else";
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

/// @brief The checksum of a PNG chunk (CRC-32, ISO 3309).
[[nodiscard]] inline std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
    static constexpr auto table = [] {
        std::array<std::uint32_t, 256> rows{};
        for (std::uint32_t i = 0; i < 256; ++i) {
            std::uint32_t value = i;
            for (int bit = 0; bit < 8; ++bit) value = (value >> 1) ^ ((value & 1) ? 0xedb88320u : 0u);
            rows[i] = value;
        }
        return rows;
    }();
    std::uint32_t crc = 0xffffffffu;
    for (const std::uint8_t byte : bytes) crc = table[(crc ^ byte) & 0xff] ^ (crc >> 8);
    return ~crc;
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
    if (bytes.size() < 26) return "a truncated BMP";
    const bool old = little_endian(bytes, 14, 4) == 12;  // the shorter header of OS/2
    if (!old && bytes.size() < 54) return "a truncated BMP";
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
