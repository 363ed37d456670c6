// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/progress.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/proposals.hpp"
#include "ism/hog/propose_boxes.hpp"
#include "ism/train/fit_box_classifier.hpp"
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
        images[i] = {.color = view.pixels,
                     .labels = view.labels,
                     .proposals = {},
                     .words = WordMap(scene.features, scene.matches, model.words())};
        for (const Detection& guess :
             find_hypotheses_of_others(view, scene, proposal_options(), proposal_bandwidth<Jism>()))
            images[i].proposals.push_back({guess.class_index, guess.box});
        counter.step();
    });
    return images;
}

/// A box that was found on an image that its judges had not seen: what the template says of it, what the
/// words, and whether it is right.
struct JudgedBox {
    std::uint32_t class_index = 0;
    double margin = 0, logit = 0;
    bool right = false;
};

/// The labelled boxes and hypotheses of images, to fit a classifier of boxes to.
[[nodiscard]] inline std::vector<TrainingBox> word_boxes(std::span<const TemplateImage> images,
                                                         std::size_t of_image) {
    std::vector<TrainingBox> boxes;
    for (const TemplateImage& image : images) {
        for (const ObjectLabel& label : image.labels) boxes.push_back(labelled_box(label, image.words));
        for (const ProposedBox& guess :
             std::span(image.proposals).first(std::min(of_image, image.proposals.size())))
            boxes.push_back(hypothesis_box(guess.class_index, guess.box, 0, image.labels, image.words));
    }
    return boxes;
}

/// What judges say of the boxes of an image, of those that overlap the best alone.
[[nodiscard]] inline std::vector<JudgedBox> judged_boxes(const TemplateImage& image,
                                                         std::span<const TemplateScorer> scorers,
                                                         const BoxClassifier& words) {
    std::vector<JudgedBox> judged;
    ThreadPool pool(1);
    const HogPyramid pyramid(image.color, finest_level(image.proposals), pool);
    for (std::uint32_t c = 0; c < scorers.size(); ++c) {
        std::vector<SearchedBox> kept;
        for (const SearchedBox& box : propose_boxes(scorers[c], c, pyramid, image.proposals, 12, pool)) {
            if (std::any_of(kept.begin(), kept.end(),
                            [&](const SearchedBox& k) { return overlaps(k.box, box.box); }))
                continue;
            kept.push_back(box);
            judged.push_back({c, box.score,
                              words.empty() ? 0 : words.logit(c, image.words.histogram(box.box)),
                              best_iou(box.box, image.labels, c) >= 0.5});
        }
    }
    return judged;
}

/// Each half of the images judged by what was fitted to the other; empty where a half lacks a class.
[[nodiscard]] inline std::vector<JudgedBox> cross_judged(std::span<const TemplateImage> images,
                                                         const Model& model, const TemplateOptions& options,
                                                         unsigned threads, const Progress& progress) {
    const std::size_t classes = model.shapes.class_names.size();
    std::vector<std::size_t> seen(classes + 1, 0);
    std::vector<TemplateImage> halves[2];
    for (const TemplateImage& image : images)
        halves[seen[image.labels.empty() ? classes : image.labels.front().class_index]++ % 2].push_back(
            image);
    const BoxClassifierOptions word_options;
    const std::size_t of_image = std::max<std::size_t>(3, word_options.max_hypotheses / 2 / images.size());
    std::vector<JudgedBox> judged;
    for (int half = 0; half < 2; ++half) {
        const std::vector<TemplateImage>&known = halves[1 - half], &unknown = halves[half];
        std::vector<bool> shown(classes, false);
        for (const TemplateImage& image : known)
            for (const ObjectLabel& label : image.labels) shown[label.class_index] = true;
        if (std::find(shown.begin(), shown.end(), false) != shown.end()) continue;
        const auto templates = fit_box_templates(known, classes, options, threads, progress);
        BoxClassifier words;
        if (!model.box_classifier.empty())
            words = fit_box_classifier(word_boxes(known, of_image), model.words(), classes, word_options,
                                       threads);
        const std::vector<TemplateScorer> scorers(templates.begin(), templates.end());
        std::vector<std::vector<JudgedBox>> found(unknown.size());
        parallel_for(unknown.size(), threads,
                     [&](std::size_t i) { found[i] = judged_boxes(unknown[i], scorers, words); });
        for (const auto& part : found) judged.insert(judged.end(), part.begin(), part.end());
    }
    return judged;
}

/// How many margins one logit of the words is worth: the ratio of the weights of a logistic regression.
[[nodiscard]] inline double fit_word_weight(std::span<const JudgedBox> judged) {
    std::array<double, 3> weight{};  // of margin, logit and 1
    for (int step = 0; step < 50; ++step) {
        std::array<double, 3> slope{};
        std::array<std::array<double, 3>, 3> curvature{};
        for (std::size_t k = 0; k < 3; ++k) slope[k] = 1e-3 * weight[k], curvature[k][k] = 1e-3;
        for (const JudgedBox& box : judged) {
            const std::array<double, 3> x{box.margin, box.logit, 1};
            const double p = 1 / (1 + std::exp(-(weight[0] * x[0] + weight[1] * x[1] + weight[2])));
            for (std::size_t k = 0; k < 3; ++k) {
                slope[k] += (p - double(box.right)) * x[k];
                for (std::size_t l = 0; l < 3; ++l) curvature[k][l] += p * (1 - p) * x[k] * x[l];
            }
        }
        for (std::size_t k = 0; k < 3; ++k)  // Gauss's elimination; the matrix is positive definite
            for (std::size_t row = k + 1; row < 3; ++row) {
                const double factor = curvature[row][k] / curvature[k][k];
                for (std::size_t l = k; l < 3; ++l) curvature[row][l] -= factor * curvature[k][l];
                slope[row] -= factor * slope[k];
            }
        for (std::size_t k = 3; k-- > 0;) {
            for (std::size_t l = k + 1; l < 3; ++l) slope[k] -= curvature[k][l] * slope[l];
            slope[k] /= curvature[k][k];
            weight[k] -= slope[k];
        }
    }
    return weight[0] > 0 ? std::clamp(weight[1] / weight[0], 0.0, 1.0) : 0;
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
    const auto judged = detail::cross_judged(images, model, quick, threads, progress);
    model.word_weight = detail::fit_word_weight(judged);
    std::vector<std::vector<ScoredExample>> of_class(classes);
    std::vector<ScoredExample> all;
    for (const detail::JudgedBox& box : judged) {
        all.push_back({std::exp(box.margin + model.word_weight * box.logit), box.right});
        of_class[box.class_index].push_back(all.back());
    }
    model.template_calibration = calibration_of(of_class, all);
    model.templates = fit_box_templates(images, classes, options, threads, progress);
    return model;
}

}  // namespace ism
