// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "ism/core/number_text.hpp"
#include "ism/detect/detection.hpp"
#include "ism/show/draw.hpp"
#include "ism/show/draw_mask.hpp"
#include "ism/show/feature_weights.hpp"
#include "ism/show/font.hpp"

namespace ism::detail {

// The parts of the images of show/overlay.hpp. Small images are magnified by a whole number first.

/// By how much an image is magnified so that its longer side comes near `side_px`.
[[nodiscard]] inline int magnification(ImageView<const Rgb> image, int side_px) {
    expect(!image.empty(), "image size", "at least 1x1", size_text(image));
    return std::clamp(side_px / std::max(image.width(), image.height()), 1, 16);
}

/// How wide lines are, and how high those of words, in an image of this width: in large ones so that they are
/// seen where the whole image is looked at.
[[nodiscard]] inline int pen_px(int width_px) {
    return width_px >= 320 ? std::max(2, width_px / 500) : 1;
}
[[nodiscard]] inline int words_px(int width_px) {
    return width_px >= 320 ? std::max(19, width_px / 52) : 13;
}

/// A name and what follows it, no wider than `most`: if need be without the end of the name.
[[nodiscard]] inline std::string shortened_label(std::string name, const std::string& rest, const Font& font,
                                                 double line, double most) {
    std::string label = name + rest;
    while (font.width(label, line) > most && !name.empty()) {
        const auto within_letter = [](char byte) {
            return (static_cast<unsigned char>(byte) & 0xc0) == 0x80;
        };
        while (name.size() > 1 && within_letter(name.back())) name.pop_back();
        name.pop_back();  // a whole letter of UTF-8
        label = name + ".." + rest;
    }
    return label;
}

/// Where a point and a box of the image lie in the magnified one.
[[nodiscard]] inline Point2 magnified(Point2 p, int factor) {
    return {(p.x + 0.5) * factor - 0.5, (p.y + 0.5) * factor - 0.5};
}
[[nodiscard]] inline Box magnified(const Box& b, int factor) {
    return {b.x * factor, b.y * factor, b.width * factor, b.height * factor};
}
[[nodiscard]] inline Mask magnified(const Mask& mask, int factor) {
    Mask large(mask.width() * factor, mask.height() * factor);
    for (int y = 0; y < large.height(); ++y)
        for (int x = 0; x < large.width(); ++x) large(x, y) = mask(x / factor, y / factor);
    return large;
}

/// Writes what was found at its box: above it, or where that place is outside the image or `used` already,
/// inside its upper edge or below it. Adds the place to `used`.
inline void draw_label(ImageView<Rgb> image, const Box& box, const Detection& detection,
                       const std::string& name, const Font& font, std::vector<Box>& used) {
    const Box page{0, 0, double(image.width()), double(image.height())};
    const double line = words_px(image.width());
    const std::string text =
        shortened_label(name, " " + confidence_text(detection), font, line, page.width - line / 2 - 1);
    const double width = std::ceil(font.width(text, line)) + line / 2, height = line + 1;
    const double x = std::clamp(box.x, 0.0, std::max(0.0, std::floor(page.width - width)));
    Box place{x, std::clamp(box.y, 0.0, std::max(0.0, page.height - height)), width, height};
    for (const double y : {box.y - height, box.y, box.y + box.height - height, box.y + box.height}) {
        const Box wish{x, y, width, height};
        const bool free = std::none_of(used.begin(), used.end(),
                                       [&](const Box& b) { return intersection(b, wish).area() > 0; });
        if (!free || intersection(wish, page).area() < wish.area()) continue;
        place = wish;
        break;
    }
    place.x = std::round(place.x), place.y = std::round(place.y);
    used.push_back(place);
    const Rgb color = class_color(detection.class_index);
    fill_box(image, place, color);
    font.draw(image, place.x + line / 4, place.y, text, ink_on(color), line);
}

/// The features that vote for a detection as circles (radius: `circle_scales` times their scale), each with a
/// line to the centre; the stronger the vote, the clearer the line.
inline void draw_support(ImageView<Rgb> image, const Detections& detections, const Detection& detection,
                         Rgb color, double circle_scales, int factor) {
    const double pen = pen_px(image.width());
    const std::vector<FeatureWeight> weights = feature_weights(detections, detection);
    const double strongest = weights.empty() ? 1 : weights.back().weight;
    const Point2 centre = magnified(detection.centre, factor);
    for (const bool circles : {false, true})
        for (const FeatureWeight& f : weights) {
            const Feature& feature = detections.features[f.feature];
            const Point2 at = magnified(Point2{feature.x, feature.y}, factor);
            const double opacity = 0.25 + 0.75 * f.weight / strongest;
            if (!circles) {
                draw_line(image, at, centre, {color, 0.6 * pen, opacity});
            } else {
                const double radius = std::max(2.0, circle_scales * double(feature.scale) * factor);
                draw_circle(image, at, radius, {mix(color, white, 0.6), 0.6 * pen, opacity});
                fill_disc(image, at, 0.9 * pen, white, opacity);
            }
        }
    fill_disc(image, centre, 3.5 * pen, black);
    fill_disc(image, centre, 2.5 * pen, mix(color, white, 0.3));
}

}  // namespace ism::detail
