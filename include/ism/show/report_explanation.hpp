// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ism/detect/detection.hpp"
#include "ism/show/color.hpp"
#include "ism/show/explanation_maps.hpp"
#include "ism/show/feature_weights.hpp"
#include "ism/show/mask_path.hpp"
#include "ism/show/overlay_close_up.hpp"
#include "ism/show/report_picture.hpp"

namespace ism {

namespace detail {

/// Shapes drawn alike: a few steps of opacity, each one `path`, which keeps pages small.
class OpacitySteps {
public:
    static constexpr std::size_t steps = 5;
    /// @param opacity  0 … 1
    void add(double opacity, const std::string& path) {
        paths_[std::size_t(std::clamp(std::lround(opacity * (steps - 1)), 0L, long(steps - 1)))] += path;
    }
    /// @param attribute  "fill" or "stroke"
    [[nodiscard]] std::string svg(const std::string& attribute, Rgb color, double most,
                                  const std::string& more) const {
        std::string svg;
        for (std::size_t i = 0; i < steps; ++i)
            if (!paths_[i].empty())
                svg += "<path d=\"" + paths_[i] + "\" " + attribute + "=\"" + hex_color(color) + "\" " +
                       attribute + "-opacity=\"" + number_text(most * double(i + 1) / steps, 2) + "\" " +
                       more + "/>";
        return svg;
    }

private:
    std::array<std::string, steps> paths_;
};

/// A number of pixels to a tenth.
[[nodiscard]] inline std::string tenth(double px) {
    return number_text(std::round(10 * std::clamp(px, -1e5, 1e5)) / 10, 8);
}

/// The outline of a box as the `d` of a `path`.
[[nodiscard]] inline std::string rectangle_path(const Box& box) {
    return join_text('M', tenth(box.x), ' ', tenth(box.y), 'h', tenth(box.width), 'v', tenth(box.height),
                     'h') +
           join_text(tenth(-box.width), 'z');
}

/// A circle as the `d` of a `path`.
[[nodiscard]] inline std::string circle_path(Point2 centre, double radius) {
    const std::string r = tenth(radius), arc = join_text('a', r, ' ', r, " 0 1 0 ");
    return join_text('M', tenth(centre.x - radius), ' ', tenth(centre.y), arc, tenth(2 * radius), " 0", arc) +
           join_text(tenth(-2 * radius), " 0");
}

/// A veil over a part of a picture.
[[nodiscard]] inline std::string svg_veil(const Box& part, Rgb color, double opacity) {
    return svg_box(part,
                   "fill=\"" + hex_color(color) + "\" fill-opacity=\"" + number_text(opacity, 2) + "\"");
}

}  // namespace detail

/// @brief The features that vote for a detection, as circles with lines to its centre; the stronger the vote,
/// the clearer.
/// @throws Error where a vote points to a feature that is not there.
[[nodiscard]] inline ReportFigure votes_figure(std::shared_ptr<const ReportPicture> picture, const Box& part,
                                               const Detections& detections, const Detection& detection,
                                               double circle_scales, std::size_t most_features = 80) {
    const Rgb color = class_color(detection.class_index);
    std::vector<detail::FeatureWeight> weights = detail::feature_weights(detections, detection);
    const std::size_t all = weights.size();
    if (all > most_features) weights.erase(weights.begin(), weights.end() - std::ptrdiff_t(most_features));
    const double strongest = weights.empty() ? 1 : weights.back().weight;
    const std::string x = detail::tenth(detection.centre.x + 0.5),
                      y = detail::tenth(detection.centre.y + 0.5);
    detail::OpacitySteps lines, circles;
    for (const detail::FeatureWeight& w : weights) {
        const Feature& f = detections.features[w.feature];
        const double r = std::max(1.0, circle_scales * double(f.scale));
        const Point2 at{double(f.x) + 0.5, double(f.y) + 0.5};
        lines.add(w.weight / strongest,
                  join_text('M', detail::tenth(at.x), ' ', detail::tenth(at.y), 'L', x, ' ', y));
        circles.add(w.weight / strongest, detail::circle_path(at, r));
    }
    std::string shapes = detail::svg_veil(part, black, 0.45);
    shapes += lines.svg("stroke", color, 1, "fill=\"none\" stroke-width=\"1.5\"");
    shapes += circles.svg("stroke", mix(color, white, 0.6), 1, "fill=\"none\" stroke-width=\"1.5\"");
    shapes += svg_box(detection.box, "fill=\"none\" stroke=\"" + hex_color(color) + "\" stroke-width=\"2\"");
    shapes += "<circle cx=\"" + x + "\" cy=\"" + y + "\" r=\"" + detail::tenth(0.015 * part.width) +
              "\" fill=\"" + hex_color(mix(color, white, 0.4)) + "\" stroke=\"#000\"/>";
    const std::string caption =
        join_text(detection.support.size(), detection.support.size() == 1 ? " vote by " : " votes by ", all,
                  all == 1 ? " feature" : " features") +
        (all > most_features ? join_text("; the strongest ", most_features, " are drawn") : "");
    return {.caption = caption, .picture = std::move(picture), .part = part, .shapes = std::move(shapes)};
}

/// @brief The cells of a detection's template (Detection::cells) over the picture: green where they speak for
/// the class, red where against it.
/// @throws Error where the detection tells no cells.
[[nodiscard]] inline ReportFigure cells_figure(std::shared_ptr<const ReportPicture> picture, const Box& part,
                                               const Detection& detection) {
    const CellShares& cells = detection.cells;
    expect(!cells.shares.empty(), "cells of a detection", "1 or more", 0);
    detail::OpacitySteps good, bad;
    double score = 0;
    for (std::size_t i = 0; i < cells.shares.size(); ++i) {
        const Box cell = intersection(cells.grid.cell(cells.box, i), part);
        score += double(cells.shares[i]);
        if (!(cell.area() > 0)) continue;
        (cells.shares[i] > 0 ? good : bad)
            .add(detail::cell_pen(cells, i).opacity / 0.85, detail::rectangle_path(cell));
    }
    std::string shapes = detail::svg_veil(part, white, 0.55);
    shapes +=
        good.svg("fill", detail::for_color, 0.85, "") + bad.svg("fill", detail::against_color, 0.85, "");
    shapes += svg_box(cells.box, "fill=\"none\" stroke=\"#000\" stroke-width=\"2\"");
    return {.caption = join_text("template, score ", number_text(score, 3),
                                 ": green cells speak for the class, red ones against it"),
            .picture = std::move(picture),
            .part = part,
            .shapes = std::move(shapes)};
}

/// @brief What was cut out, in its dimmed surroundings.
[[nodiscard]] inline ReportFigure cut_out_figure(std::shared_ptr<const ReportPicture> picture,
                                                 const Box& part, const Detection& detection) {
    const Segmentation& cut = detection.segmentation;
    const std::string outline = mask_path(cut.mask, cut.x, cut.y);
    std::string shapes = join_text("<path d=\"", detail::rectangle_path(part), outline) +
                         "\" fill=\"#000\" fill-opacity=\".72\" fill-rule=\"evenodd\"/><path d=\"" + outline +
                         "\" fill=\"none\" stroke=\"" + hex_color(class_color(detection.class_index)) +
                         "\" stroke-width=\"2\"/>";
    return {.caption = mask_area(cut.mask) > 0 ? "cut out" : "nothing was cut out",
            .picture = std::move(picture),
            .part = part,
            .shapes = std::move(shapes)};
}

/// @brief The maps p(figure) and p(ground) of a detection in a part of a width × height image, both on one
/// scale whose brightest value stands in the caption.
/// @throws Error where the segmentation's parts differ in size.
[[nodiscard]] inline std::vector<ReportFigure> map_figures(const Box& part, const Detections& detections,
                                                           const Detection& detection) {
    const Detections there = detail::moved_to(detections, detection, int(part.x), int(part.y));
    const Segmentation& cut = there.objects.front().segmentation;
    check(cut);
    float top = 0;
    for (const GrayImage* map : {&cut.figure, &cut.ground})
        for (const float value : map->pixels()) top = std::max(top, value);
    std::vector<ReportFigure> figures;
    for (const auto& [map, name] :
         {std::pair(&cut.figure, join_text("p(figure), brightest ", number_text(double(top), 2))),
          std::pair(&cut.ground, std::string("p(ground), same scale"))}) {
        const RgbImage colors =
            detail::map_panel(cut, *map, double(top), int(part.width), int(part.height), 1, heat_color);
        figures.push_back(picture_figure(report_picture(colors, {.side_px = 96, .most_bytes = 2500}), name));
    }
    return figures;
}

}  // namespace ism
