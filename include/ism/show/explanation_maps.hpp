// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>

#include "ism/detect/detection.hpp"
#include "ism/show/draw.hpp"

namespace ism::detail {

/// Cells that speak for a class, and those that speak against it.
inline constexpr Rgb for_color{40, 190, 80}, against_color{235, 50, 50};

/// How a cell is drawn: the stronger it speaks, beside the strongest, the more it covers.
[[nodiscard]] inline Pen cell_pen(const CellShares& cells, std::size_t i) {
    float most = 1e-9f;
    for (const float share : cells.shares) most = std::max(most, std::abs(share));
    const float share = cells.shares[i];
    return {.color = share > 0 ? for_color : against_color, .opacity = 0.85 * double(std::abs(share) / most)};
}

/// A map of a segmentation as colours over the whole image; `top` is the brightest value.
template <std::invocable<double> Colors>
[[nodiscard]] RgbImage map_panel(const Segmentation& part, const GrayImage& map, double top, int width,
                                 int height, int factor, const Colors& color_of) {
    RgbImage panel(width * factor, height * factor, color_of(0.0));
    for (int y = 0; y < panel.height(); ++y)
        for (int x = 0; x < panel.width(); ++x) {
            const double u = (x + 0.5) / factor - 0.5 - part.x, v = (y + 0.5) / factor - 0.5 - part.y;
            if (top > 0 && u > -0.5 && v > -0.5 && u < map.width() - 0.5 && v < map.height() - 0.5)
                panel(x, y) = color_of(double(sample_bilinear(map, float(u), float(v))) / top);
        }
    return panel;
}

}  // namespace ism::detail
