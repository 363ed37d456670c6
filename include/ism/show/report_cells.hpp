// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "ism/io/png.hpp"
#include "ism/show/overlay_cells.hpp"
#include "ism/show/overlay_close_up.hpp"
#include "ism/show/report.hpp"
#include "ism/show/svg.hpp"

namespace ism {

/// @brief The cells of a detection's template (Detection::cells) over the grey image around its box, green
/// where they speak for the class, red where against it; each tells its share of the score.
/// @throws Error where the detection tells no cells.
[[nodiscard]] inline ReportPlot cells_plot(ImageView<const Rgb> image, const Detection& detection) {
    const CellShares& cells = detection.cells;
    expect(!cells.shares.empty(), "cells of a detection", "1 or more", 0);
    Detection alone;  // without what votes for it, which may lie far off
    alone.box = detection.box, alone.centre = detection.box.centre();
    const Box part = detail::surroundings({}, alone, image.width(), image.height(), 0);
    RgbImage grey(int(part.width), int(part.height));
    for (int y = 0; y < grey.height(); ++y)
        for (int x = 0; x < grey.width(); ++x)
            grey(x, y) = mix(grey_color(brightness(image(int(part.x) + x, int(part.y) + y))), white, 0.25);

    const double zoom = 360 / std::max(part.width, part.height), width = std::max(200.0, zoom * part.width);
    const double height = zoom * part.height;
    const auto number = [](double value) { return detail::svg_number(value); };
    const auto rectangle = [&](const Box& box, const std::string& more) {
        return "<rect x=\"" + number(zoom * (box.x - part.x)) + "\" y=\"" + number(zoom * (box.y - part.y)) +
               "\" width=\"" + number(zoom * box.width) + "\" height=\"" + number(zoom * box.height) + "\" " +
               more;
    };
    std::string svg =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + number(width) + "\" height=\"" +
        number(height + 52) + "\" viewBox=\"0 0 " + number(width) + " " + number(height + 52) +
        "\" font-family=\"system-ui, sans-serif\" font-size=\"13\" fill=\"#333\">\n<image width=\"" +
        number(zoom * part.width) + "\" height=\"" + number(height) + "\" href=\"data:image/png;base64," +
        base64(encode_png(grey)) + "\"/>\n";
    double score = 0;
    for (std::size_t i = 0; i < cells.shares.size(); ++i) {
        const Pen pen = detail::cell_pen(cells, i);
        score += double(cells.shares[i]);
        svg += rectangle(intersection(cells.grid.cell(detection.box, i), part),
                         "fill=\"" + hex_color(pen.color) + "\" fill-opacity=\"" + number(pen.opacity) +
                             "\"><title>" + number_text(double(cells.shares[i]), 2) + "</title></rect>\n");
    }
    svg += rectangle(detection.box, "fill=\"none\" stroke=\"#000\" stroke-width=\"2\"/>\n");
    double x = 0;
    for (const auto& [word, color] :
         {std::pair("for", detail::for_color), std::pair("against", detail::against_color)}) {
        svg += "<rect x=\"" + number(x) + "\" y=\"" + number(height + 8) +
               "\" width=\"14\" height=\"14\" fill=\"" + hex_color(color) + "\"/>\n";
        svg += detail::svg_text(x + 19, height + 20, word, "");
        x += 55;
    }
    svg += detail::svg_text(0, height + 43, "cells of the template, together " + number_text(score, 3), "");
    return {svg + "</svg>\n"};
}

}  // namespace ism
