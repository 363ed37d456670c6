// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "ism/core/image.hpp"
#include "ism/core/parallel.hpp"
#include "ism/feature/blur.hpp"

namespace ism {

/// @brief The image at `factor` times its size, by bilinear interpolation. Pixel (x, y) of the result shows
/// the place (x / factor, y / factor) of `image`; its sides are ⌊(side − 1) · factor⌋ + 1. Before it is made
/// smaller the image, taken to have the blur `input_sigma` (pixels), is blurred until the result has it.
/// @throws Error where `factor` is not a positive number or the image has no pixels.
[[nodiscard]] inline GrayImage resized(ImageView<const float> image, double factor, float input_sigma = 0.5f,
                                       unsigned threads = 1) {
    expect(std::isfinite(factor) && factor > 0, "resize factor", "a positive number", factor);
    expect(!image.empty(), "image size", "at least 1x1", size_text(image));
    const double width = std::floor((image.width() - 1) * factor) + 1;
    const double height = std::floor((image.height() - 1) * factor) + 1;
    expect(width <= 1 << 16 && height <= 1 << 16, "resized image size", "at most 65536x65536",
           join_text(width, "x", height));
    GrayImage smooth;
    const double missing = input_sigma * std::sqrt(std::max(0.0, 1 / (factor * factor) - 1));
    if (missing > 0.01) {
        smooth = GrayImage(image.width(), image.height());
        blur(image, gaussian_kernel(missing), smooth, threads);
        image = smooth;
    }
    GrayImage out(static_cast<int>(width), static_cast<int>(height));
    parallel_for(std::size_t(out.height()), threads, [&](std::size_t row) {
        for (int x = 0; x < out.width(); ++x)
            out(x, int(row)) = sample_bilinear(image, float(x / factor), float(double(row) / factor));
    });
    return out;
}

}  // namespace ism
