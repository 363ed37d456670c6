// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>

#include "ism/core/image.hpp"
#include "ism/show/color.hpp"

namespace ism {

/// @brief Mixes a colour into the figure pixels of a mask that lies over the whole image.
/// @throws Error where the sizes differ.
inline void blend_mask(ImageView<Rgb> image, ImageView<const std::uint8_t> mask, Rgb color, double opacity) {
    expect(image.width() == mask.width() && image.height() == mask.height(), "mask size", size_text(image),
           size_text(mask));
    for (int y = 0; y < mask.height(); ++y)
        for (int x = 0; x < mask.width(); ++x)
            if (mask(x, y) != 0) image(x, y) = mix(image(x, y), color, opacity);
}

/// @brief Paints the figure pixels that have ground, or the image's edge, within `width_px` pixels.
/// @throws Error where the sizes differ.
inline void draw_contour(ImageView<Rgb> image, ImageView<const std::uint8_t> mask, Rgb color,
                         int width_px = 1) {
    expect(image.width() == mask.width() && image.height() == mask.height(), "mask size", size_text(image),
           size_text(mask));
    const auto is_figure = [&](int x, int y) { return mask.contains(x, y) && mask(x, y) != 0; };
    const auto paint_around = [&](int x, int y) {
        for (int v = -width_px; v <= width_px; ++v)
            for (int u = -width_px; u <= width_px; ++u)
                if (u * u + v * v <= width_px * width_px && is_figure(x + u, y + v))
                    image(x + u, y + v) = color;
    };
    // The nearest ground of a figure pixel always has a figure pixel beside it.
    for (int y = -1; y <= mask.height(); ++y)
        for (int x = -1; x <= mask.width(); ++x)
            if (!is_figure(x, y) &&
                (is_figure(x - 1, y) || is_figure(x + 1, y) || is_figure(x, y - 1) || is_figure(x, y + 1)))
                paint_around(x, y);
}

/// @brief An image made `factor` times as wide and high: smooth between pixels.
/// @throws Error where `factor` is below 1.
[[nodiscard]] inline RgbImage magnified(ImageView<const Rgb> image, int factor) {
    expect(factor >= 1, "magnification", "1 or more", factor);
    RgbImage large(image.width() * factor, image.height() * factor);
    if (factor == 1) {
        for (int y = 0; y < image.height(); ++y)
            std::copy_n(image.row(y).begin(), image.width(), large.row(y).begin());
        return large;
    }
    for (int y = 0; y < large.height(); ++y)
        for (int x = 0; x < large.width(); ++x) {
            const double u = std::clamp((x + 0.5) / factor - 0.5, 0.0, image.width() - 1.0);
            const double v = std::clamp((y + 0.5) / factor - 0.5, 0.0, image.height() - 1.0);
            const int x0 = int(u), y0 = int(v);
            const int x1 = std::min(x0 + 1, image.width() - 1), y1 = std::min(y0 + 1, image.height() - 1);
            large(x, y) = mix(mix(image(x0, y0), image(x1, y0), u - x0),
                              mix(image(x0, y1), image(x1, y1), u - x0), v - y0);
        }
    return large;
}

}  // namespace ism
