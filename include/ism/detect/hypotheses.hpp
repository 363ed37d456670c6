// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/codebook/match.hpp"
#include "ism/core/frame.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/detect_options.hpp"
#include "ism/detect/detection.hpp"
#include "ism/vote/cast.hpp"
#include "ism/vote/kernel.hpp"
#include "ism/vote/strongest_modes.hpp"

namespace ism {

namespace detail {

/// The value below which half of the weight lies; NaN without weight.
[[nodiscard]] inline double weighted_median(std::vector<std::pair<double, double>> value_and_weight) {
    std::stable_sort(value_and_weight.begin(), value_and_weight.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    double total = 0, sum = 0;
    for (const auto& [value, weight] : value_and_weight) total += weight;
    for (const auto& [value, weight] : value_and_weight)
        if ((sum += weight) >= total / 2) return value;
    return no_depth;
}

/// Tells from the votes of a window what the object would be: class, centre, scale, box, depth, position,
/// support.
template <std::size_t Dimension>
[[nodiscard]] Detection describe_hypothesis(double score,
                                            std::vector<std::pair<const Vote<Dimension>*, double>> window,
                                            std::span<const Feature> features, const Shapes& shapes,
                                            const Frame& frame) {
    std::vector<double> of_class(shapes.class_names.size(), 0);
    for (const auto& [vote, kernel] : window)
        of_class[shapes.occurrences[vote->occurrence].class_index] += vote->weight * kernel;
    Detection result;
    result.class_index =
        static_cast<std::size_t>(std::max_element(of_class.begin(), of_class.end()) - of_class.begin());
    result.score = score;
    std::erase_if(window, [&](const auto& entry) {
        return shapes.occurrences[entry.first->occurrence].class_index != result.class_index;
    });

    double total = 0, x = 0, y = 0, scale = 0, width = 0, height = 0;
    std::vector<std::pair<double, double>> depths;
    for (const auto& [vote, kernel] : window) {
        const double weight = vote->weight * kernel;
        const Feature& f = features[vote->feature];
        const Occurrence& o = shapes.occurrences[vote->occurrence];
        const TrainingObject& object = shapes.objects[o.object];
        total += weight;
        x += weight * X::vote(f, o);
        y += weight * Y::vote(f, o);
        scale += weight * vote->scale;
        width += weight * vote->scale * object.width;
        height += weight * vote->scale * object.height;
        if (is_depth(f.depth_m))
            depths.emplace_back(f.depth_m - (std::isfinite(o.depth_m) ? o.depth_m : 0), weight);
        result.support.push_back({vote->feature, vote->word, vote->occurrence, static_cast<float>(weight)});
    }
    result.centre = {x / total, y / total};
    result.scale = scale / total;
    result.box = box_around(result.centre, width / total, height / total);
    result.depth_m = weighted_median(std::move(depths));
    if (frame.camera && is_depth(result.depth_m))
        result.position_m = back_project(*frame.camera, result.centre, result.depth_m);
    std::stable_sort(result.support.begin(), result.support.end(),
                     [](const Support& a, const Support& b) { return a.weight > b.weight; });
    return result;
}

}  // namespace detail

/// @brief The places where votes agree, strongest first over all labels, at most
/// DetectOptions::max_candidates, each told as a detection without segmentation.
/// @param votes  as cast_votes gives them: by rising label
template <AnyVoteSpace Space, Kernel K = EpanechnikovKernel>
[[nodiscard]] std::vector<Detection> find_hypotheses(std::span<const Vote<Space::dimension>> votes,
                                                     std::span<const Feature> features, const Shapes& shapes,
                                                     const Frame& frame,
                                                     const DetectOptions<Space>& options = {}) {
    constexpr std::size_t dimension = Space::dimension;
    const auto labels = split_by_label(votes);
    const auto modes =
        strongest_modes<K>(std::span<const std::span<const Vote<dimension>>>(labels), options.bandwidth,
                           options.mean_shift, options.max_candidates, options.keep, options.threads);
    std::vector<Detection> hypotheses(modes.size());
    parallel_for(modes.size(), options.threads, [&](std::size_t i) {
        const auto of_label = std::lower_bound(
            labels.begin(), labels.end(), modes[i].label,
            [](const auto& part, std::uint32_t label) { return part.front().label < label; });
        const auto extent = options.bandwidth.at(modes[i].scale);
        std::vector<std::pair<const Vote<dimension>*, double>> window;
        for (const Vote<dimension>& vote : *of_label) {
            const double kernel = K::profile(static_cast<float>(sq_windows(vote.at, modes[i].at, extent)));
            if (kernel > 0) window.emplace_back(&vote, kernel);
        }
        hypotheses[i] =
            detail::describe_hypothesis(modes[i].score, std::move(window), features, shapes, frame);
    });
    std::erase_if(hypotheses, [](const Detection& hypothesis) { return hypothesis.support.empty(); });
    return hypotheses;
}

/// @brief Casts the votes of matched features and finds where they agree: see find_hypotheses().
/// @throws Error for an option out of range or shapes without objects.
template <AnyVoteSpace Space, Kernel K = EpanechnikovKernel>
[[nodiscard]] std::vector<Detection> vote_for(std::span<const Feature> features,
                                              std::span<const Match> matches, const Shapes& shapes,
                                              const Frame& frame, const DetectOptions<Space>& options = {}) {
    check(options);
    expect(!shapes.objects.empty(), "detection: training objects of the model", "1 or more", 0);
    const auto [smallest, largest] = std::minmax_element(
        shapes.objects.begin(), shapes.objects.end(),
        [](const TrainingObject& a, const TrainingObject& b) { return a.size_px < b.size_px; });
    const double min_size_px = options.min_size_px > 0 ? options.min_size_px : smallest->size_px / 2;
    const double max_size_px = options.max_size_px > 0 ? options.max_size_px : largest->size_px * 2;
    std::vector<Match> nearest;
    if (options.matching == MatchMode::nearest) nearest = nearest_only(matches);
    const auto voting = options.matching == MatchMode::nearest ? std::span<const Match>(nearest) : matches;
    const auto votes = cast_votes<Space>(features, voting, shapes,
                                         {.width = static_cast<double>(frame.gray.width()),
                                          .height = static_cast<double>(frame.gray.height()),
                                          .min_scale = min_size_px / reference_size_px,
                                          .max_scale = max_size_px / reference_size_px,
                                          .min_weight = options.min_vote_weight});
    return find_hypotheses<Space, K>(votes, features, shapes, frame, options);
}

}  // namespace ism
