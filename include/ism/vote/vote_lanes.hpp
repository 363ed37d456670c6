// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "ism/core/lanes.hpp"
#include "ism/vote/vote_grid.hpp"

// Sums over votes as a vector unit makes them.
namespace ism::detail {

/// Votes that are added side by side.
inline constexpr std::size_t vote_lane_count = 16;

using VoteLanes = Lanes<float, vote_lane_count>;

/// A window in float, as votes are.
template <std::size_t Dimension>
struct FloatWindow {
    std::array<float, Dimension> centre, per_window;

    FloatWindow(const std::array<double, Dimension>& at, const std::array<double, Dimension>& window) {
        for (std::size_t k = 0; k < Dimension; ++k) {
            centre[k] = static_cast<float>(at[k]);
            per_window[k] = static_cast<float>(std::min(1 / window[k], 1e18));
        }
    }
};

/// Where the columns of a grid are.
template <std::size_t Dimension>
struct VoteColumns {
    std::array<const float*, Dimension> at;
    const float *scale, *weight;

    explicit VoteColumns(const VoteGrid<Dimension>& grid) : scale(grid.scales()), weight(grid.weights()) {
        for (std::size_t k = 0; k < Dimension; ++k) at[k] = grid.axis(k);
    }
};

/// Adds votes first ... last - 1 to `sums`, `vote_lane_count` side by side, by `sums.add(lane, vote,
/// weight)`. What is added to is a copy, of which a compiler knows that no column overlaps it.
template <class Sums, std::size_t Dimension>
void add_run(Sums& sums, const VoteColumns<Dimension>& votes, const FloatWindow<Dimension>& window,
             std::size_t first, std::size_t last) {
    Sums local = sums;
    for (; first + vote_lane_count <= last; first += vote_lane_count)
        for (std::size_t l = 0; l < vote_lane_count; ++l)
            local.add(l, votes, window, first + l, votes.weight[first + l]);
    if (first < last) {
        std::array<float, vote_lane_count> tail{};
        for (std::size_t l = 0; first + l < last; ++l) tail[l] = votes.weight[first + l];
        for (std::size_t l = 0; l < vote_lane_count; ++l) local.add(l, votes, window, first + l, tail[l]);
    }
    sums = local;
}

}  // namespace ism::detail
