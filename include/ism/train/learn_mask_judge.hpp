// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ism/codebook/match_nearest.hpp"
#include "ism/codebook/word_index.hpp"
#include "ism/core/error.hpp"
#include "ism/core/logistic.hpp"
#include "ism/core/progress.hpp"
#include "ism/core/region_mask.hpp"
#include "ism/core/solve_positive_definite.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/hypotheses.hpp"
#include "ism/detect/mask_candidates.hpp"
#include "ism/detect/mask_cues.hpp"
#include "ism/detect/mask_judge_score.hpp"
#include "ism/detect/metric_proposals.hpp"
#include "ism/model/mask_judge.hpp"
#include "ism/model/model.hpp"
#include "ism/train/depth_views.hpp"
#include "ism/train/training_features.hpp"

namespace ism {

/// @brief How the judge of masks is learnt.
struct MaskJudgeOptions {
    MaskCandidateOptions candidates = {};
    double same_iou = 0.5;    ///< a region whose mask and box overlap an object so far shows it
    double other_iou = 0.35;  ///< one whose mask or box overlaps every object less is background
    double cost = 0.1;        ///< of an error against the squared weights
};

/// @brief Validates options.
/// @throws Error for one out of range.
inline void check(const MaskJudgeOptions& options) {
    check(options.candidates.segments);
    expect(options.same_iou > 0 && options.same_iou <= 1, "MaskJudgeOptions::same_iou", "above 0, at most 1",
           options.same_iou);
    expect(options.other_iou >= 0 && options.other_iou <= options.same_iou, "MaskJudgeOptions::other_iou",
           "0 ... same_iou", options.other_iou);
    expect(options.cost > 0 && options.cost <= 1e6, "MaskJudgeOptions::cost", "above 0, at most 1e6",
           options.cost);
}

namespace detail {

/// A region of a training image: what it looks like, what votes say of it, what it is.
struct JudgedRegion {
    MaskExample example;
    std::vector<RegionVotes> votes;
    RegionOutline outline;
};

/// What a region shows by its overlap with the labelled masks; nothing where that is not clear.
[[nodiscard]] inline std::optional<std::uint32_t> shown_object(const RegionMask& region,
                                                               std::span<const RegionMask> masks,
                                                               std::span<const ObjectLabel> labels,
                                                               const MaskJudgeOptions& options) {
    std::uint32_t best = MaskExample::background;
    double mask_iou = 0, box_iou = 0;
    for (std::uint32_t i = 0; i < masks.size(); ++i)
        if (const double overlap = iou(region, masks[i]);
            best == MaskExample::background || overlap > mask_iou)
            best = i, mask_iou = overlap, box_iou = iou(box_of(region), labels[i].box);
    if (best == MaskExample::background) return best;
    if (mask_iou >= options.same_iou && box_iou >= options.same_iou) return best;
    if (mask_iou < options.other_iou || box_iou < options.other_iou) return MaskExample::background;
    return {};
}

/// The regions of a training image: the masks of its objects and what would be candidates in it.
[[nodiscard]] inline std::vector<JudgedRegion> judged_regions(const TrainingView& view, const Model& model,
                                                              const WordIndex& words, WordRange own_words,
                                                              double shape_bin_m,
                                                              const MaskJudgeOptions& options) {
    ThreadPool pool(1);
    const TrainingDepth& depth = *view.depth;
    const Frame frame{.gray = GrayImage(view.width, view.height),
                      .color = view.pixels,
                      .depth_m = depth.depth_m,
                      .camera = depth.camera};
    Scene scene{.frame = frame, .model = model, .pool = pool};
    scene.features = view.channels[0].features;
    scene.matches =
        match_nearest(words, view.channels[0].descriptors, model.channels[0].neighbours, pool, own_words);
    add_surface(scene);
    const DetectOptions search = metric_proposal_options();
    const auto votes = cast_votes<Metric>(scene, search.matching, vote_limits(scene, search));
    const auto hypotheses = find_hypotheses<EpanechnikovKernel, Metric::dimension>(
        scene, votes, default_bandwidth<Metric>(), search, describe_posed_hypothesis);
    std::vector<RegionMask> regions = depth.masks;
    const std::size_t labelled = regions.size();
    for (RegionMask& candidate : mask_candidates(scene, hypotheses, options.candidates))
        regions.push_back(std::move(candidate));
    std::vector<JudgedRegion> judged;
    for (std::uint32_t r = 0; r < regions.size(); ++r) {
        const RegionMask& region = regions[r];
        const auto shown =
            r < labelled ? std::optional(r) : shown_object(region, depth.masks, view.labels, options);
        if (!shown || region.mask.empty()) continue;
        if (*shown == MaskExample::background && is_ignored(box_of(region), view.ignored)) continue;
        JudgedRegion one{.example = {.look = describe_mask(scene, view.pixels, region, shape_bin_m)},
                         .votes = region_votes(scene, hypotheses, region),
                         .outline = region_outline(*scene.surface, region)};
        if (*shown != MaskExample::background) {
            one.example.class_index = view.labels[*shown].class_index;
            one.example.object = view.first_object + *shown;
        }
        judged.push_back(std::move(one));
    }
    return judged;
}

/// The cues of regions for every class, and where they show it.
struct CueTable {
    std::vector<MaskCues> cues = {};
    std::vector<std::uint8_t> right = {};

    /// Regions compared with all examples but begin … end − 1. A class that only these show is left out where
    /// it is the one shown: nobody could know it.
    void add(const std::vector<JudgedRegion>& regions, const std::vector<MaskExample>& examples,
             std::size_t begin, std::size_t end) {
        for (const JudgedRegion& region : regions) {
            const std::size_t classes = region.votes.size();
            const auto looks = look_distances(region.example.look, examples, classes, begin, end);
            for (std::size_t c = 0; c < classes; ++c) {
                const bool shown = region.example.class_index == c;
                if (shown && !looks[c].shape_example) continue;
                cues.push_back(mask_cues(region.votes, looks, region.outline, c));
                right.push_back(shown);
            }
        }
    }
    void append(const CueTable& more) {
        cues.insert(cues.end(), more.cues.begin(), more.cues.end());
        right.insert(right.end(), more.right.begin(), more.right.end());
    }
};

/// Weights and bias of a logistic regression over cues of mean 0 and deviation 1 (Newton's method).
/// @param cost  of the errors against half of the squared weights
inline void fit_mask_weights(MaskJudge& judge, std::span<const MaskCues> cues,
                             std::span<const std::uint8_t> right, double cost) {
    constexpr std::size_t n = mask_cue_count + 1;
    for (std::size_t k = 0; k < mask_cue_count; ++k) {
        double sum = 0, squares = 0;
        for (const MaskCues& c : cues) sum += c[k], squares += double(c[k]) * c[k];
        const double mean = sum / double(cues.size());
        judge.mean[k] = static_cast<float>(mean);
        judge.deviation[k] =
            static_cast<float>(std::sqrt(std::max(1e-12, squares / double(cues.size()) - mean * mean)));
    }
    std::array<double, n> w{};
    for (int step = 0; step < 30; ++step) {
        std::array<double, n> gradient{};
        std::array<std::array<double, n>, n> hessian{};
        for (std::size_t k = 0; k < mask_cue_count; ++k) gradient[k] = w[k], hessian[k][k] = 1;
        hessian[n - 1][n - 1] = 1e-9;
        for (std::size_t i = 0; i < cues.size(); ++i) {
            std::array<double, n> x;
            double z = 0;
            for (std::size_t k = 0; k < n; ++k) {
                x[k] = k + 1 < n ? (double(cues[i][k]) - judge.mean[k]) / judge.deviation[k] : 1;
                z += w[k] * x[k];
            }
            const double p = logistic(z), error = cost * (p - right[i]), weight = cost * p * (1 - p);
            for (std::size_t a = 0; a < n; ++a) {
                gradient[a] += error * x[a];
                for (std::size_t b = 0; b <= a; ++b) hessian[a][b] += weight * x[a] * x[b];
            }
        }
        const std::array<double, n> change = solve_positive_definite(hessian, gradient);
        double length = 0;
        for (std::size_t k = 0; k < n; ++k) w[k] -= change[k], length += change[k] * change[k];
        if (length < 1e-12) break;
    }
    for (std::size_t k = 0; k < mask_cue_count; ++k) judge.weights[k] = static_cast<float>(w[k]);
    judge.bias = static_cast<float>(w[n - 1]);
}

}  // namespace detail

/// @brief Adds to a model of learn_metric() the judge of masks, from the same training features, whose pixels
/// and depth were kept: regions of each training image are compared with those of all others and with votes
/// that its own features have no part in, nor those of images of the same things (depth_views()).
/// @throws Error for an option out of range, a model of other features, an image with depth without pixels,
/// and where nothing is learnt: no image has depth and camera, or none shows a class of another.
[[nodiscard]] inline Model learn_mask_judge(Model model, const TrainingFeatures& features,
                                            const MaskJudgeOptions& options = {}, unsigned threads = 0,
                                            const Progress& progress = {}) {
    check(options);
    const DepthViews known = depth_views(features);
    const std::vector<const TrainingView*>& views = known.views;
    std::vector<std::uint32_t> first_word{0};  // of each view
    for (const TrainingView* view : views) {
        expect(!view->pixels.empty(), "judge of masks: colours of training images", "kept", "none");
        first_word.push_back(first_word.back() +
                             static_cast<std::uint32_t>(view->channels[0].features.size()));
    }
    detail::expect_same_objects(model, features, "judge of masks");
    expect(model.channels.size() == 1 && model.channels[0].codebook.size() == first_word.back(),
           "judge of masks: words of the model", lazy_text("each feature one: ", first_word.back()),
           model.words());
    MaskJudge judge;
    const WordIndex words(model.channels[0].codebook);
    // As the image is seen without itself, and, where others show the same things, without these too: what is
    // to be judged may be known or not.
    const auto is_grouped = [&](std::size_t v) { return known.group_end[v] - known.group_first[v] > 1; };
    std::vector<std::vector<detail::JudgedRegion>> regions(views.size()), regions_alone(views.size());
    ProgressCounter counter(progress, "judging regions of training images", views.size());
    parallel_for(views.size(), threads, [&](std::size_t v) {
        const auto judged = [&](std::size_t begin, std::size_t end) {
            return detail::judged_regions(*views[v], model, words, {first_word[begin], first_word[end]},
                                          judge.shape_bin_m, options);
        };
        regions[v] = judged(v, v + 1);
        if (is_grouped(v)) regions_alone[v] = judged(known.group_first[v], known.group_end[v]);
        counter.step();
    });
    std::vector<std::size_t> first{0};  // example of each view
    for (const auto& of_view : regions) {
        for (const detail::JudgedRegion& region : of_view) judge.examples.push_back(region.example);
        first.push_back(judge.examples.size());
    }
    expect(!judge.examples.empty(), "judge of masks: regions in images with depth", "1 or more", 0);
    std::vector<detail::CueTable> tables(views.size());
    parallel_for(views.size(), threads, [&](std::size_t v) {
        tables[v].add(regions[v], judge.examples, first[v], first[v + 1]);
        if (is_grouped(v))
            tables[v].add(regions_alone[v], judge.examples, first[known.group_first[v]],
                          first[known.group_end[v]]);
    });
    detail::CueTable all;
    for (const detail::CueTable& table : tables) all.append(table);
    expect(!all.cues.empty(), "judge of masks: regions to compare with those of other images", "1 or more",
           "none: no other image shows the same class");
    detail::fit_mask_weights(judge, all.cues, all.right, options.cost);
    model.mask_judge = std::move(judge);
    return model;
}

}  // namespace ism
