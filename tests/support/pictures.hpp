// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "ism/core/random.hpp"
#include "ism/train/training_image.hpp"

namespace ism::test {

/// @brief A drawn picture (synthetic) of 200 × 160 px with a square of 80 px, whose pattern of blobs tells
/// the class, on a faint noise. The square is 1 m away, what is behind it 2 m.
/// @param left, top  of the square, before it is turned
/// @param seed       of the noise
/// @param angle      by which the square is turned about its centre, radians from x towards y
[[nodiscard]] inline TrainingImage pattern_picture(std::uint32_t class_index, int left, int top,
                                                   std::uint64_t seed, bool with_depth = true,
                                                   double angle = 0) {
    constexpr int width = 200, height = 160, side = 80;
    const double centre_x = left + side / 2, centre_y = top + side / 2;
    const double cosine = std::cos(angle), sine = std::sin(angle);
    Random noise(seed), pattern(100 + class_index);
    TrainingImage image;
    image.name = "picture " + std::to_string(seed);
    image.frame.gray = GrayImage(width, height, 0.5f);
    for (float& v : image.frame.gray.pixels()) v += float(0.01 * noise.normal());
    Mask mask(width, height);
    if (with_depth) image.frame.depth_m = DepthMap(width, height, 2.0f);
    image.frame.camera = Camera{200, 200, 99.5, 79.5};
    for (int blob = 0; blob < 40; ++blob) {
        const double from_left = pattern.uniform(8, side - 8), from_top = pattern.uniform(8, side - 8);
        const double x = centre_x + cosine * (from_left - side / 2) - sine * (from_top - side / 2);
        const double y = centre_y + sine * (from_left - side / 2) + cosine * (from_top - side / 2);
        const double sigma = pattern.uniform(1.5, 5), height_of = pattern.uniform() < 0.5 ? -0.4 : 0.4;
        const int reach = int(5 * sigma) + 1;  // beyond it a blob is nothing
        for (int v = std::max(0, int(y) - reach); v < std::min(height, int(y) + reach); ++v)
            for (int u = std::max(0, int(x) - reach); u < std::min(width, int(x) + reach); ++u)
                image.frame.gray(u, v) += float(
                    height_of * std::exp(-((u - x) * (u - x) + (v - y) * (v - y)) / (2 * sigma * sigma)));
    }
    for (int v = 0; v < height; ++v)
        for (int u = 0; u < width; ++u) {
            const double x = u + 0.5 - centre_x, y = v + 0.5 - centre_y;
            if (std::abs(cosine * x + sine * y) > side / 2 || std::abs(cosine * y - sine * x) > side / 2)
                continue;
            mask(u, v) = 1;
            if (with_depth) image.frame.depth_m(u, v) = 1.0f;
        }
    const double reach = side * (std::abs(cosine) + std::abs(sine));
    image.objects.push_back({class_index, box_around({centre_x, centre_y}, reach, reach), mask});
    return image;
}

}  // namespace ism::test
