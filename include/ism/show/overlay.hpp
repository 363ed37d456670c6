// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ism/core/number_text.hpp"
#include "ism/show/overlay_cells.hpp"
#include "ism/show/overlay_close_up.hpp"
#include "ism/show/overlay_panels.hpp"
#include "ism/show/shrunk.hpp"

namespace ism {

/// @brief How overlays look.
struct OverlayOptions {
    int side_px = 640;         ///< small images are magnified a whole number of times up to this longer side
    bool close_up = true;      ///< rows show a detection and its surroundings instead of the whole image
    double circle_scales = 3;  ///< radius of a feature's circle in multiples of its scale
    bool cells = true;         ///< rows also show what a template saw, where a detection tells it
    int panel_px = 1280;       ///< longer side of the largest panel of a row; larger ones are made smaller
    const Font* font = nullptr;  ///< of names and captions, such as system_font(); none = without words
};

namespace detail {

/// The panels side by side on white, each under its caption where there is a font.
[[nodiscard]] inline RgbImage captioned_row(std::span<const RgbImage> panels,
                                            std::span<const std::string> captions, const Font& font) {
    const int width = panels[0].width(), height = panels[0].height(), line = words_px(width);
    const int gap = 4 * pen_px(width), head = font.empty() ? 0 : line + 4;
    RgbImage row(int(panels.size()) * (width + gap) - gap, head + height, white);
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const int x0 = int(i) * (width + gap);
        font.draw(row.view().region(x0, 0, width, head), 0, 1, captions[i], {40, 40, 48}, line);
        for (int y = 0; y < height; ++y)
            std::copy_n(panels[i].row(y).begin(), width, row.row(head + y).begin() + x0);
    }
    return row;
}

/// The row of draw_explanation() for the whole image.
[[nodiscard]] inline RgbImage panel_row(ImageView<const Rgb> image, const Detections& detections,
                                        const Detection& detection, std::span<const std::string> class_names,
                                        const OverlayOptions& options) {
    const Font nothing;
    const Font& font = options.font ? *options.font : nothing;
    const Segmentation& part = detection.segmentation;
    check(part);
    const int factor = detail::magnification(image, options.side_px);
    const int width = image.width(), height = image.height();
    const Rgb color = class_color(detection.class_index);
    const RgbImage large = magnified(image, factor);
    const Box box = detail::magnified(detection.box, factor);
    const double pen = detail::pen_px(large.width());

    RgbImage votes = large;
    for (Rgb& pixel : votes.pixels()) pixel = mix(pixel, black, 0.4);
    detail::draw_support(votes, detections, detection, color, options.circle_scales, factor);
    draw_box(votes, box, {color, pen});
    std::vector<Box> used;
    const std::string& name = detail::name_of(detection, class_names);
    if (!font.empty()) detail::draw_label(votes, box, detection, name, font, used);

    float top = 0;
    for (const GrayImage* map : {&part.figure, &part.ground})
        for (const float value : map->pixels()) top = std::max(top, value);
    RgbImage figure = detail::map_panel(part, part.figure, double(top), width, height, factor, heat_color);
    RgbImage ground = detail::map_panel(part, part.ground, double(top), width, height, factor, heat_color);
    draw_box(figure, box, {white, pen, 0.35});
    draw_box(ground, box, {white, pen, 0.35});

    RgbImage cut = large;
    const Mask mask = detail::magnified(whole_mask(part, width, height), factor);
    for (int y = 0; y < cut.height(); ++y)
        for (int x = 0; x < cut.width(); ++x)
            if (mask(x, y) == 0) cut(x, y) = mix(grey_color(brightness(cut(x, y))), black, 0.6);
    draw_contour(cut, mask, color, int(pen));

    std::vector<RgbImage> panels{std::move(votes), std::move(figure), std::move(ground), std::move(cut)};
    const std::string distance =
        is_depth(detection.depth_m) ? ", " + fixed_text(detection.depth_m, 2) + " m away" : "";
    std::vector<std::string> captions{
        join_text(detection.support.size(), detection.support.size() == 1 ? " vote" : " votes", distance),
        "p(figure), brightest " + number_text(double(top), 2), "p(ground), same scale",
        mask_area(part.mask) > 0 ? "segmentation" : "no segmentation"};
    const bool cells = options.cells && !detection.cells.shares.empty();
    if (cells) {
        panels.insert(panels.begin() + 1,
                      cells_panel(large, detection.cells, magnified(detection.cells.box, factor)));
        captions.insert(captions.begin() + 1, "template");
    }
    const double zoom = std::min(1.0, double(options.panel_px) / std::max(large.width(), large.height()));
    if (zoom < 1)
        for (RgbImage& panel : panels) panel = shrunk(panel, zoom);
    RgbImage row = captioned_row(panels, captions, font);
    const int panel = panels[0].width();
    if (cells && !font.empty())
        draw_cells_legend(row.view().region(panel + 4 * pen_px(panel), 0, panel, row.height()), captions[1],
                          font, words_px(panel));
    return row;
}

}  // namespace detail

/// @brief Images of one detection side by side: the features that voted for it, with lines to its centre;
/// where it tells them (Detection::cells), the cells of its template that spoke for and against it; the maps
/// p(figure) and p(ground), both on one scale whose brightest value stands in the caption; the figure in its
/// surroundings.
/// @throws Error where there is no detection `which`, its class has no name, its votes point to features that
/// are not there, its segmentation's parts differ in size or an option is out of range.
[[nodiscard]] inline RgbImage draw_explanation(ImageView<const Rgb> image, const Detections& detections,
                                               std::size_t which, std::span<const std::string> class_names,
                                               const OverlayOptions& options = {}) {
    expect(options.panel_px >= 16, "OverlayOptions::panel_px", "16 or more pixels", options.panel_px);
    expect(!detections.objects.empty(), "detections to explain", "1 or more", 0);
    expect(which < detections.objects.size(), "index of a detection",
           lazy_text("below ", detections.objects.size()), which);
    const Detection& detection = detections.objects[which];
    if (!options.close_up) return detail::panel_row(image, detections, detection, class_names, options);
    const Box part =
        detail::surroundings(detections, detection, image.width(), image.height(), options.circle_scales);
    const Detections there = detail::moved_to(detections, detection, int(part.x), int(part.y));
    return detail::panel_row(image.region(int(part.x), int(part.y), int(part.width), int(part.height)), there,
                             there.objects.front(), class_names, options);
}

/// @brief All detections in one image: tinted figures with contours, boxes, class names and scores, the
/// strongest on top.
/// @throws Error where the class of a detection has no name.
[[nodiscard]] inline RgbImage draw_detections(ImageView<const Rgb> image, const Detections& detections,
                                              std::span<const std::string> class_names,
                                              const OverlayOptions& options = {}) {
    const int factor = detail::magnification(image, options.side_px);
    RgbImage result = magnified(image, factor);
    const int pen = detail::pen_px(result.width());
    for (std::size_t i = detections.objects.size(); i-- > 0;) {
        const Detection& detection = detections.objects[i];
        const Mask mask =
            detail::magnified(whole_mask(detection.segmentation, image.width(), image.height()), factor);
        const Rgb color = class_color(detection.class_index);
        blend_mask(result, mask, color, 0.35);
        draw_contour(result, mask, color, pen);
        draw_box(result, detail::magnified(detection.box, factor), {color, double(pen), 0.9});
    }
    std::vector<Box> used;
    for (const Detection& detection : detections.objects) {
        const std::string& name = detail::name_of(detection, class_names);
        if (options.font)
            detail::draw_label(result, detail::magnified(detection.box, factor), detection, name,
                               *options.font, used);
    }
    return result;
}

}  // namespace ism
