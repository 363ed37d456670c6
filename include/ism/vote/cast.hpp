// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ism/codebook/codebook.hpp"
#include "ism/core/error.hpp"
#include "ism/core/order.hpp"
#include "ism/model/shape_model.hpp"
#include "ism/vote/placement.hpp"
#include "ism/vote/posed_object.hpp"
#include "ism/vote/vote.hpp"
#include "ism/vote/vote_space.hpp"

namespace ism {

/// @brief Which votes can be of an object in the image.
struct VoteLimits {
    double width = 0, height = 0;  ///< the centre lies in an image of this size, pixels; 0 = anywhere
    double min_scale = 0;
    double max_scale = std::numeric_limits<double>::infinity();
    float min_weight = 0;  ///< lighter votes are dropped
    /// Training objects first … end − 1 cast no votes, as if they had not been seen: the other occurrences of
    /// a word have its whole weight.
    std::uint32_t without_first = 0, without_end = 0;
    /// In a space with depth: how much the logarithm of an object's size in metres, by its scale and depth,
    /// deviates from that of training; votes weigh less by this likelihood.
    double size_deviation = 0.25;
    /// In a space with poses: by how much a feature may be larger or smaller, in metres, than that of
    /// training.
    double max_size_ratio = 1.5;
};

/// @brief Validates limits.
/// @throws Error for one out of range.
inline void check(const VoteLimits& limits) {
    expect(limits.width >= 0 && limits.height >= 0, "VoteLimits::width, height", "0 or more",
           lazy_text(limits.width, ", ", limits.height));
    expect(limits.min_scale >= 0 && limits.max_scale >= limits.min_scale, "VoteLimits::min_scale, max_scale",
           "0 or more, and rising", lazy_text(limits.min_scale, ", ", limits.max_scale));
    expect(limits.min_weight >= 0, "VoteLimits::min_weight", "0 or more", limits.min_weight);
    expect(limits.size_deviation > 0 && std::isfinite(limits.size_deviation), "VoteLimits::size_deviation",
           "above 0", limits.size_deviation);
    expect(limits.max_size_ratio >= 1, "VoteLimits::max_size_ratio", "1 or more", limits.max_size_ratio);
}

namespace detail {

/// Rising labels; votes of one label stay in their order. Labels are mostly numbers of classes, which can be
/// counted, but a user's may be anything.
template <std::size_t Dimension>
void sort_by_label(std::vector<Vote<Dimension>>& votes) {
    std::uint32_t last = 0;
    for (const auto& vote : votes) last = std::max(last, vote.label);
    if (last > 2 * votes.size()) {
        sort_by(votes, [](const auto& vote) { return vote.label; });
        return;
    }
    std::vector<std::uint32_t> next(std::size_t(last) + 2, 0);
    for (const auto& vote : votes) ++next[vote.label + 1];
    for (std::size_t label = 1; label < next.size(); ++label) next[label] += next[label - 1];
    std::vector<Vote<Dimension>> sorted(votes.size());
    for (const auto& vote : votes) sorted[next[vote.label]++] = vote;
    votes = std::move(sorted);
}

/// By how much the other occurrences of a word gain weight where some are left out; 0 where all are.
template <std::predicate<const Occurrence&> LeftOut>
[[nodiscard]] double weight_gain(std::span<const Occurrence> word, const LeftOut& left_out) {
    double all = 0, rest = 0;
    for (const Occurrence& o : word) {
        all += o.weight;
        if (!left_out(o)) rest += o.weight;
    }
    return rest > 0 ? all / rest : 0;
}

/// How well an object placed so, at a depth, has the size in metres of the training object, 0 … 1; 0 from
/// three deviations on, 1 where one of the sizes is not known.
[[nodiscard]] inline double size_likelihood(const Placement& placement, double depth_m,
                                            const TrainingObject& object, const Camera* camera,
                                            double deviation) {
    if (camera == nullptr || !(object.size_m > 0)) return 1;
    const double ratio = placement.scale * reference_size_px * depth_m / camera->fx / object.size_m;
    const double off = std::log(ratio) / deviation;
    return std::abs(off) < 3 ? std::exp(-off * off / 2) : 0;
}

}  // namespace detail

/// @brief Casts the votes of matched features: each through every occurrence of each of its words. Votes
/// lighter than `min_weight` are dropped, and in a space that needs depth those of features without a
/// reading, in one with poses those without a local frame. In a space with depth those for objects of another
/// size in metres than in training weigh less.
/// @param camera  of the image; null = not known
/// @param frames  of the features; only for a space with poses
/// @return the votes by label, then feature, word and occurrence
/// @throws Error for limits out of range, and in a space with poses without a camera or frames, or for a
/// model that knows no frames.
template <VoteSpaceType Space>
[[nodiscard]] std::vector<Vote<Space::dimension>> cast_votes(
    const std::vector<Feature>& features, const std::vector<Match>& matches, const ShapeModel& shapes,
    const Camera* camera = nullptr, const VoteLimits& limits = {},
    const std::vector<std::optional<LocalFrame>>& frames = {}) {
    using V = Vote<Space::dimension>;
    check(limits);
    if constexpr (Space::needs_pose) {
        expect(!shapes.frames.empty() || shapes.occurrences.values().empty(),
               "votes of a space with poses: model", "one of learn_metric()", "one without local frames");
        expect(camera != nullptr, "votes of a space with poses: camera", "one", "none");
        expect(frames.size() == features.size(), "votes of a space with poses: local frames", features.size(),
               frames.size());
    }
    std::vector<V> votes;
    const auto left_out = [&](const Occurrence& o) {
        return o.object >= limits.without_first && o.object < limits.without_end;
    };
    for (const Match& match : matches) {
        const Feature& feature = features[match.feature];
        if (Space::needs_depth && !is_depth(feature.depth_m)) continue;
        const std::span<const Occurrence> word = shapes.occurrences[match.word];
        const double gain = limits.without_end > 0 ? detail::weight_gain(word, left_out) : 1;
        for (std::size_t k = 0; k < word.size(); ++k) {
            const Occurrence& occurrence = word[k];
            float weight = match.weight * static_cast<float>(occurrence.weight * gain);
            if (weight < limits.min_weight || (limits.without_end > 0 && left_out(occurrence))) continue;
            VoteSource source{feature, occurrence, shapes.objects[occurrence.object], camera,
                              placement(feature, occurrence)};
            if constexpr (Space::needs_pose) {
                const OccurrenceFrame& seen = shapes.frames[occurrence.feature];
                const std::optional<Pose> pose =
                    posed(feature, frames[match.feature], seen, *camera, limits.max_size_ratio);
                if (!pose) continue;
                source.pose = *pose;
                source.placement = placement(*pose, source.object, *camera);
            } else if constexpr (Space::needs_depth) {
                if (!is_depth(centre_depth_m(feature, occurrence))) continue;  // behind the camera
                weight *= static_cast<float>(
                    detail::size_likelihood(source.placement, centre_depth_m(feature, occurrence),
                                            source.object, camera, limits.size_deviation));
                if (!(weight > 0) || weight < limits.min_weight) continue;
            }
            const auto& [centre, scale, angle] = source.placement;
            if (scale < limits.min_scale || scale > limits.max_scale) continue;
            if (limits.width > 0 &&
                (centre.x < 0 || centre.y < 0 || centre.x >= limits.width || centre.y >= limits.height))
                continue;
            const V vote{.at = Space::position(source),
                         .scale = static_cast<float>(scale),
                         .weight = weight,
                         .label = Space::label(source),
                         .feature = match.feature,
                         .word = match.word,
                         .occurrence = shapes.occurrences.first(match.word) + static_cast<std::uint32_t>(k)};
            if (is_usable(vote)) votes.push_back(vote);
        }
    }
    if constexpr (Space::has_label) detail::sort_by_label(votes);
    return votes;
}

}  // namespace ism
