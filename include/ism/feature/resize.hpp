// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "ism/core/image.hpp"
#include "ism/feature/blur.hpp"
#include "ism/feature/workspace.hpp"

namespace ism {

/// @brief The image at `factor` times its size, by bilinear interpolation. Pixel (x, y) of the result shows
/// the place (x / factor, y / factor) of `image`; its sides are ⌊(side − 1) · factor⌋ + 1. Before it is made
/// smaller the image, taken to have the blur `input_sigma` (pixels), is blurred until the result has it.
/// @throws Error where `factor` is not a positive number or the image has no pixels.
[[nodiscard]] inline GrayImage resized(ImageView<const float> image, double factor, float input_sigma,
                                       Workspace& workspace) {
    expect(std::isfinite(factor) && factor > 0, "resize factor", "a positive number", factor);
    expect(!image.empty(), "image size", "at least 1x1", size_text(image));
    const double width = std::floor((image.width() - 1) * factor) + 1;
    const double height = std::floor((image.height() - 1) * factor) + 1;
    expect(width <= 1 << 16 && height <= 1 << 16, "resized image size", "at most 65536x65536",
           lazy_text(width, "x", height));
    GrayImage smooth;
    const double missing = input_sigma * std::sqrt(std::max(0.0, 1 / (factor * factor) - 1));
    if (missing > 0.01) {
        smooth = workspace.image(image.width(), image.height());
        blur(image, workspace.kernel(missing), smooth, workspace);
        image = smooth;
    }
    GrayImage out = workspace.image(static_cast<int>(width), static_cast<int>(height));
    workspace.pool().for_each(std::size_t(out.height()), [&](std::size_t row, unsigned) {
        for (int x = 0; x < out.width(); ++x)
            out(x, int(row)) = sample_bilinear(image, float(x / factor), float(double(row) / factor));
    });
    workspace.reuse(std::move(smooth));
    return out;
}

}  // namespace ism
