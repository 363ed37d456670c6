// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "ism/codebook/codebook.hpp"
#include "ism/vote/occurrence.hpp"
#include "ism/vote/vote_space.hpp"

namespace ism {

/// @brief One vote: a point of the vote space with its weight, and where it comes from.
template <std::size_t Dimension>
struct Vote {
    std::array<float, Dimension> at;
    float scale = 1;          ///< s_f / s_i, whether the space has such an axis or not
    float weight = 0;         ///< p(word | feature) · p(occurrence | word)
    std::uint32_t label = 0;  ///< of the discrete axis; 0 where there is none
    std::uint32_t feature = 0, word = 0, occurrence = 0;
};

/// @brief Which votes can be of an object in the picture.
struct VoteLimits {
    double width = 0, height = 0;  ///< the centre lies in a picture of this size, pixels; 0 = anywhere
    double min_scale = 0;
    double max_scale = std::numeric_limits<double>::infinity();
    float min_weight = 0;  ///< lighter votes are dropped
};

/// @brief Casts the votes of matched features: each through every occurrence of each of its words. Votes
/// lighter than `min_weight` are dropped, and in a space that needs depth those of features without a
/// reading.
/// @return the votes by label, then feature, word and occurrence
template <AnyVoteSpace Space>
[[nodiscard]] std::vector<Vote<Space::dimension>> cast_votes(std::span<const Feature> features,
                                                             std::span<const Match> matches,
                                                             const Shapes& shapes,
                                                             const VoteLimits& limits = {}) {
    using V = Vote<Space::dimension>;
    std::vector<V> votes;
    for (const Match& match : matches) {
        const Feature& feature = features[match.feature];
        if (Space::needs_depth && !is_depth(feature.depth_m)) continue;
        for (std::uint32_t i = shapes.first[match.word]; i < shapes.first[match.word + 1]; ++i) {
            const Occurrence& occurrence = shapes.occurrences[i];
            const float weight = match.weight * occurrence.weight;
            if (weight < limits.min_weight) continue;
            const double scale = scale_ratio(feature, occurrence);
            if (scale < limits.min_scale || scale > limits.max_scale) continue;
            if (limits.width > 0) {
                const double x = X::vote(feature, occurrence), y = Y::vote(feature, occurrence);
                if (x < 0 || y < 0 || x >= limits.width || y >= limits.height) continue;
            }
            const V vote{.at = Space::position(feature, occurrence),
                         .scale = static_cast<float>(scale),
                         .weight = weight,
                         .label = Space::label(feature, occurrence),
                         .feature = match.feature,
                         .word = match.word,
                         .occurrence = i};
            if (std::all_of(vote.at.begin(), vote.at.end(), [](float v) { return std::isfinite(v); }))
                votes.push_back(vote);
        }
    }
    if constexpr (Space::has_label)
        std::stable_sort(votes.begin(), votes.end(),
                         [](const V& a, const V& b) { return a.label < b.label; });
    return votes;
}

}  // namespace ism
