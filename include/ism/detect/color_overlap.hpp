// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/model/box_cues.hpp"

namespace ism {

/// @brief How much the colours of an object have in common with those around it, 0 … 1, where the object
/// covers its box as others of its class do: the Bhattacharyya coefficient of two histograms of 16³ bins, of
/// the figure and of the rest of the box with a quarter of its sides around it. True boxes follow an object,
/// which mostly stands out; what a template takes for one by chance seldom does. (Alexe, Deselaers and
/// Ferrari 2012 find objects of any kind by the contrast of windows.) 1 where no figure is known or no ground
/// is to be seen.
[[nodiscard]] inline double color_overlap(ImageView<const Rgb> color, const Box& box,
                                          std::span<const float> figure) {
    constexpr int bins = 16, around = figure_samples / 4, side = figure_samples + 2 * around;
    struct Share {
        float figure = 0, ground = 0;
    };
    std::vector<Share> shares(std::size_t(bins) * bins * bins);
    Share all;
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
            Share& bin = shares[(std::size_t(c.r / bins) * bins + c.g / bins) * bins + c.b / bins];
            bin.figure += p, bin.ground += 1 - p;
            all.figure += p, all.ground += 1 - p;
        }
    }
    if (!(all.figure > 0 && all.ground > 0.1f * all.figure)) return 1;
    float sum = 0;
    for (const Share& bin : shares) sum += std::sqrt(bin.figure * bin.ground);
    return sum / std::sqrt(double(all.figure) * double(all.ground));
}

}  // namespace ism
