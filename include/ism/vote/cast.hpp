// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "ism/codebook/codebook.hpp"
#include "ism/model/occurrence.hpp"
#include "ism/vote/vote.hpp"
#include "ism/vote/vote_space.hpp"

namespace ism {

/// @brief Which votes can be of an object in the picture.
struct VoteLimits {
    double width = 0, height = 0;  ///< the centre lies in a picture of this size, pixels; 0 = anywhere
    double min_scale = 0;
    double max_scale = std::numeric_limits<double>::infinity();
    float min_weight = 0;  ///< lighter votes are dropped
};

namespace detail {

/// Rising labels; votes of one label stay in their order. Labels are mostly numbers of classes, which can be
/// counted, but a user's may be anything.
template <std::size_t Dimension>
void sort_by_label(std::vector<Vote<Dimension>>& votes) {
    std::uint32_t last = 0;
    for (const auto& vote : votes) last = std::max(last, vote.label);
    if (last > 2 * votes.size()) {
        std::stable_sort(votes.begin(), votes.end(),
                         [](const auto& a, const auto& b) { return a.label < b.label; });
        return;
    }
    std::vector<std::size_t> next(std::size_t(last) + 2, 0);
    for (const auto& vote : votes) ++next[vote.label + 1];
    for (std::size_t label = 1; label < next.size(); ++label) next[label] += next[label - 1];
    std::vector<Vote<Dimension>> sorted(votes.size());
    for (const auto& vote : votes) sorted[next[vote.label]++] = vote;
    votes = std::move(sorted);
}

}  // namespace detail

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
            if (is_usable(vote)) votes.push_back(vote);
        }
    }
    if constexpr (Space::has_label) detail::sort_by_label(votes);
    return votes;
}

}  // namespace ism
