// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/vote/occurrence.hpp"

namespace ism {

/// @brief How near occurrences of a word must lie to become one.
struct MergeOptions {
    double cell_px = 10;      ///< side of a cell in x and y, pixels at the reference size
    double scale_step = 1.2;  ///< ratio of the scales that share a cell, > 1
};

/// @brief Joins the occurrences of a word and class that fall into one cell of position and scale, and so
/// vote for about the same place: mean position, scale and depth, the sum of the weights; object and feature
/// are those of the heaviest. A word that keeps to a place gets few heavy occurrences, one that is everywhere
/// many light ones, and the number of votes no longer grows with that of the training objects.
/// @throws Error where an option is out of range.
[[nodiscard]] inline Shapes merge_occurrences(Shapes shapes, const MergeOptions& options = {}) {
    expect(options.cell_px > 0 && options.scale_step > 1, "merging occurrences: cell and scale step",
           "above 0 px, above 1", join_text(options.cell_px, ", ", options.scale_step));
    struct Sum {
        double x = 0, y = 0, log_scale = 0, weight = 0, depth_m = 0, depth_weight = 0;
        Occurrence heaviest;
    };
    std::vector<Occurrence> merged;
    std::vector<std::uint32_t> first{0};
    for (std::size_t w = 0; w + 1 < shapes.first.size(); ++w) {
        std::map<std::tuple<std::uint32_t, int, int, int>, Sum> cells;
        for (const Occurrence& o : shapes.of_word(w)) {
            const auto cell = [](double value) { return static_cast<int>(std::lround(value)); };
            Sum& sum = cells[{o.class_index, cell(std::log(o.scale) / std::log(options.scale_step)),
                              cell(o.x / options.cell_px), cell(o.y / options.cell_px)}];
            if (sum.weight == 0 || o.weight > sum.heaviest.weight) sum.heaviest = o;
            sum.x += double(o.weight) * o.x;
            sum.y += double(o.weight) * o.y;
            sum.log_scale += o.weight * std::log(double(o.scale));
            sum.weight += o.weight;
            if (std::isfinite(o.depth_m)) {
                sum.depth_m += double(o.weight) * o.depth_m;
                sum.depth_weight += o.weight;
            }
        }
        for (auto& [key, sum] : cells) {
            Occurrence o = sum.heaviest;
            if (!(sum.weight > 0)) continue;
            o.x = static_cast<float>(sum.x / sum.weight);
            o.y = static_cast<float>(sum.y / sum.weight);
            o.scale = static_cast<float>(std::exp(sum.log_scale / sum.weight));
            o.weight = static_cast<float>(sum.weight);
            if (sum.depth_weight > 0) o.depth_m = static_cast<float>(sum.depth_m / sum.depth_weight);
            merged.push_back(o);
        }
        first.push_back(static_cast<std::uint32_t>(merged.size()));
    }
    shapes.occurrences = std::move(merged);
    shapes.first = std::move(first);
    return shapes;
}

}  // namespace ism
