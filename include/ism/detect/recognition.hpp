// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "ism/core/lists.hpp"
#include "ism/core/stopwatch.hpp"
#include "ism/detect/detect_options.hpp"
#include "ism/detect/detection.hpp"
#include "ism/detect/hypotheses.hpp"
#include "ism/detect/move_to.hpp"
#include "ism/detect/rescore.hpp"
#include "ism/detect/scene.hpp"
#include "ism/detect/segment.hpp"
#include "ism/detect/verify.hpp"
#include "ism/vote/bandwidth.hpp"
#include "ism/vote/kernel.hpp"
#include "ism/vote/vote_space.hpp"

namespace ism {

/// @brief How objects are recognised: a row of policies, each with its options as members.
/// @tparam Space  the vote space: Ism, Jism, Ji3sm1, Ji3sm2, Ji3sm3 or one of your own
template <VoteSpaceType Space = Jism, Kernel K = EpanechnikovKernel, Rescorer R = BoxClassifierScore,
          Segmenter S = PatchSegmenter, Verifier V = Mdl>
struct Recognition {
    DetectOptions options = {};
    Bandwidth<Space::dimension> bandwidth = default_bandwidth<Space>();
    R rescorer = {};
    S segmenter = {};
    V verifier = {};
};

namespace detail {

template <class Policy>
void check_policy(const Policy& policy) {
    if constexpr (requires { check(policy); }) check(policy);
}

template <Verifier V>
[[nodiscard]] bool needs_masks(const V& verifier) {
    if constexpr (requires { verifier.needs_masks(); })
        return verifier.needs_masks();
    else
        return true;
}

/// Lets what it cut out speak for or against detections.
template <class S>
concept MaskJudging = requires(const S& segmenter, std::vector<Detection>& detections, const Scene& scene) {
    segmenter.judge(detections, scene);
    { S::most_log_odds } -> std::convertible_to<double>;
};

/// The least probability with which a detection may still reach this one once it is cut out.
template <Segmenter S>
[[nodiscard]] double least_before_masks(double probability) {
    if constexpr (MaskJudging<S>)
        return probability / (probability + std::exp(S::most_log_odds) * (1 - probability));
    else
        return probability;
}

/// What policies give, which may be anybody's, is looked at where it is clear whose it is.
inline void check_score(double score, const char* policy) {
    expect(std::isfinite(score) && score >= 0, lazy_text(policy, ": score"), "a number of 0 or more", score);
}

inline void check_rescored(const std::vector<Detection>& hypotheses, std::size_t classes) {
    for (const Detection& hypothesis : hypotheses) {
        const Box& box = hypothesis.box;
        check_score(hypothesis.score, "rescorer");
        expect(hypothesis.class_index < classes, "rescorer: class", lazy_text("below ", classes),
               hypothesis.class_index);
        expect(std::isfinite(box.x + box.y + box.width + box.height), "rescorer: box", "finite numbers",
               "others");
    }
}

/// From hypotheses on: the same code for every vote space.
template <Rescorer R, Segmenter S, Verifier V>
[[nodiscard]] Detections judge_hypotheses(Scene&& scene, std::vector<Detection> hypotheses,
                                          const DetectOptions& options, const R& rescorer, const S& segmenter,
                                          const V& verifier, DetectionStats stats) {
    Stopwatch watch;
    hypotheses = rescorer.rescore(std::move(hypotheses), scene);
    check_rescored(hypotheses, scene.model.shapes.class_names.size());
    sort_by_score(hypotheses);
    stats.candidates = hypotheses.size();
    keep_first(hypotheses, options.max_hypotheses);
    stats.rescore_ms = watch.lap_ms();
    const auto segment = [&](std::vector<Detection>& detections) {
        scene.pool.for_each(detections.size(), [&](std::size_t i, unsigned) {
            detections[i].segmentation = segmenter.segment(detections[i], scene);
            check(detections[i].segmentation);
            if (const std::optional<Box> box = detections[i].segmentation.box)
                move_to(detections[i], *box, scene.frame.camera);
        });
        if constexpr (MaskJudging<S>) {
            segmenter.judge(detections, scene);
            sort_by_score(detections);
        }
        stats.segmented = detections.size();
        stats.segment_ms = watch.lap_ms();
    };
    const bool masks_first = needs_masks(verifier);
    if (masks_first) segment(hypotheses);
    std::vector<Verified> verified = verifier.verify(hypotheses, scene);
    for (const Verified& one : verified) check_score(one.score, "verifier");
    sort_by_score(verified);
    Detections result;
    const double least =
        masks_first ? options.min_probability : least_before_masks<S>(options.min_probability);
    std::vector<bool> taken(hypotheses.size(), false);
    for (const auto& [index, score] : verified) {
        if (score < options.min_relative_score * verified.front().score) break;
        expect(index < taken.size() && !taken[index], "verifier: index of a hypothesis",
               lazy_text("one below ", taken.size(), ", each once"), index);
        taken[index] = true;
        Detection& object = hypotheses[index];
        object.score = score;
        const bool judged = !std::isnan(object.probability);
        expect(judged || !(options.min_probability > 0), "DetectOptions::min_probability",
               "0 where votes alone judge, or the model knows no probabilities", options.min_probability);
        if (!judged || object.probability >= least)
            result.objects.push_back(std::move(object));
        else
            keep_more_probable(result.next_best, std::move(object));
    }
    stats.verify_ms = watch.lap_ms();
    if (!masks_first) {
        segment(result.objects);
        if constexpr (MaskJudging<S>) {
            std::vector<Detection> cut_out;
            cut_out.swap(result.objects);
            for (Detection& object : cut_out)
                if (object.probability < options.min_probability)
                    keep_more_probable(result.next_best, std::move(object));
                else
                    result.objects.push_back(std::move(object));
        }
    }
    result.features = std::move(scene.features);
    result.stats = stats;
    return result;
}

}  // namespace detail

/// @brief Validates options and policies, and whether a frame has what the vote space needs.
/// @throws Error for an option out of range, or a space that needs depth where the frame has none.
template <VoteSpaceType Space, Kernel K, Rescorer R, Segmenter S, Verifier V>
void check(const Recognition<Space, K, R, S, V>& recognition, const Frame& frame) {
    check(recognition.options);
    check(recognition.bandwidth);
    detail::check_policy(recognition.rescorer);
    detail::check_policy(recognition.segmenter);
    detail::check_policy(recognition.verifier);
    expect(!Space::needs_depth || !frame.depth_m.empty(), "depth image",
           "one, since the vote space uses depth", "none");
}

/// @brief Recognises the objects of a scene: votes, mean shift, rescoring, segmentation, verification.
/// @throws Error as check(Recognition, Frame) does, and for a model without training objects.
template <VoteSpaceType Space, Kernel K, Rescorer R, Segmenter S, Verifier V>
[[nodiscard]] Detections recognise(Scene scene, const Recognition<Space, K, R, S, V>& recognition) {
    check(recognition, scene.frame);
    DetectionStats stats{.features = scene.features.size(),
                         .matches = scene.matches.size(),
                         .extract_ms = scene.extract_ms,
                         .match_ms = scene.match_ms};
    Stopwatch watch;
    if constexpr (Space::needs_pose) add_surface(scene);
    const DetectOptions& options = recognition.options;
    const auto votes = cast_votes<Space>(scene, options.matching, vote_limits(scene, options));
    auto hypotheses = find_hypotheses<K, Space::dimension>(scene, votes, recognition.bandwidth, options,
                                                           describe_in<Space>());
    stats.votes = votes.size();
    stats.hypotheses = hypotheses.size();
    stats.vote_ms = watch.lap_ms();
    return detail::judge_hypotheses(std::move(scene), std::move(hypotheses), options, recognition.rescorer,
                                    recognition.segmenter, recognition.verifier, stats);
}

}  // namespace ism
