// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "ism/core/random.hpp"
#include "ism/train/training_image.hpp"

namespace ism::test {

/// @brief A drawn picture (synthetic) of 200 × 160 px with a square of 80 px, whose pattern of blobs tells
/// the class, on a faint noise. The square is 1 m away, what is behind it 2 m.
/// @param left, top  of the square
/// @param seed       of the noise
[[nodiscard]] inline TrainingImage pattern_picture(std::uint32_t class_index, int left, int top,
                                                   std::uint64_t seed, bool with_depth = true) {
    constexpr int width = 200, height = 160, side = 80;
    Random noise(seed), pattern(100 + class_index);
    TrainingImage image;
    image.name = "picture " + std::to_string(seed);
    image.frame.gray = GrayImage(width, height, 0.5f);
    for (float& v : image.frame.gray.pixels()) v += float(0.01 * noise.normal());
    Mask mask(width, height);
    if (with_depth) image.frame.depth_m = DepthMap(width, height, 2.0f);
    image.frame.camera = Camera{200, 200, 99.5, 79.5};
    for (int blob = 0; blob < 40; ++blob) {
        const double x = left + pattern.uniform(8, side - 8), y = top + pattern.uniform(8, side - 8);
        const double sigma = pattern.uniform(1.5, 5), height_of = pattern.uniform() < 0.5 ? -0.4 : 0.4;
        for (int v = 0; v < height; ++v)
            for (int u = 0; u < width; ++u)
                image.frame.gray(u, v) += float(
                    height_of * std::exp(-((u - x) * (u - x) + (v - y) * (v - y)) / (2 * sigma * sigma)));
    }
    for (int v = top; v < top + side; ++v)
        for (int u = left; u < left + side; ++u) {
            mask(u, v) = 1;
            if (with_depth) image.frame.depth_m(u, v) = 1.0f;
        }
    image.objects.push_back({class_index, {double(left), double(top), side, side}, mask});
    return image;
}

}  // namespace ism::test
