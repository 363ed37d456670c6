// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "ism/core/image.hpp"
#include "ism/model/training_object.hpp"

namespace ism {

/// @brief How far a mask reaches from the middle of its box, in each direction: the largest dot product of
/// one of its corners with the direction, pixels.
/// @param mask           share of figure, 0 … 255; cells of half or more count; without
///                       such, all do
/// @param width, height  of the box, pixels
[[nodiscard]] inline std::array<float, reach_directions> figure_reach(const Mask& mask, double width,
                                                                      double height) {
    const double cell_width = width / mask.width(), cell_height = height / mask.height();
    std::array<float, reach_directions> reach{}, cosine{}, sine{};
    for (std::size_t d = 0; d < reach_directions; ++d) {
        const double angle = 2 * std::numbers::pi * double(d) / reach_directions;
        cosine[d] = static_cast<float>(std::cos(angle)), sine[d] = static_cast<float>(std::sin(angle));
    }
    const auto reach_to = [&](int column, int row) {  // a corner of cells
        const auto x = static_cast<float>(column * cell_width - width / 2),
                   y = static_cast<float>(row * cell_height - height / 2);
        for (std::size_t d = 0; d < reach_directions; ++d)
            reach[d] = std::max(reach[d], cosine[d] * x + sine[d] * y);
    };
    bool thin = true;  // no cell is figure by half: its box stands for it
    for (int row = 0; row < mask.height(); ++row) {
        int first = mask.width(), end = 0;
        for (int column = 0; column < mask.width(); ++column)
            if (mask(column, row) >= 128) first = std::min(first, column), end = column + 1;
        if (end == 0) continue;
        for (const int line : {row, row + 1}) reach_to(first, line), reach_to(end, line);
        thin = false;
    }
    if (thin)
        for (const int line : {0, mask.height()}) reach_to(0, line), reach_to(mask.width(), line);
    return reach;
}

}  // namespace ism
