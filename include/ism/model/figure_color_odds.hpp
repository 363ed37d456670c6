// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "ism/core/color_bins.hpp"
#include "ism/model/figure_colors.hpp"

namespace ism {

/// @brief The bin of a colour.
[[nodiscard]] inline std::size_t figure_color_bin(const Lab& color) {
    const auto level = [](float value, float least, float width) {
        return std::size_t(std::clamp((value - least) / width, 0.0f, float(figure_color_levels - 1)));
    };
    return (level(color[0], 0, 16) * figure_color_levels + level(color[1], 64, 8)) * figure_color_levels +
           level(color[2], 64, 8);
}

/// @brief What the colours of pixels say for figure, in logarithms of odds; nothing where they are not known.
/// @param known  FigureColors of a class, or empty
/// @param rgb    three numbers a pixel, 0 … 255
[[nodiscard]] inline std::vector<float> figure_color_odds(std::span<const float> known,
                                                          std::span<const float> rgb) {
    std::vector<float> odds(rgb.size() / 3, 0.0f);
    if (known.empty()) return odds;
    const LabTable to_lab;
    for (std::size_t i = 0; i < odds.size(); ++i)
        odds[i] = known[figure_color_bin(to_lab(rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]))];
    return odds;
}

}  // namespace ism
