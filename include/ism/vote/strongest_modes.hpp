// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/core/thread_pool.hpp"
#include "ism/vote/mean_shift.hpp"

namespace ism {

/// @brief Votes in the order of cast_votes, cut where the label changes.
template <std::size_t Dimension>
[[nodiscard]] std::vector<std::span<const Vote<Dimension>>> split_by_label(
    std::span<const Vote<Dimension>> votes) {
    std::vector<std::span<const Vote<Dimension>>> parts;
    for (std::size_t first = 0, i = 1; i <= votes.size(); ++i)
        if (i == votes.size() || votes[i].label != votes[first].label) {
            parts.push_back(votes.subspan(first, i - first));
            first = i;
        }
    return parts;
}

namespace detail {

/// Strongest first, then by label; those behind the `most`-th or below `keep` times the first dropped.
template <std::size_t Dimension>
void keep_strongest(std::vector<Mode<Dimension>>& modes, std::size_t most, double keep) {
    std::stable_sort(modes.begin(), modes.end(), [](const auto& a, const auto& b) {
        return a.score > b.score || (a.score == b.score && a.label < b.label);
    });
    std::size_t count = 0;
    while (count < std::min(most, modes.size()) && modes[count].score >= keep * modes.front().score) ++count;
    modes.resize(count);
}

}  // namespace detail

/// @brief The strongest modes of all labels: at most so many, and none weaker than `keep` times the
/// strongest. Labels are searched by falling weight of all their votes, which no mode of theirs can exceed;
/// where that is too little for a place among the strongest, the search is over.
/// @param labels   the votes of each label, as split_by_label() gives them
/// @param pool    the result is the same for any number of threads
/// @throws Error as find_modes() does
template <Kernel K, std::size_t Dimension>
[[nodiscard]] std::vector<Mode<Dimension>> strongest_modes(
    std::span<const std::span<const Vote<Dimension>>> labels, const Bandwidth<Dimension>& bandwidth,
    const MeanShiftOptions& options, std::size_t most, double keep, ThreadPool& pool) {
    std::vector<double> weight(labels.size(), 0);
    std::vector<std::uint32_t> order(labels.size());
    for (std::uint32_t l = 0; l < labels.size(); ++l) {
        order[l] = l;
        for (const auto& vote : labels[l]) {
            check(vote);
            weight[l] += vote.weight;
        }
        weight[l] *= 1 + 1e-5 + 1e-8 * double(labels[l].size());  // scores are sums in float
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return weight[a] > weight[b]; });

    std::vector<MeanShiftMemory<Dimension>> memory(pool.size());
    std::vector<Mode<Dimension>> strongest;
    std::size_t at_once = 16;  // not the number of threads, on which the result must not depend
    for (std::size_t first = 0; first < labels.size() && most > 0; first += at_once, at_once *= 2) {
        const double least = strongest.size() == most ? strongest.back().score
                             : strongest.empty()      ? 0
                                                      : keep * strongest.front().score;
        std::size_t count = 0;
        while (count < std::min(at_once, labels.size() - first) && weight[order[first + count]] >= least)
            ++count;
        std::vector<std::vector<Mode<Dimension>>> found(count);
        pool.for_each(count, [&](std::size_t i, unsigned worker) {
            found[i] = find_modes<K>(labels[order[first + i]], bandwidth, options, memory[worker]);
        });
        for (const auto& modes : found) strongest.insert(strongest.end(), modes.begin(), modes.end());
        detail::keep_strongest(strongest, most, keep);
        if (count < std::min(at_once, labels.size() - first)) break;
    }
    return strongest;
}

}  // namespace ism
