// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "ism/core/resize_area.hpp"
#include "ism/core/vector.hpp"

namespace ism {

inline constexpr std::size_t hog_directions = 18;  ///< of gradients, over the full circle
inline constexpr std::size_t hog_sums = 24;        ///< directions, three means of colour, and nothing
/// @brief What a gradient of 1, from black to white, and a colour of 1 are in the sums.
inline constexpr int gradient_unit = 360, color_unit = 255;
/// @brief The sums over so many pixels are exact: below 65536 for gradients of √2, between −32768 and 32767
/// for colours of −1 to 1.
inline constexpr int most_exact_pixels = 128;

/// @brief Gradients and colours of an image at one resolution, as sums over all pixels above and to the left:
/// four of them give the sum over any rectangle (Viola and Jones 2001; for gradients Porikli 2005). They
/// begin again at 0 after 65535, which leaves the sum over most_exact_pixels right and takes half of the
/// memory.
struct HogLevel {
    int width = 0, height = 0;      ///< pixels of the level
    std::span<std::uint16_t> sums;  ///< count(width, height) numbers: detail::HogSums

    /// @brief How many numbers a level has: hog_sums for each corner of a pixel.
    [[nodiscard]] static std::size_t count(int width, int height) {
        return std::size_t(width + 1) * std::size_t(height + 1) * hog_sums;
    }
    [[nodiscard]] const std::uint16_t* at(int x, int y) const {
        return sums.data() + (std::size_t(y) * std::size_t(width + 1) + std::size_t(x)) * hog_sums;
    }
};

namespace detail {

/// Four and not eight: GCC compares number after number where a vector has no instruction of its own, and
/// without flags x86 has none for eight.
using FourFloats = Vector<float, 4>;
using EightShorts = Vector<std::uint16_t, 8>;
/// Of a rectangle: directions 0 … 7, their opposites 9 … 16, 8 and 17 with two zeros, three colours and a
/// zero.
using HogMeans = std::array<FourFloats, hog_sums / 4>;
inline constexpr std::size_t color_part = hog_sums / 4 - 1;  ///< of HogMeans
/// The sums of a place, in an order in which they become two vectors of HogMeans by a mask and a shift: its
/// numbers 0 … 3 at even places, 4 … 7 at odd ones, and so on (where low bytes come first).
using HogSums = std::array<EightShorts, hog_sums / 8>;

/// Where number k of HogMeans lies among the sums of a place.
[[nodiscard]] constexpr std::size_t place_of_mean(std::size_t k) {
    return k / 8 * 8 + k % 4 * 2 + k / 4 % 2;
}

/// Where gradients point, 0 … 18: an odd polynomial of the smaller slope, exact to 0.002 of a direction.
inline void take_directions(const FourFloats& x, const FourFloats& y, FourFloats& turns) {
    const FourFloats across = x > 0 ? x : -x, along = y > 0 ? y : -y;
    const FourFloats large = across > along ? across : along, small = across > along ? along : across;
    const FourFloats t = small / (large > 0 ? large : FourFloats{} + 1), s = t * t;
    // (Abramowitz and Stegun 1964, 4.4.47)
    turns = t * (2.864405f + s * (-0.946238f + s * (0.516066f + s * (-0.243888f + s * 0.059688f))));
    turns = along > across ? 4.5f - turns : turns;
    turns = x < 0 ? 9 - turns : turns;
    turns = y < 0 ? 18 - turns : turns;
}

/// The gradients of a row of pixels, each that of the colour where it is strongest, four pixels side by side.
struct HogRow {
    std::vector<FourFloats> sq_strength, turn;

    explicit HogRow(int width) : sq_strength((std::size_t(width) + 3) / 4), turn(sq_strength.size()) {}

    /// From its own colours and those of the rows above and below, four numbers a pixel.
    void fill(std::span<const float> above, std::span<const float> row, std::span<const float> below) {
        const std::size_t last = row.size() / 4 - 1;
        const auto subtract = [](const float* right, const float* left, FourFloats& result) {
            FourFloats subtracted;
            std::memcpy(&result, right, sizeof(result));
            std::memcpy(&subtracted, left, sizeof(subtracted));
            result -= subtracted;
        };
        for (std::size_t block = 0; block < turn.size(); ++block) {
            FourFloats across[4], along[4];  // of each pixel, by colours
#pragma GCC unroll 4
            for (std::size_t lane = 0; lane < 4; ++lane) {
                const std::size_t i = std::min(4 * block + lane, last);
                const std::size_t left = i > 0 ? i - 1 : i, right = std::min(i + 1, last);
                subtract(row.data() + 4 * right, row.data() + 4 * left, across[lane]);
                subtract(below.data() + 4 * i, above.data() + 4 * i, along[lane]);
            }
            FourFloats x{}, y{}, most = FourFloats{} - 1;
#pragma GCC unroll 3
            for (std::size_t k = 0; k < 3; ++k) {
                const FourFloats gx = {across[0][k], across[1][k], across[2][k], across[3][k]};
                const FourFloats gy = {along[0][k], along[1][k], along[2][k], along[3][k]};
                const FourFloats sq = gx * gx + gy * gy;
                const auto stronger = sq > most;
                x = stronger ? gx : x, y = stronger ? gy : y, most = stronger ? sq : most;
            }
            sq_strength[block] = most;
            take_directions(x, y, turn[block]);
        }
    }
};

/// Where direction d lies among the sums of a place.
[[nodiscard]] constexpr std::size_t place_of_direction(std::size_t d) {
    return place_of_mean(d == 8 ? 16 : d < 8 || d == 17 ? d : d - 1);
}

/// All bits at the place of each direction, then of the first two again.
struct DirectionMasks {
    alignas(16) std::uint16_t of[hog_directions + 2][hog_sums] = {};
    constexpr DirectionMasks() {
        for (std::size_t d = 0; d < hog_directions + 2; ++d)
            of[d][place_of_direction(d % hog_directions)] = 0xffff;
    }
};

/// One level, whose size is set and whose sums are uninitialised, from its colours: red, green, blue and a
/// number that is not used.
inline void fill_level(HogLevel& level, ResizedRows<4>& image) {
    static constexpr DirectionMasks masks;
    const auto width = std::size_t(level.width), height = std::size_t(level.height);
    const std::size_t row_numbers = (width + 1) * hog_sums;
    std::fill_n(level.sums.begin(), row_numbers, std::uint16_t(0));
    std::array<std::vector<float>, 3> colors;  // of row y at y % 3
    for (auto& of_row : colors) of_row.resize(4 * width);
    image.write(0, colors[0]);
    HogRow row(level.width);
    const auto whole = [](float color) {  // rounded, as the colour is −1 … 1
        return std::uint16_t(int(color * color_unit + (color_unit + 0.5f)) - color_unit);
    };
    for (std::size_t y = 0; y < height; ++y) {
        if (y + 1 < height) image.write(y + 1, colors[(y + 1) % 3]);
        row.fill(colors[(y > 0 ? y - 1 : y) % 3], colors[y % 3], colors[std::min(y + 1, height - 1) % 3]);
        const float* color = colors[y % 3].data();
        const std::uint16_t* above = level.sums.data() + y * row_numbers;
        std::uint16_t* out = level.sums.data() + (y + 1) * row_numbers;
        std::fill_n(out, hog_sums, std::uint16_t(0));
        HogSums sum{};
        for (std::size_t x = 0; x < width; ++x, color += 4) {
            above += hog_sums, out += hog_sums;
            // each direction gets as much as a gradient is near it
            const float strength = std::sqrt(row.sq_strength[x / 4][x % 4]) * gradient_unit,
                        turn = row.turn[x / 4][x % 4];
            const int direction = int(turn), both = int(strength + 0.5f),
                      second = int(strength * (turn - float(direction)) + 0.5f);
            const EightShorts first_of = EightShorts{} + std::uint16_t(both - second),
                              second_of = EightShorts{} + std::uint16_t(second);
            const std::uint16_t *to_first = masks.of[direction], *to_second = masks.of[direction + 1];
            // colours are at the odd places of the last part
            sum[2] +=
                EightShorts{0, whole((color[0] + color[1] + color[2]) / 3), 0, whole(color[0] - color[1]),
                            0, whole((color[0] + color[1]) / 2 - color[2]), 0, 0};
#pragma GCC unroll 8
            for (std::size_t part = 0; part < sum.size(); ++part) {
                EightShorts one, other, total;
                std::memcpy(&one, to_first + 8 * part, sizeof(one));
                std::memcpy(&other, to_second + 8 * part, sizeof(other));
                sum[part] += (one & first_of) + (other & second_of);
                std::memcpy(&total, above + 8 * part, sizeof(total));
                total += sum[part];
                std::memcpy(out + 8 * part, &total, sizeof(total));
            }
        }
    }
}

}  // namespace detail

}  // namespace ism
