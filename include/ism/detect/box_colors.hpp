// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "ism/core/color_bins.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/model/box_cues.hpp"
#include "ism/model/figure_color_odds.hpp"
#include "ism/model/figure_colors.hpp"

namespace ism {

/// @brief The colours of an object and of what is around it: which share of either falls into each bin of
/// FigureColors. Empty where no figure is known or no ground is to be seen.
struct BoxColors {
    std::vector<float> figure = {}, ground = {};

    [[nodiscard]] bool empty() const { return figure.empty(); }
};

/// @brief The colours in a box, where the object covers it as others of its class do, and in the rest of it
/// with a quarter of its sides around it.
[[nodiscard]] inline BoxColors box_colors(ImageView<const Rgb> color, const Box& box,
                                          std::span<const float> figure, const LabTable& to_lab) {
    constexpr int around = figure_samples / 4, side = figure_samples + 2 * around;
    BoxColors colors{std::vector<float>(figure_color_bins, 0), std::vector<float>(figure_color_bins, 0)};
    float all_figure = 0, all_ground = 0;
    for (int j = 0; j < side; ++j) {
        const double py = std::floor(box.y + (j - around + 0.5) * box.height / figure_samples);
        if (!(py >= 0 && py < color.height())) continue;
        const std::span<const Rgb> row = color.row(int(py));
        for (int i = 0; i < side; ++i) {
            const double px = std::floor(box.x + (i - around + 0.5) * box.width / figure_samples);
            if (!(px >= 0 && px < color.width())) continue;
            const int x = i - around, y = j - around;
            const bool inside = x >= 0 && y >= 0 && x < figure_samples && y < figure_samples;
            const float p = inside ? figure[std::size_t(y * figure_samples + x)] : 0;
            const Rgb c = row[std::size_t(px)];
            const std::size_t bin = figure_color_bin(to_lab(c.r, c.g, c.b));
            colors.figure[bin] += p, colors.ground[bin] += 1 - p;
            all_figure += p, all_ground += 1 - p;
        }
    }
    if (!(all_figure > 0 && all_ground > 0.1f * all_figure)) return {};
    for (float& share : colors.figure) share /= all_figure;
    for (float& share : colors.ground) share /= all_ground;
    return colors;
}

/// @brief How much the colours of figure and ground have in common, 0 … 1: the Bhattacharyya coefficient of
/// their histograms. True boxes follow an object, which mostly stands out; what a template takes for one by
/// chance seldom does. (Alexe, Deselaers and Ferrari 2012 find objects of any kind by the contrast of
/// windows.) 1 where they are not known.
[[nodiscard]] inline double color_overlap(const BoxColors& colors) {
    if (colors.empty()) return 1;
    float sum = 0;
    for (std::size_t i = 0; i < colors.figure.size(); ++i)
        sum += std::sqrt(colors.figure[i] * colors.ground[i]);
    return sum;
}

/// @brief How much the figure has the colours of a class and the ground those around its objects: the mean
/// logarithm of odds of the figure less half of that of the ground, which differs more from picture to
/// picture. 0 where either is not known.
/// @param known  FigureColors of the class
[[nodiscard]] inline double color_odds(const BoxColors& colors, std::span<const float> known) {
    if (colors.empty() || known.empty()) return 0;
    float sum = 0;
    for (std::size_t i = 0; i < known.size(); ++i)
        sum += known[i] * (colors.figure[i] - 0.5f * colors.ground[i]);
    return sum;
}

}  // namespace ism
