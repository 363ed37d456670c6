// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/progress.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/proposals.hpp"
#include "ism/train/cross_judge.hpp"
#include "ism/train/fit_box_templates.hpp"
#include "ism/train/fit_calibration.hpp"
#include "ism/train/fit_patch_classifier.hpp"
#include "ism/train/fit_patch_mixture.hpp"
#include "ism/train/mean_figures.hpp"
#include "ism/train/pyramid_workers.hpp"
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
        images[i] = {.color = view.pixels,
                     .labels = view.labels,
                     .proposals = {},
                     .words = WordMap(scene.features, scene.matches, model.words())};
        const DetectOptions search = proposal_options();
        const auto votes = votes_of_others(view, scene, search);
        for (const Detection& guess : find_hypotheses<EpanechnikovKernel, Jism::dimension>(
                 scene, votes, proposal_bandwidth<Jism>(), search))
            images[i].proposals.push_back({guess.class_index, guess.box});
        images[i].voted = VotedBoxes(votes, scene.features, model.shapes);
        counter.step();
    });
    return images;
}

}  // namespace detail

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
    model.figures = mean_figures(model.shapes);
    PyramidWorkers workers(threads);
    const PatchMixture mixture = fit_patch_mixture(detail::sampled_patches(images, workers));
    const auto judged = detail::cross_judged(images, model, mixture, quick, workers, progress);
    model.cue_weights = detail::fit_cue_weights(judged, classes);
    model.template_calibration = detail::calibrated(judged, model.cue_weights, classes);
    FittedTemplates fitted = fit_box_templates(images, classes, options, workers, progress);
    model.templates = std::move(fitted.templates);
    model.patch_classifier = fit_patch_classifier(images, fitted.taken, mixture, classes, workers);
    return model;
}

}  // namespace ism
