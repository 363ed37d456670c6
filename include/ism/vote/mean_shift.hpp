// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/order.hpp"
#include "ism/vote/bandwidth.hpp"
#include "ism/vote/kernel.hpp"
#include "ism/vote/mode.hpp"
#include "ism/vote/seed_bins.hpp"
#include "ism/vote/vote_grid.hpp"
#include "ism/vote/vote_search.hpp"
#include "ism/vote/window_sums.hpp"

namespace ism {

/// @brief How modes are searched.
struct MeanShiftOptions {
    std::size_t max_seeds = 30;         ///< heaviest bins of a label from which a search starts
    double min_relative_weight = 0.05;  ///< of a seed's bin, to that of the label's heaviest
    bool peaks_only = false;  ///< a search starts only from a bin that none beside it outweighs: one place
                              ///< takes no seeds from another
    int max_iterations = 50;
    double tolerance = 1e-3;     ///< a search ends where its step is shorter than this part of the window
    double merge_radius = 0.03;  ///< and, without a mode of its own, this part of the window from a known one
};

/// @brief Validates `options`.
/// @throws Error for one out of range or NaN.
inline void check(const MeanShiftOptions& options) {
    expect(options.min_relative_weight >= 0 && options.min_relative_weight <= 1,
           "MeanShiftOptions::min_relative_weight", "0 to 1", options.min_relative_weight);
    expect(options.max_iterations >= 0, "MeanShiftOptions::max_iterations", "0 or more",
           options.max_iterations);
    expect(options.tolerance >= 0 && std::isfinite(options.tolerance), "MeanShiftOptions::tolerance",
           "0 or more, finite", options.tolerance);
    expect(options.merge_radius >= 0 && options.merge_radius <= 1, "MeanShiftOptions::merge_radius", "0 to 1",
           options.merge_radius);
}

/// @brief Goes to the mean of the votes in the window, and takes the window's scale from them.
/// @return the squared length of the step, in windows; 0 where the window is empty
template <Kernel K, std::size_t Dimension, VoteSearch<Dimension> Search>
double shift_once(const Search& search, Mode<Dimension>& mode) {
    const auto window = search.bandwidth().at(mode.scale);
    const auto mean = window_mean<K>(search, mode.at, window);
    if (!(mean.weight > 0)) return 0;
    const double ratio = mean.scale / mode.scale - 1;
    const double sq_step = sq_windows(mean.at, mode.at, window) + ratio * ratio;
    mode.at = mean.at, mode.scale = mean.scale;
    return sq_step;
}

/// @brief The modes reached from `seeds`, strongest first; of modes less than one window apart only the
/// strongest stays. Fewer seeds end at a mode of their own than there are: most come by one that is known.
/// @throws Error for an option out of range.
template <Kernel K, std::size_t Dimension, VoteSearch<Dimension> Search>
[[nodiscard]] std::vector<Mode<Dimension>> find_modes(const Search& search,
                                                      const std::vector<Mode<Dimension>>& seeds,
                                                      const MeanShiftOptions& options = {}) {
    check(options);
    std::vector<Mode<Dimension>> modes, apart;
    const auto near = [&](const Mode<Dimension>& mode, const Mode<Dimension>& other, double part) {
        return sq_windows(mode.at, other.at, search.bandwidth().at(other.scale)) < part * part;
    };
    const auto is_known = [&](const Mode<Dimension>& mode) {
        return detail::any_of(modes, [&](const Mode<Dimension>& other) {
            return std::abs(mode.scale / other.scale - 1) < options.merge_radius &&
                   near(mode, other, options.merge_radius);
        });
    };
    for (Mode<Dimension> mode : seeds) {
        bool known = is_known(mode);
        for (int i = 0; i < options.max_iterations && !known; ++i) {
            if (shift_once<K>(search, mode) < options.tolerance * options.tolerance) break;
            known = is_known(mode);
        }
        if (known) continue;
        mode.score = window_score<K>(search, mode.at, search.bandwidth().at(mode.scale));
        if (mode.score > 0) modes.push_back(mode);
    }
    detail::sort_by(modes, [](const auto& mode) { return detail::falling(mode.score); });
    for (const auto& mode : modes)
        if (!detail::any_of(apart, [&](const Mode<Dimension>& other) { return near(mode, other, 1); }))
            apart.push_back(mode);
    return apart;
}

/// @brief Memory that find_modes() can use again and again: for one thread.
/// @tparam Search  how votes in a window are found
template <std::size_t Dimension, VoteSearch<Dimension> Search = VoteGrid<Dimension>>
struct MeanShiftMemory {
    Search search;
    SeedBins<Dimension> bins;
};

/// @brief The votes in the window of a mode, by rising index: all with a kernel above 0.
template <Kernel K, std::size_t Dimension, VoteSearch<Dimension> Search>
[[nodiscard]] std::vector<WindowVote> support_of(const Search& search, const Mode<Dimension>& mode) {
    std::vector<WindowVote> support;
    const auto window = search.bandwidth().at(mode.scale);
    search.each_within(mode.at, window, detail::rounded_reach<K>, [&](std::uint32_t i, double sq_u) {
        if (const double kernel = K::profile(float(sq_u)); kernel > 0) support.push_back({i, kernel});
    });
    detail::sort_by(support, [](const WindowVote& vote) { return vote.index; });
    return support;
}

namespace detail {

/// The modes of votes and options that were checked.
template <Kernel K, std::size_t Dimension, VoteSearch<Dimension> Search>
[[nodiscard]] std::vector<Mode<Dimension>> find_modes_of(std::span<const Vote<Dimension>> votes,
                                                         const Bandwidth<Dimension>& bandwidth,
                                                         const MeanShiftOptions& options,
                                                         MeanShiftMemory<Dimension, Search>& memory) {
    memory.search.assign(votes, bandwidth);
    const auto seeds = memory.bins.find(votes, bandwidth, options.max_seeds, options.min_relative_weight,
                                        options.peaks_only);
    return find_modes<K>(memory.search, seeds, options);
}

}  // namespace detail

/// @brief The modes of votes of one label, strongest first: mean shift from the heaviest bins.
/// @throws Error for a bandwidth that is not a positive number, a vote that check() refuses, an option out of
/// range.
template <Kernel K, std::size_t Dimension, VoteSearch<Dimension> Search>
[[nodiscard]] std::vector<Mode<Dimension>> find_modes(std::span<const Vote<Dimension>> votes,
                                                      const Bandwidth<Dimension>& bandwidth,
                                                      const MeanShiftOptions& options,
                                                      MeanShiftMemory<Dimension, Search>& memory) {
    check(votes, bandwidth);
    return detail::find_modes_of<K>(votes, bandwidth, options, memory);
}

/// @brief The same in memory of its own, with VoteGrid.
template <Kernel K, std::size_t Dimension>
[[nodiscard]] std::vector<Mode<Dimension>> find_modes(std::span<const Vote<Dimension>> votes,
                                                      const Bandwidth<Dimension>& bandwidth,
                                                      const MeanShiftOptions& options = {}) {
    MeanShiftMemory<Dimension> memory;
    return find_modes<K>(votes, bandwidth, options, memory);
}

}  // namespace ism
