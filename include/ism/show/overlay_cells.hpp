// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

#include "ism/detect/detection.hpp"
#include "ism/show/overlay_panels.hpp"

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

/// The cells of a detection's template over its grey image.
/// @param large  the magnified image
/// @param box    of the detection, magnified
[[nodiscard]] inline RgbImage cells_panel(RgbImage large, const CellShares& cells, const Box& box) {
    for (Rgb& pixel : large.pixels()) pixel = mix(grey_color(brightness(pixel)), white, 0.25);
    for (std::size_t i = 0; i < cells.shares.size(); ++i) {
        const Pen pen = cell_pen(cells, i);
        const Box cell = cells.grid.cell(box, i);
        fill_box(large, {cell.x + 0.5, cell.y + 0.5, cell.width - 1, cell.height - 1}, pen.color,
                 pen.opacity);
    }
    draw_box(large, box, {black, double(letter_size(large.width())), 0.8});
    return large;
}

/// What the colours of cells mean, behind the words of a caption.
inline void draw_cells_legend(ImageView<Rgb> caption, std::string_view before, int size) {
    int x = text_width(before, size) + font_step * size;
    for (const auto& [word, color] : {std::pair("for", for_color), std::pair("against", against_color)}) {
        const int width = text_width(word, size) + 4 * size;
        fill_box(caption, {double(x), 0, double(width), double((font_height + 4) * size)}, color);
        draw_text(caption, x + 2 * size, 2 * size, word, ink_on(color), size);
        x += width;
    }
}

}  // namespace ism::detail
