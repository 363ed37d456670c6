// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "ism/core/box_region.hpp"
#include "ism/core/color_bins.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/model/figure_color_odds.hpp"
#include "ism/model/figure_colors.hpp"

namespace ism {

/// @brief A picture in which an object is known.
struct ColoredObject {
    ImageView<const Rgb> picture;
    Box box;
    const Mask* mask;  ///< of the box: share of figure of each cell, 0 … 255
};

namespace detail {

/// Each axis with 1 2 1; what would fall out at an end stays there.
[[nodiscard]] inline FigureColors smoothed_colors(FigureColors histogram) {
    constexpr std::size_t n = figure_color_levels;
    for (const std::size_t stride : {n * n, n, std::size_t(1)}) {
        FigureColors smoothed(histogram.size());
        for (std::size_t i = 0; i < histogram.size(); ++i) {
            const std::size_t level = i / stride % n;
            const float below = histogram[level > 0 ? i - stride : i],
                        above = histogram[level + 1 < n ? i + stride : i];
            smoothed[i] = 0.5f * histogram[i] + 0.25f * (below + above);
        }
        histogram = std::move(smoothed);
    }
    return histogram;
}

}  // namespace detail

/// @brief The colours of a class by its objects, each of which counts as much as the others, against those of
/// the margins around them.
/// @return empty where there is none
[[nodiscard]] inline FigureColors learn_figure_colors(std::span<const ColoredObject> objects) {
    constexpr double margin = 0.25;  // around a box, in parts of its sides
    constexpr int samples = 160;     // at least, along the longer side of a larger region
    constexpr float rare = 1e-4f;    // part of the pixels that any colour has
    constexpr float limit = 3;
    const LabTable to_lab;
    FigureColors figure(figure_color_bins, 0.0f), ground = figure;
    float count = 0;
    for (const auto& [picture, box, mask] : objects) {
        const BoxRegion region(box, margin, picture.width(), picture.height());
        const int step = std::max(1, std::max(region.width, region.height) / samples);
        FigureColors in(figure_color_bins, 0.0f), out = in;
        float all_in = 0, all_out = 0;
        for (int y = region.y; y < region.y + region.height; y += step)
            for (int x = region.x; x < region.x + region.width; x += step) {
                const int column = int(std::floor((x + 0.5 - box.x) / box.width * mask->width())),
                          row = int(std::floor((y + 0.5 - box.y) / box.height * mask->height()));
                const float share = mask->contains(column, row) ? float((*mask)(column, row)) / 255 : 0.0f;
                const Rgb c = picture(x, y);
                const std::size_t bin = figure_color_bin(to_lab(c.r, c.g, c.b));
                in[bin] += share, out[bin] += 1 - share;
                all_in += share, all_out += 1 - share;
            }
        if (all_in < 1 || all_out < 1) continue;
        for (std::size_t i = 0; i < figure.size(); ++i)
            figure[i] += in[i] / all_in, ground[i] += out[i] / all_out;
        ++count;
    }
    if (count == 0) return {};
    figure = detail::smoothed_colors(std::move(figure)), ground = detail::smoothed_colors(std::move(ground));
    for (std::size_t i = 0; i < figure.size(); ++i)
        figure[i] =
            std::clamp(std::log((figure[i] / count + rare) / (ground[i] / count + rare)), -limit, limit);
    return figure;
}

}  // namespace ism
