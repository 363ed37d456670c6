// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/order.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/vote/mean_shift.hpp"

namespace ism {

/// @brief Votes in the order of cast_votes, cut where the label changes.
template <std::size_t Dimension>
[[nodiscard]] std::vector<std::span<const Vote<Dimension>>> split_by_label(
    const std::vector<Vote<Dimension>>& votes) {
    std::vector<std::span<const Vote<Dimension>>> parts;
    for (std::size_t first = 0, i = 1; i <= votes.size(); ++i)
        if (i == votes.size() || votes[i].label != votes[first].label) {
            parts.emplace_back(votes.data() + first, i - first);
            first = i;
        }
    return parts;
}

namespace detail {

/// Strongest first, equal ones in their order; those behind the `max_count`-th or below `min_relative_score`
/// times the first dropped.
template <std::size_t Dimension>
void keep_strongest(std::vector<SupportedMode<Dimension>>& modes, std::size_t max_count,
                    double min_relative_score) {
    sort_by(modes, [](const auto& mode) { return falling(mode.score); });
    while (!modes.empty() &&
           (modes.size() > max_count || modes.back().score < min_relative_score * modes.front().score))
        modes.pop_back();
}

/// At most what all votes of a label weigh together, a bit more than any score of theirs, which is a sum in
/// float.
template <std::size_t Dimension>
[[nodiscard]] double score_bound(std::span<const Vote<Dimension>> votes) {
    double weight = 0;
    for (const auto& vote : votes) weight += vote.weight;
    return weight * (1 + 1e-5 + 1e-8 * double(votes.size()));
}

}  // namespace detail

/// @brief The strongest modes of all labels with their votes: at most `max_count`, and none weaker than
/// `min_relative_score` times the strongest. Labels are searched by falling weight of all their votes, which
/// no mode of theirs can exceed; where that is too little for a place among the strongest, the search is
/// over.
/// @param labels  the votes of each label, as split_by_label() gives them; the support of a mode has indices
/// into those of its label
/// @tparam Search  how votes in a window are found
/// @return the same for any number of threads
/// @throws Error as find_modes() does, and for a least relative score outside 0 to 1
template <Kernel K, std::size_t Dimension, VoteSearch<Dimension> Search = VoteGrid<Dimension>>
[[nodiscard]] std::vector<SupportedMode<Dimension>> strongest_modes(
    const std::vector<std::span<const Vote<Dimension>>>& labels, const Bandwidth<Dimension>& bandwidth,
    const MeanShiftOptions& options, std::size_t max_count, double min_relative_score, ThreadPool& pool) {
    check(options);
    expect(min_relative_score >= 0 && min_relative_score <= 1, "modes: least relative score", "0 to 1",
           min_relative_score);
    for (const auto& votes : labels) check(votes, bandwidth);
    std::vector<double> bound(labels.size());
    std::vector<std::uint32_t> order(labels.size());
    for (std::uint32_t l = 0; l < labels.size(); ++l) order[l] = l, bound[l] = detail::score_bound(labels[l]);
    detail::sort_by(order, [&](std::uint32_t label) { return detail::falling(bound[label]); });

    std::vector<MeanShiftMemory<Dimension, Search>> memory(pool.size());
    std::vector<SupportedMode<Dimension>> strongest;
    std::size_t at_once = 16;  // not the number of threads, on which the result must not depend
    for (std::size_t first = 0; first < labels.size() && max_count > 0; first += at_once, at_once *= 2) {
        const double least = strongest.size() == max_count ? strongest.back().score
                             : strongest.empty()           ? 0
                                                           : min_relative_score * strongest.front().score;
        std::size_t count = 0;
        while (count < std::min(at_once, labels.size() - first) && bound[order[first + count]] >= least)
            ++count;
        std::vector<std::vector<SupportedMode<Dimension>>> found(count);
        pool.for_each(count, [&](std::size_t i, unsigned worker) {
            MeanShiftMemory<Dimension, Search>& own = memory[worker];
            const auto modes = detail::find_modes_of<K>(labels[order[first + i]], bandwidth, options, own);
            for (const Mode<Dimension>& mode : modes)
                if (mode.score >= std::max(least, min_relative_score * modes.front().score))
                    found[i].push_back({mode, support_of<K>(own.search, mode)});
        });
        for (auto& modes : found)
            for (auto& mode : modes) strongest.push_back(std::move(mode));
        detail::keep_strongest(strongest, max_count, min_relative_score);
        if (count < std::min(at_once, labels.size() - first)) break;
    }
    return strongest;
}

/// @brief The same on `threads` threads of its own; 0 = all hardware threads.
template <Kernel K, std::size_t Dimension, VoteSearch<Dimension> Search = VoteGrid<Dimension>>
[[nodiscard]] std::vector<SupportedMode<Dimension>> strongest_modes(
    const std::vector<std::span<const Vote<Dimension>>>& labels, const Bandwidth<Dimension>& bandwidth,
    const MeanShiftOptions& options, std::size_t max_count, double min_relative_score, unsigned threads) {
    ThreadPool pool(
        unsigned(std::min<std::size_t>(thread_count(threads), std::max<std::size_t>(1, labels.size()))));
    return strongest_modes<K, Dimension, Search>(labels, bandwidth, options, max_count, min_relative_score,
                                                 pool);
}

}  // namespace ism
