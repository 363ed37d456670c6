// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "ism/core/image.hpp"
#include "ism/feature/blur.hpp"
#include "ism/feature/range.hpp"
#include "ism/feature/scale_space_options.hpp"
#include "ism/feature/workspace.hpp"

namespace ism {

inline constexpr double min_resize = 1.0 / 16, max_resize = 16;  ///< factors by which images are resized
inline constexpr double max_resized_pixels = 1 << 27;            ///< of an image made larger, 512 MB

/// @brief The image at `factor` times its size, by bilinear interpolation. Pixel (x, y) of the result shows
/// the place (x / factor, y / factor) of `image`; its sides are ⌊(side − 1) · factor⌋ + 1. Before it is made
/// smaller the image, taken to have the blur `input_sigma` (pixels), is blurred until the result has it.
/// @throws Error where `factor`, `input_sigma` or the size of the result is out of range or the image has no
/// pixels.
[[nodiscard]] inline GrayImage resized(ImageView<const float> image, double factor, float input_sigma,
                                       Workspace& workspace) {
    detail::expect_range("resize factor", factor, min_resize, max_resize);
    detail::expect_range("input_sigma (pixels)", input_sigma, 0.0f, max_input_sigma);
    expect(!image.empty(), "image size", "at least 1x1", size_text(image));
    const double width = std::floor((image.width() - 1) * factor) + 1;
    const double height = std::floor((image.height() - 1) * factor) + 1;
    expect(factor <= 1 || width * height <= max_resized_pixels, "pixels of the resized image",
           lazy_text("at most ", max_resized_pixels), lazy_text(width, "x", height));
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
