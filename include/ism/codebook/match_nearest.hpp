// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ism/codebook/codebook.hpp"
#include "ism/codebook/nearest_words.hpp"
#include "ism/codebook/word_index.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/feature/feature.hpp"

namespace ism {

/// @brief The `neighbours` nearest words of each descriptor, each with the weight d²ₙ₊₁ − d²ᵢ: as much as it
/// is nearer than the first that is left out. What looks like many things says little (local naive Bayes
/// nearest neighbour, McCann and Lowe 2012). By feature and within a feature by distance; words of weight 0
/// are left out.
/// @param without  words that are none's neighbours
/// @throws Error where the descriptors are of another dimension.
[[nodiscard]] inline std::vector<Match> match_nearest(const WordIndex& index,
                                                      const Descriptors<float>& descriptors,
                                                      std::size_t neighbours, ThreadPool& pool,
                                                      WordRange without = {}) {
    const std::vector<Neighbour> near = nearest_words(index, descriptors, neighbours + 1, pool, without);
    const std::size_t each = neighbours_each(index, neighbours + 1, without);
    std::vector<Match> matches;
    for (std::size_t f = 0; f < descriptors.size() && each > 0; ++f) {
        const Neighbour* const row = near.data() + f * each;
        for (std::size_t i = 0; i + 1 < each; ++i) {
            const float weight = row[each - 1].sq_distance - row[i].sq_distance;
            if (row[i].word == no_word || !(weight > 0)) continue;
            matches.push_back({static_cast<std::uint32_t>(f), row[i].word, weight, i == 0});
        }
    }
    return matches;
}

}  // namespace ism
