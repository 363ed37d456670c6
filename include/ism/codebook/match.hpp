// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "ism/codebook/codebook.hpp"
#include "ism/codebook/match_block.hpp"
#include "ism/codebook/word_index.hpp"
#include "ism/core/error.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/feature/feature.hpp"

namespace ism {

/// @brief More matches, 1 GiB of them, are refused.
inline constexpr std::size_t max_matches = std::size_t(1) << 26;

/// @brief The words that each descriptor looks like, by feature and within a feature by word. Exact: a fast
/// filter only tells which words may lie within the threshold, and their distances are then taken in double.
/// Where several words are equally near the first is the nearest. A descriptor with NaN or infinite numbers
/// matches nothing. Beside the matches each thread needs little, and 3 kB a word where everything matches.
/// @throws Error where the descriptors are of another dimension, or there are more than `most` matches.
[[nodiscard]] inline std::vector<Match> match(const WordIndex& index, const Descriptors<float>& descriptors,
                                              ThreadPool& pool, std::size_t most = max_matches) {
    if (descriptors.empty()) return {};
    expect(descriptors.dimension() == index.dimension(), "matching: dimension of descriptors",
           index.dimension(), descriptors.dimension());
    const std::size_t blocks = (descriptors.size() + detail::filter_block - 1) / detail::filter_block;
    std::vector<std::vector<Match>> found(blocks);
    std::vector<detail::BlockMatcher> matchers(pool.size());
    for (detail::BlockMatcher& matcher : matchers) matcher.start(index);
    std::atomic<std::size_t> total = 0;
    pool.for_each(blocks, [&](std::size_t block, unsigned worker) {
        found[block] = matchers[worker].match(descriptors, block * detail::filter_block);
        const std::size_t so_far = total += found[block].size();
        expect(so_far <= most, "matching: number of matches", lazy_text("at most ", most),
               "more: lower the threshold, or ask in parts");
    });
    std::vector<Match> matches;
    matches.reserve(total);
    for (std::vector<Match>& part : found) {
        detail::append(matches, part);
        part = std::vector<Match>();  // whose memory is not needed twice
    }
    return matches;
}

/// @brief The words of a codebook that each descriptor looks like: makes an index for this once.
/// @param threads  0 = all hardware threads
[[nodiscard]] inline std::vector<Match> match(const Codebook& codebook, const Descriptors<float>& descriptors,
                                              unsigned threads = 0) {
    ThreadPool pool(threads);
    return match(WordIndex(codebook), descriptors, pool);
}

/// @brief Of the matches of match() the nearest word of each group, with the weight 1.
[[nodiscard]] inline std::vector<Match> nearest_only(const std::vector<Match>& matches) {
    std::vector<Match> nearest;
    for (Match match : matches) {
        match.weight = 1;
        if (match.nearest) nearest.push_back(match);
    }
    return nearest;
}

}  // namespace ism
