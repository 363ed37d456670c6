// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "ism/codebook/nearest_block.hpp"
#include "ism/codebook/word_index.hpp"
#include "ism/core/error.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/feature/feature.hpp"

namespace ism {

/// @brief No word: what a descriptor with NaN or infinite numbers has for neighbours.
inline constexpr std::uint32_t no_word = std::numeric_limits<std::uint32_t>::max();

/// @brief A word near a descriptor.
struct Neighbour {
    std::uint32_t word = no_word;
    /// That of Codebook, taken in double. Where the word is the descriptor itself it may fall below 0, by
    /// what its squared length, a float, was rounded.
    float sq_distance = std::numeric_limits<float>::infinity();
    [[nodiscard]] bool operator==(const Neighbour&) const = default;
};

/// @brief The words first … end − 1.
struct WordRange {
    std::uint32_t first = 0, end = 0;
};

/// @brief How many neighbours nearest_words() gives each descriptor: `count`, or all words there are.
[[nodiscard]] inline std::size_t neighbours_each(const WordIndex& index, std::size_t count,
                                                 WordRange without = {}) {
    const std::size_t end = std::min<std::size_t>(without.end, index.size());
    return std::min(count, index.size() - (end - std::min<std::size_t>(without.first, end)));
}

/// @brief The `count` nearest words of each descriptor, for voting in which every training feature is a word
/// of its own (local naive Bayes nearest neighbour, McCann and Lowe 2012). Row f of neighbours_each() entries
/// holds those of descriptor f, nearest first, of equally near ones the first word first. Exact as match()
/// is, whatever the threshold of the codebook; fastest where that is infinite and `count` small. A descriptor
/// with NaN or infinite numbers has `no_word` for all its neighbours.
/// @param without  words that are no neighbours: in training those of the descriptors' own image
/// @throws Error where the descriptors are of another dimension.
[[nodiscard]] inline std::vector<Neighbour> nearest_words(const WordIndex& index,
                                                          const Descriptors<float>& descriptors,
                                                          std::size_t count, ThreadPool& pool,
                                                          WordRange without = {}) {
    if (descriptors.empty()) return {};
    expect(descriptors.dimension() == index.dimension(), "nearest words: dimension of descriptors",
           index.dimension(), descriptors.dimension());
    const std::size_t each = neighbours_each(index, count, without);
    if (each == 0) return {};
    std::vector<Neighbour> neighbours(descriptors.size() * each);
    const std::size_t blocks = (descriptors.size() + detail::filter_block - 1) / detail::filter_block;
    std::vector<detail::BlockNearest> searches(pool.size(),
                                               detail::BlockNearest(index, each, without.first, without.end));
    pool.for_each(blocks, [&](std::size_t block, unsigned worker) {
        const std::size_t first = block * detail::filter_block;
        Neighbour* to = neighbours.data() + first * each;
        for (const detail::NearWord& near : searches[worker].find(descriptors, first))
            *to++ = {near.word, float(near.sq_distance)};
    });
    return neighbours;
}

}  // namespace ism
