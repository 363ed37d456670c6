// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "ism/core/error.hpp"

/// stb_image_write's deflate, which its header defines but does not declare.
extern "C" unsigned char* stbi_zlib_compress(unsigned char* data, int data_len, int* out_len, int quality);

namespace ism {

namespace detail {

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

inline void put_big_endian(std::vector<std::uint8_t>& out, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) out.push_back(std::uint8_t(value >> shift));
}

inline void put_chunk(std::vector<std::uint8_t>& out, std::string_view type,
                      std::span<const std::uint8_t> data) {
    put_big_endian(out, std::uint32_t(data.size()));
    const std::size_t begin = out.size();
    out.insert(out.end(), type.begin(), type.end());
    out.insert(out.end(), data.begin(), data.end());
    put_big_endian(out, crc32(std::span<const std::uint8_t>(out).subspan(begin)));
}

/// @brief One PNG filter: what is left of a byte after its forecast from the bytes left, above, and left
/// above.
[[nodiscard]] inline std::uint8_t png_filtered(int filter, int value, int left, int above, int corner) {
    const auto paeth = [&] {
        const int to_left = std::abs(above - corner), to_above = std::abs(left - corner);
        const int to_corner = std::abs(left + above - 2 * corner);
        return to_left <= to_above && to_left <= to_corner ? left : to_above <= to_corner ? above : corner;
    };
    switch (filter) {
        case 1:
            return std::uint8_t(value - left);
        case 2:
            return std::uint8_t(value - above);
        case 3:
            return std::uint8_t(value - (left + above) / 2);
        case 4:
            return std::uint8_t(value - paeth());
        default:
            return std::uint8_t(value);
    }
}

/// @brief Rows of big-endian samples as a PNG file. Each row takes the filter whose differences are smallest.
[[nodiscard]] inline std::vector<std::uint8_t> png_file(int width, int height, std::uint8_t bit_depth,
                                                        std::uint8_t color_type, std::size_t pixel_bytes,
                                                        std::span<const std::uint8_t> rows) {
    const std::size_t stride = std::size_t(width) * pixel_bytes;
    std::vector<std::uint8_t> filtered, line(stride), best(stride);
    filtered.reserve(rows.size() + std::size_t(height));
    for (std::size_t y = 0; y < std::size_t(height); ++y) {
        std::size_t best_cost = SIZE_MAX;
        std::uint8_t best_filter = 0;
        for (int filter = 0; filter < 5; ++filter) {
            std::size_t cost = 0;
            for (std::size_t i = 0; i < stride; ++i) {
                const std::uint8_t* at = rows.data() + y * stride + i;
                const int left = i >= pixel_bytes ? at[-std::ptrdiff_t(pixel_bytes)] : 0;
                const int above = y > 0 ? at[-std::ptrdiff_t(stride)] : 0;
                const int corner = y > 0 && i >= pixel_bytes ? at[-std::ptrdiff_t(stride + pixel_bytes)] : 0;
                line[i] = png_filtered(filter, *at, left, above, corner);
                cost += std::size_t(std::abs(int(std::int8_t(line[i]))));
            }
            if (cost < best_cost) best_cost = cost, best_filter = std::uint8_t(filter), best.swap(line);
        }
        filtered.push_back(best_filter);
        filtered.insert(filtered.end(), best.begin(), best.end());
    }
    int packed_size = 0;
    const std::unique_ptr<unsigned char, decltype(&std::free)> packed(
        stbi_zlib_compress(filtered.data(), int(filtered.size()), &packed_size, 8), &std::free);
    expect(packed != nullptr, "PNG", "memory to pack it", "none");
    std::vector<std::uint8_t> head;
    put_big_endian(head, std::uint32_t(width));
    put_big_endian(head, std::uint32_t(height));
    head.insert(head.end(), {bit_depth, color_type, 0, 0, 0});
    std::vector<std::uint8_t> file = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    put_chunk(file, "IHDR", head);
    put_chunk(file, "IDAT", {packed.get(), std::size_t(packed_size)});
    put_chunk(file, "IEND", {});
    return file;
}

}  // namespace detail

}  // namespace ism
