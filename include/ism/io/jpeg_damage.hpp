// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// stb_image up to 2.27 writes beyond its tables where a JPEG's code table is too long, reads tables the file
/// never gave, and fills missing pixels with anything. So a JPEG's parts are looked through before it decodes
/// them.
namespace ism::detail {

using ByteSpan = std::span<const std::uint8_t>;

/// @brief What the parts of a JPEG have given so far.
class JpegParts {
public:
    /// @brief Takes in one part. False where it cannot be or stands before what it needs.
    [[nodiscard]] bool add(std::uint8_t marker, ByteSpan content) {
        if (marker == 0xc4) return add_codes(content);
        if (marker == 0xdb) return add_quantisers(content);
        if (marker == 0xc0 || marker == 0xc1 || marker == 0xc2) return add_frame(marker == 0xc2, content);
        return marker != 0xda || add_scan(content);
    }

    /// @brief Whether every colour has got its pixels.
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

}  // namespace ism::detail
