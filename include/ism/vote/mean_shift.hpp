// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/vote/bandwidth.hpp"
#include "ism/vote/kernel.hpp"
#include "ism/vote/mode.hpp"
#include "ism/vote/start_bins.hpp"
#include "ism/vote/vote_grid.hpp"
#include "ism/vote/window_sums.hpp"

namespace ism {

/// @brief How modes are searched.
struct MeanShiftOptions {
    std::size_t max_starts = 30;  ///< heaviest bins of a label from which a search starts
    double min_start = 0.05;      ///< a start's bin weighs at least this part of the label's heaviest
    int max_iterations = 50;
    double tolerance = 1e-3;  ///< a search ends where its step is shorter than this part of the window
    double capture = 0.03;  ///< and, without a mode of its own, this part of the window from one found before
};

/// @brief Does nothing where `options` can be used.
/// @throws Error for one out of range.
inline void check(const MeanShiftOptions& options) {
    expect(options.min_start >= 0 && options.min_start <= 1,
           "mean shift: part of the heaviest bin to start at", "0 ... 1", options.min_start);
    expect(options.max_iterations >= 0, "mean shift: iterations", "0 or more", options.max_iterations);
    expect(options.tolerance >= 0, "mean shift: tolerance", "0 or more", options.tolerance);
    expect(options.capture >= 0 && options.capture <= 1, "mean shift: capture", "0 ... 1", options.capture);
}

/// @brief Goes to the mean of the votes in the window, and takes the window's scale from them.
/// @return the squared length of the step, in windows; 0 where the window is empty
template <Kernel K, std::size_t Dimension>
double shift_once(const VoteGrid<Dimension>& grid, Mode<Dimension>& mode) {
    const auto window = grid.bandwidth().at(mode.scale);
    const auto mean = window_mean<K>(grid, mode.at, window);
    if (!(mean.weight > 0)) return 0;
    const double ratio = mean.scale / mode.scale - 1;
    const double sq_step = sq_windows(mean.at, mode.at, window) + ratio * ratio;
    mode.at = mean.at, mode.scale = mean.scale;
    return sq_step;
}

/// @brief Follows the mean of the votes in the window from `start` until it rests. The window grows with the
/// mean scale of the votes in it.
template <Kernel K, std::size_t Dimension>
[[nodiscard]] Mode<Dimension> shift_to_mode(const VoteGrid<Dimension>& grid, Mode<Dimension> start,
                                            const MeanShiftOptions& options = {}) {
    for (int i = 0; i < options.max_iterations; ++i)
        if (shift_once<K>(grid, start) < options.tolerance * options.tolerance) break;
    start.score = window_score<K>(grid, start.at, grid.bandwidth().at(start.scale));
    return start;
}

/// @brief The modes reached from `starts`, strongest first; of modes less than one window apart only the
/// strongest stays. Fewer starts end at a mode of their own than there are: most come by one that is known.
/// @throws Error for an option out of range.
template <Kernel K, std::size_t Dimension>
[[nodiscard]] std::vector<Mode<Dimension>> find_modes(const VoteGrid<Dimension>& grid,
                                                      std::span<const Mode<Dimension>> starts,
                                                      const MeanShiftOptions& options = {}) {
    check(options);
    std::vector<Mode<Dimension>> modes, apart;
    const auto near = [&](const Mode<Dimension>& mode, const Mode<Dimension>& other, double part) {
        return sq_windows(mode.at, other.at, grid.bandwidth().at(other.scale)) < part * part;
    };
    const auto captured = [&](const Mode<Dimension>& mode) {
        return std::any_of(modes.begin(), modes.end(), [&](const auto& other) {
            return std::abs(mode.scale / other.scale - 1) < options.capture &&
                   near(mode, other, options.capture);
        });
    };
    for (Mode<Dimension> mode : starts) {
        bool known = captured(mode);
        for (int i = 0; i < options.max_iterations && !known; ++i) {
            if (shift_once<K>(grid, mode) < options.tolerance * options.tolerance) break;
            known = captured(mode);
        }
        if (known) continue;
        mode.score = window_score<K>(grid, mode.at, grid.bandwidth().at(mode.scale));
        if (mode.score > 0) modes.push_back(mode);
    }
    std::stable_sort(modes.begin(), modes.end(),
                     [](const auto& a, const auto& b) { return a.score > b.score; });
    for (const auto& mode : modes)
        if (std::none_of(apart.begin(), apart.end(), [&](const auto& other) { return near(mode, other, 1); }))
            apart.push_back(mode);
    return apart;
}

/// @brief Memory that find_modes() can use again and again: for one thread.
template <std::size_t Dimension>
struct MeanShiftMemory {
    VoteGrid<Dimension> grid;
    StartBins<Dimension> bins;
};

/// @brief The modes of votes of one label, strongest first: mean shift from the heaviest bins.
/// @throws Error for a bandwidth that is not a positive number, a vote that check() refuses, an option out of
/// range.
template <Kernel K, std::size_t Dimension>
[[nodiscard]] std::vector<Mode<Dimension>> find_modes(std::span<const Vote<Dimension>> votes,
                                                      const Bandwidth<Dimension>& bandwidth,
                                                      const MeanShiftOptions& options,
                                                      MeanShiftMemory<Dimension>& memory) {
    memory.grid.assign(votes, bandwidth);
    return find_modes<K>(memory.grid,
                         memory.bins.find(votes, bandwidth, options.max_starts, options.min_start), options);
}

/// @brief The same in memory of its own.
template <Kernel K, std::size_t Dimension>
[[nodiscard]] std::vector<Mode<Dimension>> find_modes(std::span<const Vote<Dimension>> votes,
                                                      const Bandwidth<Dimension>& bandwidth,
                                                      const MeanShiftOptions& options = {}) {
    MeanShiftMemory<Dimension> memory;
    return find_modes<K>(votes, bandwidth, options, memory);
}

}  // namespace ism
