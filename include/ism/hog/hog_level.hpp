// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include "ism/core/vector.hpp"

namespace ism {

inline constexpr std::size_t hog_directions = 18;  ///< of gradients, over the full circle
inline constexpr std::size_t hog_sums = 24;        ///< directions, three means of colour, and nothing

/// @brief Gradients and colours of an image at one resolution, as sums over all pixels above and to the left:
/// four of them give the sum over any rectangle (Viola and Jones 2001; for gradients Porikli 2005).
struct HogLevel {
    int width = 0, height = 0;  ///< pixels of the level
    std::span<float> sums;      ///< count(width, height) numbers: detail::HogSums

    /// @brief How many numbers a level has: hog_sums for each corner of a pixel.
    [[nodiscard]] static std::size_t count(int width, int height) {
        return std::size_t(width + 1) * std::size_t(height + 1) * hog_sums;
    }
    [[nodiscard]] const float* at(int x, int y) const {
        return sums.data() + (std::size_t(y) * std::size_t(width + 1) + std::size_t(x)) * hog_sums;
    }
};

namespace detail {

/// No longer, since GCC compares number after number where a vector has no instruction of its own, and
/// without flags x86 has none for eight.
using FourFloats = Vector<float, 4>;
/// The sums of a place: directions 0 … 7, their opposites 9 … 16, and then 8, 17, three colours and zeros.
using HogSums = std::array<FourFloats, hog_sums / 4>;

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
    std::vector<FourFloats> x, y, strength, turn;

    explicit HogRow(int width)
        : x((std::size_t(width) + 3) / 4), y(x.size()), strength(x.size()), turn(x.size()) {}

    /// Those of row `at` of an image of three numbers a pixel.
    void fill(const std::vector<float>& rgb, int width, int height, int at) {
        const auto row_at = [&](int r) {
            return rgb.data() + std::size_t(std::clamp(r, 0, height - 1)) * std::size_t(width) * 3;
        };
        const float *row = row_at(at), *above = row_at(at - 1), *below = row_at(at + 1);
        for (int i = 0; i < width; ++i) {
            const float *left = row + std::max(0, i - 1) * 3, *right = row + std::min(width - 1, i + 1) * 3;
            float best_x = 0, best_y = 0, most = -1;
            for (int k = 0; k < 3; ++k) {
                const float gx = right[k] - left[k], gy = below[i * 3 + k] - above[i * 3 + k];
                const float sq = gx * gx + gy * gy;
                const bool stronger = sq > most;
                most = stronger ? sq : most, best_x = stronger ? gx : best_x, best_y = stronger ? gy : best_y;
            }
            const auto block = std::size_t(i) / 4, lane = std::size_t(i) % 4;
            x[block][lane] = best_x, y[block][lane] = best_y, strength[block][lane] = std::sqrt(most);
        }
        for (std::size_t block = 0; block < x.size(); ++block)
            take_directions(x[block], y[block], turn[block]);
    }
};

/// One level, whose size is set and whose sums are uninitialised, from its colours, three numbers a pixel.
inline void fill_level(HogLevel& level, const std::vector<float>& rgb) {
    // Each direction gets as much as a gradient is near it; behind the last comes the first.
    constexpr float none = 99;
    static constexpr HogSums directions = {{{0, 1, 2, 3},
                                            {4, 5, 6, 7},
                                            {9, 10, 11, 12},
                                            {13, 14, 15, 16},
                                            {8, 17, none, none},
                                            {none, none, none, none}}};
    static constexpr FourFloats behind_last = {18, 1, 2, 3};
    const int width = level.width, height = level.height;
    const std::size_t row_numbers = std::size_t(width + 1) * hog_sums;
    std::fill_n(level.sums.begin(), row_numbers, 0.0f);
    HogRow row(width);
    for (int y = 0; y < height; ++y) {
        row.fill(rgb, width, height, y);
        const float* color = rgb.data() + std::size_t(y) * std::size_t(width) * 3;
        const float* above = level.sums.data() + std::size_t(y) * row_numbers;
        float* out = level.sums.data() + std::size_t(y + 1) * row_numbers;
        std::fill_n(out, hog_sums, 0.0f);
        HogSums sum{};
        for (int x = 0; x < width; ++x, color += 3) {
            above += hog_sums, out += hog_sums;
            const auto block = std::size_t(x) / 4, lane = std::size_t(x) % 4;
            const float strength = row.strength[block][lane], turn = row.turn[block][lane];
#pragma GCC unroll 8
            for (std::size_t part = 0; part < sum.size(); ++part) {
                const bool around = part == 0 && turn > float(hog_directions - 1);
                const FourFloats away = (around ? behind_last : directions[part]) - turn;
                const FourFloats near = 1.0f - (away > 0 ? away : -away);
                sum[part] += strength * (near > 0 ? near : FourFloats{});
            }
            sum[4] += FourFloats{0, 0, (color[0] + color[1] + color[2]) / 3, color[0] - color[1]};
            sum[5] += FourFloats{(color[0] + color[1]) / 2 - color[2], 0, 0, 0};
#pragma GCC unroll 8
            for (std::size_t part = 0; part < sum.size(); ++part) {
                FourFloats total;
                std::memcpy(&total, above + 4 * part, sizeof(total));
                total += sum[part];
                std::memcpy(out + 4 * part, &total, sizeof(total));
            }
        }
    }
}

}  // namespace detail

}  // namespace ism
