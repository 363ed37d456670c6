// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "ism/codebook/word_index.hpp"
#include "ism/core/error.hpp"
#include "ism/core/order.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/feature/feature.hpp"

namespace ism {

/// @brief No word: what a descriptor with NaN or infinite numbers has for neighbours.
inline constexpr std::uint32_t no_word = std::numeric_limits<std::uint32_t>::max();

/// @brief A word near a descriptor.
struct Neighbour {
    std::uint32_t word = no_word;
    float sq_distance = std::numeric_limits<float>::infinity();  ///< as Codebook has it, taken in double
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

/// @brief The `count` nearest words of each descriptor, whatever the threshold of the codebook: row f of
/// neighbours_each() entries holds those of descriptor f, nearest first, of equally near ones the first word
/// first. Exact, as match() is, and the same bits for any number of threads. The neighbours of a descriptor
/// with NaN or infinite numbers are `no_word`.
/// @param without  words that are none's neighbours: those of the descriptors' own image, in training
/// @throws Error where the descriptors are of another dimension.
[[nodiscard]] inline std::vector<Neighbour> nearest_words(const WordIndex& index,
                                                          const Descriptors<float>& descriptors,
                                                          std::size_t count, ThreadPool& pool,
                                                          WordRange without = {}) {
    if (descriptors.empty()) return {};
    expect(descriptors.dimension() == index.dimension(), "nearest words: dimension of descriptors",
           index.dimension(), descriptors.dimension());
    const std::size_t each = neighbours_each(index, count, without);
    std::vector<Neighbour> neighbours(descriptors.size() * each);
    pool.for_each(descriptors.size(), [&](std::size_t f, unsigned) {
        const float* row = descriptors.row(f).data();
        const double sq_length = index.sq_length(row);
        if (!(sq_length < std::numeric_limits<double>::infinity())) return;
        std::vector<detail::Ranked> order;
        for (std::uint32_t word = 0; word < index.size(); ++word)
            if (!(without.first <= word && word < without.end))
                order.push_back({detail::rising(index.sq_distance(row, sq_length, word)), word});
        detail::sort_ranked(order);
        for (std::size_t k = 0; k < each; ++k)
            neighbours[f * each + k] = {order[k].index,
                                        float(index.sq_distance(row, sq_length, order[k].index))};
    });
    return neighbours;
}

}  // namespace ism
