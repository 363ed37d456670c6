// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ism/core/image.hpp"
#include "ism/io/limits.hpp"

namespace ism {

/// @brief A mask as run lengths (COCO): down the columns, from left to right, alternately ground and figure,
/// ground first.
struct Rle {
    int width = 0, height = 0;
    std::vector<std::uint32_t> counts;  ///< their sum is width · height
    [[nodiscard]] bool operator==(const Rle&) const = default;
};

/// @brief Run lengths as COCO packs them into text: from the fourth on each is the difference to the one two
/// before it, in groups of 5 bits, lowest first, bit 6 = another follows, plus 48.
struct CompressedRle {
    int width = 0, height = 0;
    std::string counts;
    [[nodiscard]] bool operator==(const CompressedRle&) const = default;
};

namespace detail {

inline void check_run_lengths(int width, int height, std::uint64_t sum) {
    if (!is_image_size(width, height))
        expect(false, "mask size", image_size_limits, lazy_text(width, "x", height));
    const std::uint64_t pixels = std::uint64_t(width) * std::uint64_t(height);
    if (sum != pixels)
        expect(false, lazy_text("run lengths of a ", width, "x", height, " mask"),
               lazy_text("a sum of ", pixels), sum);
}

inline void check_run_lengths(const Rle& rle) {
    std::uint64_t sum = 0;
    for (const std::uint32_t count : rle.counts) sum += count;
    check_run_lengths(rle.width, rle.height, sum);
}

}  // namespace detail

/// @brief The run lengths of a mask.
/// @throws Error where the mask is empty or has more than max_image_pixels.
[[nodiscard]] inline Rle encode_rle(ImageView<const std::uint8_t> mask) {
    Rle rle{mask.width(), mask.height(), {}};
    std::uint32_t run = 0;
    bool figure = false;
    for (int x = 0; x < mask.width(); ++x)
        for (int y = 0; y < mask.height(); ++y) {
            if ((mask(x, y) != 0) != figure) rle.counts.push_back(run), run = 0, figure = !figure;
            ++run;
        }
    rle.counts.push_back(run);
    detail::check_run_lengths(rle.width, rle.height,
                              std::uint64_t(mask.width()) * std::uint64_t(mask.height()));
    return rle;
}

/// @brief The mask of these run lengths, 0 and 1.
/// @throws Error where the size is absurd or the sum of the run lengths is not width · height.
[[nodiscard]] inline Mask decode_rle(const Rle& rle) {
    detail::check_run_lengths(rle);
    Mask mask(rle.width, rle.height);
    int x = 0, y = 0;
    bool figure = false;
    for (const std::uint32_t count : rle.counts) {
        for (std::uint32_t left = count; left > 0;) {
            const int end = y + int(std::min(left, std::uint32_t(rle.height - y)));
            left -= std::uint32_t(end - y);
            if (figure)
                for (int at = y; at < end; ++at) mask(x, at) = 1;
            y = end;
            if (y == rle.height) y = 0, ++x;
        }
        figure = !figure;
    }
    return mask;
}

/// @brief Run lengths as text.
[[nodiscard]] inline CompressedRle compress(const Rle& rle) {
    CompressedRle text{rle.width, rle.height, {}};
    for (std::size_t i = 0; i < rle.counts.size(); ++i) {
        std::int64_t value = rle.counts[i];
        if (i > 2) value -= rle.counts[i - 2];
        for (bool more = true; more;) {
            const auto bits = static_cast<int>(value & 0x1f);
            value >>= 5;
            more = (bits & 0x10) != 0 ? value != -1 : value != 0;
            text.counts.push_back(char(48 + bits + (more ? 0x20 : 0)));
        }
    }
    return text;
}

/// @brief Text as run lengths.
/// @throws Error where a character does not belong there, the text breaks off, a run is negative, the size is
/// absurd, or the sum is not width · height.
[[nodiscard]] inline Rle decompress(const CompressedRle& text) {
    Rle rle{text.width, text.height, {}};
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < text.counts.size();) {
        std::int64_t value = 0;
        bool more = true;
        for (int shift = 0; more; shift += 5) {
            if (i == text.counts.size())
                expect(false, "packed run lengths", "a whole last number", "a part of it");
            const int bits = static_cast<unsigned char>(text.counts[i]) - 48;
            if (bits < 0 || bits > 63 || shift > 35)
                expect(false, "packed run lengths", "numbers in the characters '0' to 'o'",
                       lazy_text("character ", bits + 48, " at place ", i));
            value |= std::int64_t(bits & 0x1f) << shift;
            more = (bits & 0x20) != 0;
            if (!more && (bits & 0x10) != 0) value -= std::int64_t(1) << (shift + 5);
            ++i;
        }
        if (rle.counts.size() > 2) value += rle.counts[rle.counts.size() - 2];
        if (value < 0 || value > max_image_pixels)
            expect(false, "packed run lengths", lazy_text("runs of 0 to ", max_image_pixels), value);
        rle.counts.push_back(std::uint32_t(value));
        sum += std::uint64_t(value);
    }
    detail::check_run_lengths(rle.width, rle.height, sum);
    return rle;
}

/// @brief A mask as packed run lengths.
/// @throws Error as encode_rle() does.
[[nodiscard]] inline CompressedRle compress_mask(ImageView<const std::uint8_t> mask) {
    return compress(encode_rle(mask));
}

/// @brief The mask of packed run lengths, 0 and 1.
/// @throws Error as decompress() does.
[[nodiscard]] inline Mask decompress_mask(const CompressedRle& text) {
    return decode_rle(decompress(text));
}

}  // namespace ism
