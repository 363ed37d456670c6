// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "ism/codebook/match.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/order.hpp"
#include "ism/detect/detect_options.hpp"
#include "ism/detect/detection.hpp"
#include "ism/detect/scene.hpp"
#include "ism/vote/cast.hpp"
#include "ism/vote/kernel.hpp"
#include "ism/vote/placement.hpp"
#include "ism/vote/strongest_modes.hpp"

namespace ism {

/// @brief The value below which half of the weight lies; NaN without values.
[[nodiscard]] inline double weighted_median(const std::vector<double>& values,
                                            const std::vector<double>& weights) {
    std::vector<detail::Ranked> order(values.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = {detail::rising(values[i]), i};
    detail::sort_ranked(order.data(), order.size());
    double total = 0, sum = 0;
    for (const detail::Ranked& ranked : order) total += weights[ranked.index];
    for (const detail::Ranked& ranked : order)
        if ((sum += weights[ranked.index]) >= total / 2) return values[ranked.index];
    return no_depth;
}

/// @brief How votes of a window become a hypothesis.
using DescribeHypothesis = Detection(double score, std::vector<Support> window, const Scene& scene);

namespace detail {

/// Strongest first.
inline void sort_by_score(std::vector<Detection>& detections) {
    sort_by(detections, [](const Detection& d) { return falling(d.score); });
}

/// Where the object of a vote lies: by the scale of its feature, or at a depth, as large as in training.
[[nodiscard]] inline Placement placed_by(const Feature& f, const Occurrence& o, const TrainingObject& object,
                                         const Camera* camera, double depth_m) {
    Placement placed = placement(f, o);
    if (camera == nullptr || !is_depth(depth_m) || !(object.size_m > 0)) return placed;
    placed.centre = {0, 0};
    placed.scale = object.size_m * camera->fx / depth_m / reference_size_px;
    const Point2 offset = to_image(placed, {o.x, o.y});
    placed.centre = {f.x - offset.x, f.y - offset.y};
    return placed;
}

/// Drops the votes for all classes but that of the most weight.
/// @return that class
inline std::uint32_t keep_heaviest_class(std::vector<Support>& window, const ShapeModel& shapes) {
    const auto class_of = [&](const Support& s) { return shapes.occurrence(s.occurrence).class_index; };
    std::vector<double> weights(shapes.class_names.size(), 0);
    for (const Support& s : window) weights[class_of(s)] += s.weight;
    const auto heaviest =
        static_cast<std::uint32_t>(std::max_element(weights.begin(), weights.end()) - weights.begin());
    drop_if(window, [&](const Support& s) { return class_of(s) != heaviest; });
    return heaviest;
}

/// Drops the votes for an object at another depth, which agree in s·d if it is of one size.
/// @return the share of weight that stays
inline double keep_at_depth(std::vector<Support>& window, const Scene& scene, double depth_m) {
    double all = 0, kept = 0;
    drop_if(window, [&](const Support& s) {
        const double d =
            centre_depth_m(scene.features[s.feature], scene.model.shapes.occurrence(s.occurrence));
        const bool other = std::abs(d - depth_m) > Depth::bandwidth;
        all += s.weight;
        if (!other) kept += s.weight;
        return other;
    });
    return kept / all;
}

[[nodiscard]] inline Detection describe_votes(double score, std::vector<Support> window, const Scene& scene,
                                              bool by_depth) {
    const ShapeModel& shapes = scene.model.shapes;
    const Camera* const camera = scene.frame.camera ? &*scene.frame.camera : nullptr;
    Detection result;
    result.class_index = keep_heaviest_class(window, shapes);
    result.score = score;
    std::vector<double> depths, weights;
    for (const Support& s : window) {
        const Feature& f = scene.features[s.feature];
        if (!is_depth(f.depth_m)) continue;
        depths.push_back(centre_depth_m(f, shapes.occurrence(s.occurrence)));
        weights.push_back(s.weight);
    }
    result.depth_m = weighted_median(depths, weights);
    if (by_depth) result.score *= keep_at_depth(window, scene, result.depth_m);
    double total = 0, x = 0, y = 0, scale = 0, cosine = 0, sine = 0;
    Box around{0, 0, 0, 0};
    for (const Support& s : window) {
        const Occurrence& o = shapes.occurrence(s.occurrence);
        const TrainingObject& object = shapes.objects[o.object];
        const Placement placed =
            placed_by(scene.features[s.feature], o, object, camera, by_depth ? result.depth_m : no_depth);
        const Box box = placed_box(placed, object);
        total += s.weight;
        x += s.weight * placed.centre.x;
        y += s.weight * placed.centre.y;
        scale += s.weight * placed.scale;
        cosine += s.weight * std::cos(placed.angle);
        sine += s.weight * std::sin(placed.angle);
        around.x += s.weight * box.x, around.y += s.weight * box.y;
        around.width += s.weight * box.width, around.height += s.weight * box.height;
    }
    result.centre = {x / total, y / total};
    result.scale = scale / total;
    result.angle = std::atan2(sine, cosine);
    result.box = {around.x / total, around.y / total, around.width / total, around.height / total};
    if (camera != nullptr && is_depth(result.depth_m))
        result.position_m = back_project(*camera, result.centre, result.depth_m);
    sort_by(window, [](const Support& s) { return falling(s.weight); });
    result.support = std::move(window);
    return result;
}

}  // namespace detail

/// @brief Tells from the votes of a window what the object would be: the class of the most weight, and by its
/// votes centre, scale, angle, box, depth and position. They stay as the detection's support.
/// @param window  Support::weight is the vote's weight times the kernel's
[[nodiscard]] inline Detection describe_hypothesis(double score, std::vector<Support> window,
                                                   const Scene& scene) {
    return detail::describe_votes(score, std::move(window), scene, false);
}

/// @brief The same in a space with depth. Only votes for one depth support each other, as Zhang and
/// Kjellström assume below Eq 5: those farther than Depth::bandwidth from the median do not count, and the
/// score is less by their share. Camera, depth and the sizes of training objects in metres tell the scale
/// better than features do: each vote's object is placed at the depth of the hypothesis.
[[nodiscard]] inline Detection describe_hypothesis_at_depth(double score, std::vector<Support> window,
                                                            const Scene& scene) {
    return detail::describe_votes(score, std::move(window), scene, true);
}

/// @brief The same of votes in a space with poses: in ism/detect/posed_hypothesis.hpp.
[[nodiscard]] inline Detection describe_posed_hypothesis(double score, std::vector<Support> window,
                                                         const Scene& scene);

/// @brief How hypotheses of a vote space are told.
template <VoteSpaceType Space>
[[nodiscard]] constexpr DescribeHypothesis* describe_in() {
    if constexpr (Space::needs_pose)
        return describe_posed_hypothesis;
    else
        return Space::needs_depth ? describe_hypothesis_at_depth : describe_hypothesis;
}

/// @brief The places where votes agree, strongest first over all labels, at most
/// DetectOptions::max_candidates, each told as a detection without segmentation.
/// @param votes     as cast_votes() gives them: by rising label
/// @param describe  as describe_in() gives it
template <Kernel K, std::size_t Dimension>
[[nodiscard]] std::vector<Detection> find_hypotheses(const Scene& scene,
                                                     const std::vector<Vote<Dimension>>& votes,
                                                     const Bandwidth<Dimension>& bandwidth,
                                                     const DetectOptions& options,
                                                     DescribeHypothesis* describe = describe_hypothesis) {
    const double least = std::max(options.min_relative_score, options.min_relative_votes);
    const auto labels = split_by_label(votes);
    const auto modes =
        strongest_modes<K>(labels, bandwidth, options.mean_shift, options.max_candidates, least, scene.pool);
    std::vector<Detection> hypotheses(modes.size());
    scene.pool.for_each(modes.size(), [&](std::size_t i, unsigned) {
        const auto of_label = std::lower_bound(
            labels.begin(), labels.end(), modes[i].label,
            [](const auto& part, std::uint32_t label) { return part.front().label < label; });
        std::vector<Support> window;
        for (const auto& [index, kernel] : modes[i].support) {
            const Vote<Dimension>& vote = (*of_label)[index];
            window.push_back(
                {vote.feature, vote.word, vote.occurrence, static_cast<float>(vote.weight * kernel)});
        }
        hypotheses[i] = describe(modes[i].score, std::move(window), scene);
    });
    // Described from votes of one depth, some have become weaker than their modes were.
    detail::drop_if(hypotheses, [](const Detection& hypothesis) { return hypothesis.support.empty(); });
    detail::sort_by_score(hypotheses);
    while (!hypotheses.empty() && hypotheses.back().score < least * hypotheses.front().score)
        hypotheses.pop_back();
    return hypotheses;
}

/// @brief Which votes can be of an object in a scene, by its size and the sizes of the training objects.
/// @throws Error for a model without training objects, or a largest size below the smallest.
[[nodiscard]] inline VoteLimits vote_limits(const Scene& scene, const DetectOptions& options) {
    const std::vector<TrainingObject>& objects = scene.model.shapes.objects;
    expect(!objects.empty(), "detection: training objects of the model", "1 or more", 0);
    float smallest_px = objects.front().size_px, largest_px = smallest_px;
    for (const TrainingObject& object : objects) {
        smallest_px = std::min(smallest_px, object.size_px);
        largest_px = std::max(largest_px, object.size_px);
    }
    const double min_size_px = options.min_size_px > 0 ? options.min_size_px : smallest_px / 2;
    expect(options.max_size_px == 0 || options.max_size_px >= min_size_px, "DetectOptions::max_size_px",
           lazy_text("0 or at least ", min_size_px, ", half the smallest training object"),
           options.max_size_px);
    const double width = scene.frame.gray.width(), height = scene.frame.gray.height();
    const double max_size_px = std::min(options.max_size_px > 0 ? options.max_size_px : largest_px * 2,
                                        std::max(min_size_px, std::hypot(width, height)));
    return {.width = width,
            .height = height,
            .min_scale = min_size_px / reference_size_px,
            .max_scale = max_size_px / reference_size_px,
            .min_weight = options.min_vote_weight};
}

/// @brief Casts the votes of a scene within limits.
template <VoteSpaceType Space>
[[nodiscard]] std::vector<Vote<Space::dimension>> cast_votes(const Scene& scene, MatchMode matching,
                                                             const VoteLimits& limits) {
    const Camera* const camera = scene.frame.camera ? &*scene.frame.camera : nullptr;
    if (matching == MatchMode::all)
        return cast_votes<Space>(scene.features, scene.matches, scene.model.shapes, camera, limits,
                                 scene.frames);
    return cast_votes<Space>(scene.features, nearest_only(scene.matches), scene.model.shapes, camera, limits,
                             scene.frames);
}

}  // namespace ism
