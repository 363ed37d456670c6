// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>

#include "ism/evaluate/confusion.hpp"
#include "ism/show/svg.hpp"

namespace ism {

/// @brief A confusion matrix as an `svg` element: a square for each true class (rows) and class it was taken
/// for (columns, the last one "none"), the darker the larger the share of its row, with the number of images.
/// @throws Error where there is not one name a class.
[[nodiscard]] inline std::string to_svg(const Confusion& confusion, std::span<const std::string> class_names,
                                        const std::string& title) {
    expect(class_names.size() == confusion.class_count, "names of a confusion matrix", confusion.class_count,
           class_names.size());
    const double cell = 54, left = 96, top = 62;
    const std::size_t classes = confusion.class_count;
    const double width = left + cell * double(classes + 1) + 10, height = top + cell * double(classes) + 12;
    const auto number = [](double value) { return detail::svg_number(value); };
    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + number(width) + "\" height=\"" +
                      number(height) + "\" viewBox=\"0 0 " + number(width) + " " + number(height) +
                      "\" class=\"matrix\" role=\"img\" aria-label=\"" + escape_markup(title) +
                      "\" font-family=\"system-ui, sans-serif\" font-size=\"12\" fill=\"#333\">\n";
    svg +=
        detail::svg_text(width / 2, 18, title, "text-anchor=\"middle\" font-size=\"14\" font-weight=\"600\"");
    for (std::size_t found = 0; found <= classes; ++found)
        svg += detail::svg_text(left + cell * (double(found) + 0.5), top - 8,
                                found < classes ? class_names[found] : "none", "text-anchor=\"middle\"");
    for (std::size_t truth = 0; truth < classes; ++truth) {
        const double y = top + cell * double(truth);
        const double images = double(std::max<std::size_t>(1, confusion.images(truth)));
        svg += detail::svg_text(left - 8, y + cell / 2 + 4, class_names[truth], "text-anchor=\"end\"");
        for (std::size_t found = 0; found <= classes; ++found) {
            const std::size_t count = confusion.count(truth, found);
            const double x = left + cell * double(found);
            const Rgb color = mix(white, {20, 60, 130}, double(count) / images);
            svg += "<rect x=\"" + number(x) + "\" y=\"" + number(y) + "\" width=\"" + number(cell) +
                   "\" height=\"" + number(cell) + "\" fill=\"" + hex_color(color) +
                   "\" stroke=\"#d5d5de\"/>\n";
            svg += detail::svg_text(
                x + cell / 2, y + cell / 2 + 5, std::to_string(count),
                "text-anchor=\"middle\" font-size=\"14\" fill=\"" + hex_color(ink_on(color)) + "\"");
        }
    }
    return svg + "</svg>\n";
}

}  // namespace ism
