// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "ism/show/color.hpp"
#include "ism/show/markup.hpp"

namespace ism {

/// @brief A curve of a plot: points (x[i], y[i]) joined by lines; a single point is a dot, a point that is
/// not finite a gap.
struct PlotCurve {
    std::string name = {};  ///< in the legend
    std::vector<double> x = {}, y = {};
    Rgb color = {};
};

/// @brief One end of an axis to the other.
struct PlotRange {
    double low = 0, high = 1;
};

/// @brief A line plot.
struct Plot {
    std::string title = {};
    std::string x_label = {}, y_label = {};
    PlotRange x_range = {}, y_range = {};
    std::vector<PlotCurve> curves = {};
    int width_px = 480, height_px = 360;  ///< of axes and title; the legend comes below
};

namespace detail {

/// Round numbers in a range, about five.
[[nodiscard]] inline std::vector<double> axis_ticks(const PlotRange& range) {
    const double rough = (range.high - range.low) / 5;
    const double power = std::pow(10, std::floor(std::log10(rough)));
    double step = 10 * power;
    for (const double factor : {5.0, 2.0, 1.0})
        if (factor * power >= rough * 0.999) step = factor * power;
    std::vector<double> ticks;
    const double first = std::ceil(range.low / step - 1e-9);
    for (int i = 0; i <= 10 && (first + i) * step <= range.high + 1e-9 * step; ++i)
        ticks.push_back((first + i) * step + 0.0);  // + 0: not −0
    return ticks;
}

/// A position in an image, to a hundredth of a pixel.
[[nodiscard]] inline std::string svg_number(double value) {
    return number_text(std::round(std::clamp(value, -1e5, 1e5) * 100) / 100, 8);
}

/// `text` at (x, y); `more` are further attributes.
[[nodiscard]] inline std::string svg_text(double x, double y, const std::string& text,
                                          const std::string& more) {
    return "<text x=\"" + svg_number(x) + "\" y=\"" + svg_number(y) + "\" " + more + ">" +
           escape_markup(text) + "</text>\n";
}

[[nodiscard]] inline std::string svg_line(double x1, double y1, double x2, double y2,
                                          const std::string& more) {
    return "<line x1=\"" + svg_number(x1) + "\" y1=\"" + svg_number(y1) + "\" x2=\"" + svg_number(x2) +
           "\" y2=\"" + svg_number(y2) + "\" " + more + "/>\n";
}

}  // namespace detail

/// @brief The plot as an `svg` element: title, axes with ticks and a grid, curves cut off at the axes,
/// legend.
/// @throws Error where a range is empty or not finite, a curve has unlike numbers of x and y, or the plot is
/// smaller than 160×120.
[[nodiscard]] inline std::string to_svg(const Plot& plot) {
    for (const PlotRange& range : {plot.x_range, plot.y_range})
        expect(std::isfinite(range.high - range.low) && range.high > range.low, "range of a plot",
               "low below high", lazy_text(range.low, " to ", range.high));
    expect(plot.width_px >= 160 && plot.height_px >= 120, "plot size", "at least 160x120",
           lazy_text(plot.width_px, "x", plot.height_px));
    const double left = 58, right = plot.width_px - 14.0, top = 34, bottom = plot.height_px - 48.0;
    const auto px = [&](double x) {
        return left + (x - plot.x_range.low) / (plot.x_range.high - plot.x_range.low) * (right - left);
    };
    const auto py = [&](double y) {
        return bottom - (y - plot.y_range.low) / (plot.y_range.high - plot.y_range.low) * (bottom - top);
    };
    const int height = plot.height_px + 20 * int(plot.curves.size());
    const std::string size = join_text(plot.width_px, "\" height=\"", height);
    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + size + "\" viewBox=\"0 0 " +
                      join_text(plot.width_px, " ", height) + "\" class=\"plot\" role=\"img\" aria-label=\"" +
                      escape_markup(plot.title) +
                      "\" font-family=\"system-ui, sans-serif\" font-size=\"13\" fill=\"#333\">\n";
    svg += "<rect width=\"" + size + "\" fill=\"#fff\"/>\n";
    svg += detail::svg_text((left + right) / 2, 20, plot.title,
                            "text-anchor=\"middle\" font-size=\"15\" font-weight=\"600\"");
    for (const double tick : detail::axis_ticks(plot.x_range)) {
        svg += detail::svg_line(px(tick), top, px(tick), bottom, "stroke=\"#e4e4ea\"");
        svg += detail::svg_text(px(tick), bottom + 17, number_text(tick), "text-anchor=\"middle\"");
    }
    for (const double tick : detail::axis_ticks(plot.y_range)) {
        svg += detail::svg_line(left, py(tick), right, py(tick), "stroke=\"#e4e4ea\"");
        svg += detail::svg_text(left - 7, py(tick) + 4.5, number_text(tick), "text-anchor=\"end\"");
    }
    svg += "<path d=\"M" + detail::svg_number(left) + " " + detail::svg_number(top) + "V" +
           detail::svg_number(bottom) + "H" + detail::svg_number(right) +
           "\" fill=\"none\" stroke=\"#555\"/>\n";
    svg += detail::svg_text((left + right) / 2, bottom + 37, plot.x_label, "text-anchor=\"middle\"");
    const std::string middle = detail::svg_number((top + bottom) / 2);
    svg += detail::svg_text(15, (top + bottom) / 2, plot.y_label,
                            "text-anchor=\"middle\" transform=\"rotate(-90 15 " + middle + ")\"");

    // an inner <svg> cuts its content off at its own edge
    svg += "<svg x=\"" + detail::svg_number(left) + "\" y=\"" + detail::svg_number(top - 2) + "\" width=\"" +
           detail::svg_number(right - left + 2) + "\" height=\"" + detail::svg_number(bottom - top + 4) +
           "\" viewBox=\"" + detail::svg_number(left) + " " + detail::svg_number(top - 2) + " " +
           detail::svg_number(right - left + 2) + " " + detail::svg_number(bottom - top + 4) + "\">\n";
    for (const PlotCurve& curve : plot.curves) {
        expect(curve.x.size() == curve.y.size(), lazy_text("curve '", curve.name, "': numbers of y"),
               curve.x.size(), curve.y.size());
        std::string path;
        bool pen_down = false;
        for (std::size_t i = 0; i < curve.x.size(); ++i) {
            const bool point = std::isfinite(curve.x[i]) && std::isfinite(curve.y[i]);
            if (point)
                path += std::string(pen_down ? "L" : "M") + detail::svg_number(px(curve.x[i])) + " " +
                        detail::svg_number(py(curve.y[i]));
            if (point && !pen_down) path += "h0";  // a dot where no line follows
            pen_down = point;
        }
        if (!path.empty())
            svg += "<path d=\"" + path + "\" fill=\"none\" stroke=\"" + hex_color(curve.color) +
                   "\" stroke-width=\"2.5\" stroke-linejoin=\"round\" stroke-linecap=\"round\"/>\n";
    }
    svg += "</svg>\n";
    for (std::size_t i = 0; i < plot.curves.size(); ++i) {
        const double y = plot.height_px + 20 * double(i) + 5;
        svg += detail::svg_line(left, y, left + 24, y,
                                "stroke=\"" + hex_color(plot.curves[i].color) + "\" stroke-width=\"4\"");
        svg += detail::svg_text(left + 32, y + 4.5, plot.curves[i].name, "");
    }
    return svg + "</svg>\n";
}

}  // namespace ism
