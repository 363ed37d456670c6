// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/codebook/codebook.hpp"
#include "ism/codebook/match_block.hpp"
#include "ism/codebook/word_index.hpp"
#include "ism/core/error.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/feature/feature.hpp"

namespace ism {

/// @brief How match() works.
struct MatchOptions {
    MatchMode mode = MatchMode::all;                 ///< `nearest` gives what nearest_only() leaves of all
    std::size_t max_matches = std::size_t(1) << 26;  ///< more, 1 GiB of them, are refused
};

/// @brief The words that each descriptor looks like, by feature and within a feature by word. Exact: a fast
/// filter only tells which words may lie within the threshold, and their distances are then taken in double.
/// Where several words are equally near the first is the nearest. A descriptor with NaN or infinite numbers
/// matches nothing. Beside the matches each thread needs little, and 3 kB a word where everything matches.
/// @throws Error where there are more than `max_matches`.
template <std::size_t Dimension, DescriptorScalar Scalar, DescriptorScalar WordScalar>
[[nodiscard]] std::vector<Match> match(const WordIndex<Dimension, WordScalar>& index,
                                       const Descriptors<Scalar, Dimension>& descriptors,
                                       unsigned threads = 0, const MatchOptions& options = {}) {
    const std::size_t blocks = (descriptors.size() + detail::filter_block - 1) / detail::filter_block;
    std::vector<std::vector<Match>> found(blocks);
    ThreadPool pool(unsigned(std::min<std::size_t>(thread_count(threads), std::max<std::size_t>(1, blocks))));
    using Matcher = detail::BlockMatcher<Dimension, WordScalar>;
    std::vector<Matcher> matchers(pool.size(), Matcher(index));
    std::atomic<std::size_t> total = 0;
    pool.for_each(blocks, [&](std::size_t block, unsigned worker) {
        Matcher& matcher = matchers[worker];
        matcher.load(descriptors, block * detail::filter_block);
        matcher.find(options.mode);
        found[block] = matcher.matches(options.mode);
        const std::size_t so_far = total += found[block].size();
        expect(so_far <= options.max_matches, "matching: number of matches",
               lazy_text("at most ", options.max_matches), "more: lower the threshold, or ask in parts");
    });
    std::vector<Match> matches;
    matches.reserve(total);
    for (std::vector<Match>& part : found) {
        matches.insert(matches.end(), part.begin(), part.end());
        part = {};
    }
    return matches;
}

/// @brief The words of a codebook that each descriptor looks like: makes an index for this once.
template <std::size_t Dimension, DescriptorScalar Scalar, DescriptorScalar WordScalar>
[[nodiscard]] std::vector<Match> match(const Codebook<Dimension, WordScalar>& codebook,
                                       const Descriptors<Scalar, Dimension>& descriptors,
                                       unsigned threads = 0, const MatchOptions& options = {}) {
    return match(WordIndex<Dimension, WordScalar>(codebook), descriptors, threads, options);
}

/// @brief Of the matches of match() the nearest word of each group, with the weight 1.
[[nodiscard]] inline std::vector<Match> nearest_only(std::span<const Match> matches) {
    std::vector<Match> nearest;
    for (const Match& match : matches)
        if (match.nearest) nearest.push_back({match.feature, match.word, 1.0f, true});
    return nearest;
}

}  // namespace ism
