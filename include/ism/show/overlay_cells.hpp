// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

#include "ism/detect/detection.hpp"
#include "ism/show/explanation_maps.hpp"
#include "ism/show/overlay_panels.hpp"

namespace ism::detail {

/// The cells of a detection's template over its grey image.
/// @param large  the magnified image
/// @param box    that the template judged, magnified
[[nodiscard]] inline RgbImage cells_panel(RgbImage large, const CellShares& cells, const Box& box) {
    for (Rgb& pixel : large.pixels()) pixel = mix(grey_color(brightness(pixel)), white, 0.25);
    for (std::size_t i = 0; i < cells.shares.size(); ++i) {
        const Pen pen = cell_pen(cells, i);
        const Box cell = cells.grid.cell(box, i);
        fill_box(large, {cell.x + 0.5, cell.y + 0.5, cell.width - 1, cell.height - 1}, pen.color,
                 pen.opacity);
    }
    draw_box(large, box, {black, double(pen_px(large.width())), 0.8});
    return large;
}

/// What the colours of cells mean, behind the words of a caption.
inline void draw_cells_legend(ImageView<Rgb> caption, std::string_view before, const Font& font,
                              double line_px) {
    double x = std::ceil(font.width(before, line_px)) + line_px / 2;
    for (const auto& [word, color] : {std::pair("for", for_color), std::pair("against", against_color)}) {
        const double width = std::ceil(font.width(word, line_px)) + line_px / 2;
        fill_box(caption, {x, 0, width, line_px + 2}, color);
        font.draw(caption, x + line_px / 4, 1, word, ink_on(color), line_px);
        x += width;
    }
}

}  // namespace ism::detail
