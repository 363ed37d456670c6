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

#include "ism/core/progress.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/hypotheses.hpp"
#include "ism/hog/propose_boxes.hpp"
#include "ism/train/fit_box_templates.hpp"
#include "ism/train/fit_calibration.hpp"
#include "ism/train/training_boxes.hpp"
#include "ism/train/training_features.hpp"

namespace ism {

namespace detail {

/// The training images with the hypotheses that their objects' own votes had no part in.
[[nodiscard]] inline std::vector<TemplateImage> template_images(const Model& model,
                                                                const TrainingFeatures& features,
                                                                unsigned threads, const Progress& progress) {
    std::vector<const TrainingView*> views;
    for (const TrainingView& view : features.views)
        if (!view.pixels.empty()) views.push_back(&view);
    std::vector<WordIndex> words;
    for (const Channel& channel : model.channels) words.emplace_back(channel.codebook);
    std::vector<TemplateImage> images(views.size());
    ProgressCounter counter(progress, "voting on training images", views.size());
    parallel_for(views.size(), threads, [&](std::size_t i) {
        const TrainingView& view = *views[i];
        const Frame blank{.gray = GrayImage(view.width, view.height)};
        ThreadPool pool(1);
        const Scene scene = training_scene(view, model, words, blank, pool);
        const DetectOptions search{.min_relative_score = 0.01,
                                   .max_candidates = 60,
                                   .max_size_px = std::hypot(view.width, view.height)};
        VoteLimits limits = vote_limits(scene, search);
        limits.without_first = view.first_object, limits.without_end = view.end_object;
        const auto votes = cast_votes<Jism>(scene, search.matching, limits);
        images[i] = {.color = view.pixels, .labels = view.labels, .proposals = {}};
        for (const Detection& guess : find_hypotheses<EpanechnikovKernel, Jism::dimension>(
                 scene, votes, default_bandwidth<Jism>(), search))
            images[i].proposals.push_back({guess.class_index, guess.box});
        counter.step();
    });
    return images;
}

}  // namespace detail

/// @brief Learns the probabilities of templates' scores: each half of the images is judged by templates that
/// were fitted to the other.
[[nodiscard]] inline Calibration calibrate_templates(std::span<const TemplateImage> images,
                                                     std::size_t classes, const TemplateOptions& options,
                                                     unsigned threads, const Progress& progress = {}) {
    std::vector<std::vector<ScoredExample>> of_class(classes);
    std::vector<ScoredExample> all;
    std::vector<std::size_t> seen(classes + 1, 0);
    std::vector<TemplateImage> halves[2];
    for (const TemplateImage& image : images)
        halves[seen[image.labels.empty() ? classes : image.labels.front().class_index]++ % 2].push_back(
            image);
    for (int half = 0; half < 2; ++half) {
        std::vector<bool> known(classes, false);
        for (const TemplateImage& image : halves[1 - half])
            for (const ObjectLabel& label : image.labels) known[label.class_index] = true;
        if (std::find(known.begin(), known.end(), false) != known.end()) continue;
        const auto templates = fit_box_templates(halves[1 - half], classes, options, threads, progress);
        std::vector<TemplateScorer> scorers(templates.begin(), templates.end());
        std::vector<std::vector<std::pair<std::uint32_t, ScoredExample>>> found(halves[half].size());
        parallel_for(halves[half].size(), threads, [&](std::size_t i) {
            const TemplateImage& image = halves[half][i];
            ThreadPool pool(1);
            const HogPyramid pyramid(image.color, finest_level(image.proposals), pool);
            for (std::uint32_t c = 0; c < classes; ++c) {
                std::vector<SearchedBox> kept;
                for (const SearchedBox& box :
                     propose_boxes(scorers[c], c, pyramid, image.proposals, 12, pool)) {
                    if (std::any_of(kept.begin(), kept.end(),
                                    [&](const SearchedBox& k) { return overlaps(k.box, box.box); }))
                        continue;
                    kept.push_back(box);
                    found[i].emplace_back(c,
                                          ScoredExample{std::exp(box.score),
                                                        detail::best_iou(box.box, image.labels, c) >= 0.5});
                }
            }
        });
        for (const auto& of_image : found)
            for (const auto& [c, example] : of_image) of_class[c].push_back(example), all.push_back(example);
    }
    return calibration_of(of_class, all);
}

/// @brief Adds to a model the template of each class and what its scores are worth, learnt from the same
/// training features, whose pixels were kept (TrainingFeatureOptions::pixels).
/// @throws Error where no pixels were kept, or an option is out of range.
[[nodiscard]] inline Model learn_templates(Model model, const TrainingFeatures& features,
                                           const TemplateOptions& options = {}, unsigned threads = 0,
                                           const Progress& progress = {}) {
    check(options);
    const auto images = detail::template_images(model, features, threads, progress);
    expect(!images.empty(), "templates: training images with pixels", "1 or more", 0);
    const std::size_t classes = model.shapes.class_names.size();
    TemplateOptions quick = options;
    quick.mining_rounds = std::min(quick.mining_rounds, 1);
    model.template_calibration = calibrate_templates(images, classes, quick, threads, progress);
    model.templates = fit_box_templates(images, classes, options, threads, progress);
    return model;
}

}  // namespace ism
