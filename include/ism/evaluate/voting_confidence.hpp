// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "ism/core/geometry.hpp"
#include "ism/core/region_mask.hpp"
#include "ism/detect/scene.hpp"
#include "ism/vote/bandwidth.hpp"
#include "ism/vote/kernel.hpp"
#include "ism/vote/mean_shift.hpp"
#include "ism/vote/placement.hpp"
#include "ism/vote/vote_grid.hpp"
#include "ism/vote/vote_space.hpp"

namespace ism {

/// @brief An object as votes should tell it.
struct TrueObject {
    std::uint32_t class_index = 0;
    Box box;                              ///< pixels
    RegionMask mask = {};                 ///< features on it are its own
    double depth_m = no_depth;            ///< of its centre
    std::optional<Point3> centre_m = {};  ///< in the camera frame; for spaces with poses
};

/// @brief To what degree the votes of an object's features for its class agree on the object (Zhang and
/// Kjellström, section 3D Detection: "to what degree votes agree on the same object hypothesis"), as shares
/// of their weight, 0 … 1; NaN where they cast none.
struct VotingConfidence {
    double at_hypothesis =
        std::numeric_limits<double>::quiet_NaN();                ///< in the window of the hypothesis that
                                                                 ///< mean shift reaches from the true place
    double at_truth = std::numeric_limits<double>::quiet_NaN();  ///< in the window around the true place
    bool found = false;  ///< whether that hypothesis is less than a window from the true place
};

/// @brief The share of the votes' weight in a window, ends included; NaN without votes.
template <std::size_t Dimension>
[[nodiscard]] double share_in_window(std::span<const Vote<Dimension>> votes,
                                     const std::array<double, Dimension>& at,
                                     const std::array<double, Dimension>& window) {
    double inside = 0, all = 0;
    for (const auto& vote : votes) {
        all += vote.weight;
        if (sq_windows(vote.at, at, window) <= 1) inside += vote.weight;
    }
    return inside / all;
}

/// @brief Where in a vote space an object is: where a feature at its centre, of scale 1 at the reference
/// size, votes.
template <VoteSpaceType Space>
[[nodiscard]] Mode<Space::dimension> true_place(const TrueObject& object, const Camera* camera) {
    const Point2 centre = object.box.centre();
    const double scale = scale_of(object.box);
    const Feature feature{
        .x = float(centre.x), .y = float(centre.y), .scale = float(scale), .depth_m = float(object.depth_m)};
    const Occurrence occurrence{.class_index = object.class_index};
    const TrainingObject trained{};
    const Point3 at = object.centre_m.value_or(Point3{});
    const VoteSource source{
        feature, occurrence, trained, camera, placement(feature, occurrence), {.centre_m = to_vec3f(at)}};
    Mode<Space::dimension> place{.at = {}, .scale = scale, .label = object.class_index};
    const auto position = Space::position(source);
    for (std::size_t k = 0; k < Space::dimension; ++k) place.at[k] = position[k];
    return place;
}

/// @brief The voting confidence of an object among the votes of a scene. Votes for other classes do not
/// count, in a space without classes too.
/// @param votes  of the scene, as cast_votes() gives them
template <VoteSpaceType Space, Kernel K = EpanechnikovKernel>
[[nodiscard]] VotingConfidence voting_confidence(
    const Scene& scene, const TrueObject& object, std::span<const Vote<Space::dimension>> votes,
    const Bandwidth<Space::dimension>& bandwidth = default_bandwidth<Space>()) {
    std::vector<Vote<Space::dimension>> of_class, own;
    for (const auto& vote : votes) {
        if (scene.model.shapes.occurrence(vote.occurrence).class_index != object.class_index) continue;
        of_class.push_back(vote);
        const Feature& f = scene.features[vote.feature];
        if (contains(object.mask, int(std::lround(f.x)), int(std::lround(f.y)))) own.push_back(vote);
    }
    VotingConfidence result;
    if (own.empty()) return result;
    const auto truth = true_place<Space>(object, scene.frame.camera ? &*scene.frame.camera : nullptr);
    const std::span<const Vote<Space::dimension>> own_votes = own;
    result.at_truth = share_in_window(own_votes, truth.at, bandwidth.at(truth.scale));
    VoteGrid<Space::dimension> search;
    search.assign(std::span<const Vote<Space::dimension>>(of_class), bandwidth);
    const MeanShiftOptions steps;
    auto hypothesis = truth;
    for (int i = 0; i < steps.max_iterations; ++i)
        if (shift_once<K>(search, hypothesis) < steps.tolerance * steps.tolerance) break;
    result.at_hypothesis = share_in_window(own_votes, hypothesis.at, bandwidth.at(hypothesis.scale));
    result.found = sq_windows(hypothesis.at, truth.at, bandwidth.at(truth.scale)) < 1;
    return result;
}

}  // namespace ism
