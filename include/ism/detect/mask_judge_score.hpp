// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/frame.hpp"
#include "ism/core/frame_colors.hpp"
#include "ism/core/logistic.hpp"
#include "ism/detect/detection.hpp"
#include "ism/detect/hypotheses.hpp"
#include "ism/detect/mask_candidates.hpp"
#include "ism/detect/mask_cues.hpp"
#include "ism/detect/metric.hpp"
#include "ism/detect/move_to.hpp"
#include "ism/detect/scene.hpp"
#include "ism/model/mask_judge.hpp"

namespace ism {

/// @brief Judges regions instead of hypotheses: segments of the surface and masks of the votes are candidates
/// for every class, and MaskJudge tells by votes, colour and shape which they show. For vote spaces with
/// poses and models of learn_mask_judge(); with their masks, see KeepSegmentation.
struct MaskJudgeScore {
    MaskCandidateOptions candidates = {};      ///< as the judge was learnt, see MaskJudgeOptions
    static constexpr double least_logit = -6;  ///< what is less probable is not told

    [[nodiscard]] std::vector<Detection> rescore(std::vector<Detection> hypotheses, const Scene& scene) const;
};

/// @brief Validates options.
/// @throws Error for one out of range.
inline void check(const MaskJudgeScore& options) {
    check(options.candidates.segments);
}

/// @brief The mask that a rescorer gave, as a segmentation that is sure of itself.
struct KeepSegmentation {
    [[nodiscard]] Segmentation segment(const Detection& hypothesis, const Scene&) const {
        Segmentation result = hypothesis.segmentation;
        const Mask& mask = result.mask;
        result.figure = result.ground = GrayImage(mask.width(), mask.height());
        for (std::size_t i = 0; i < mask.pixels().size(); ++i)
            (mask.pixels()[i] != 0 ? result.figure : result.ground).pixels()[i] = 1;
        return result;
    }
};

/// @brief What votes, colour and shape add to the judgement, and whom the region looks like.
[[nodiscard]] inline MaskReasons mask_reasons(const MaskJudge& judge, const MaskCues& cues,
                                              const LookDistance& look) {
    const MaskCues shares = judge.shares(cues);
    const auto sum = [&](std::size_t first, std::size_t count) {
        double total = 0;
        for (std::size_t i = first; i < first + count; ++i) total += shares[i];
        return total;
    };
    const auto object = [&](std::optional<std::uint32_t> example) -> std::optional<std::uint32_t> {
        if (!example) return {};
        return judge.examples[*example].object;
    };
    return {.votes = sum(0, vote_cue_count),
            .color = sum(vote_cue_count, 3),
            .shape = sum(vote_cue_count + 3, 3),
            .look = sum(vote_cue_count + 6, 6),
            .outline = sum(vote_cue_count + look_cue_count, outline_cue_count),
            .color_object = object(look.color_example),
            .shape_object = object(look.shape_example)};
}

/// @brief The votes of features in a region.
[[nodiscard]] inline std::vector<Support> support_in(std::span<const Support> votes, const RegionMask& region,
                                                     const Scene& scene) {
    std::vector<Support> inside;
    for (const Support& s : votes) {
        const Feature& f = scene.features[s.feature];
        if (contains(region, int(std::lround(f.x)), int(std::lround(f.y)))) inside.push_back(s);
    }
    return inside;
}

/// @brief The depth of a region, metres.
struct RegionDepth {
    double median_m, deviation_m;  ///< from the median, root of the mean square
};

/// @brief The depth of a region; none where no pixel of it has a reading.
[[nodiscard]] inline std::optional<RegionDepth> region_depth(const Surface& surface,
                                                             const RegionMask& region) {
    std::vector<float> depths;
    for (int j = 0; j < region.mask.height(); ++j)
        for (int i = 0; i < region.mask.width(); ++i)
            if (region.mask(i, j) != 0 && surface.has_point(region.x + i, region.y + j))
                depths.push_back(surface.points_m(region.x + i, region.y + j).z);
    if (depths.empty()) return {};
    const double median_m = detail::nth_smallest(depths, depths.size() / 2);
    double squares = 0;
    for (const float depth : depths) squares += (depth - median_m) * (depth - median_m);
    return RegionDepth{median_m, std::sqrt(squares / double(depths.size()))};
}

/// @brief Places a detection in the camera frame: where at least three of its votes say, else where the ray
/// through the middle of its box meets the median depth of its region, as for a training object, with the
/// deviation of these depths as what it may be off by.
[[nodiscard]] inline Detection placed(Detection detection, const RegionDepth& depth, const Scene& scene) {
    const Camera& camera = scene.surface->camera;
    if (detection.support.size() >= 3) {
        detection = with_voted_position(std::move(detection), scene);
    } else {
        detection.position_m = back_project(camera, detection.centre, depth.median_m);
        detection.depth_m = depth.median_m;
        detection.position_error_m = depth.deviation_m;
    }
    detection.size_m = std::sqrt(detection.box.area()) * depth.median_m / camera.fx;
    return detection;
}

inline std::vector<Detection> MaskJudgeScore::rescore(std::vector<Detection> hypotheses,
                                                      const Scene& scene) const {
    const MaskJudge& judge = scene.model.mask_judge;
    expect(!judge.empty(), "MaskJudgeScore: model", "one of learn_mask_judge()", "one without a judge");
    expect(scene.surface != nullptr, "MaskJudgeScore: vote space", "a space with poses", "another");
    const std::size_t classes = scene.model.shapes.class_names.size();
    detail::sort_by_score(hypotheses);
    const FrameColors colors(scene.frame);
    const RgbImage& color = colors.image();
    const std::vector<RegionMask> regions = mask_candidates(scene, hypotheses, candidates);
    std::vector<std::vector<Detection>> judged(regions.size());
    scene.pool.for_each(regions.size(), [&](std::size_t i, unsigned) {
        const MaskLook look = describe_mask(scene, color, regions[i], judge.shape_bin_m);
        const auto votes = region_votes(scene, hypotheses, regions[i]);
        const auto looks = look_distances(look, judge.examples, classes);
        const RegionOutline outline = region_outline(*scene.surface, regions[i]);
        const std::optional<RegionDepth> depth = region_depth(*scene.surface, regions[i]);
        for (std::uint32_t c = 0; c < classes; ++c) {
            const MaskCues cues = mask_cues(votes, looks, outline, c);
            const double logit = std::clamp(judge.logit(cues), -300.0, 300.0);  // its odds stay finite
            if (logit < least_logit) continue;
            Detection detection;
            detection.class_index = c;
            detection.score = std::exp(logit);
            detection.probability = logistic(logit);
            move_to(detection, box_of(regions[i]), {});
            detection.segmentation.x = regions[i].x, detection.segmentation.y = regions[i].y;
            detection.segmentation.mask = regions[i].mask;
            detection.reasons = mask_reasons(judge, cues, looks[c]);
            if (votes[c].weight > 0)
                detection.support = support_in(hypotheses[votes[c].hypothesis].support, regions[i], scene);
            judged[i].push_back(depth ? placed(std::move(detection), *depth, scene) : std::move(detection));
        }
    });
    std::vector<Detection> result;
    for (auto& part : judged)
        for (Detection& detection : part) result.push_back(std::move(detection));
    return result;
}

}  // namespace ism
