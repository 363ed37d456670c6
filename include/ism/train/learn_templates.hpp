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

#include "ism/core/error.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/order.hpp"
#include "ism/core/progress.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/asked_proposals.hpp"
#include "ism/detect/proposals.hpp"
#include "ism/model/box_cues.hpp"
#include "ism/train/cross_judge.hpp"
#include "ism/train/describe_object.hpp"
#include "ism/train/fit_judges.hpp"
#include "ism/train/learn_cut_outs.hpp"
#include "ism/train/mean_figures.hpp"
#include "ism/train/training_features.hpp"

namespace ism {

namespace detail {

/// The masks of the objects of a training image; none of those that were labelled without one.
[[nodiscard]] inline std::vector<const Mask*> own_masks(const TrainingView& view,
                                                        std::span<const TrainingObject> objects) {
    std::vector<const Mask*> masks;
    for (std::size_t i = 0; i < view.labels.size(); ++i) {
        const TrainingObject& object = objects[view.first_object + i];
        const bool known = has_mask(object, view.labels[i], view.width, view.height);
        masks.push_back(known ? &object.mask : nullptr);
    }
    return masks;
}

/// How large the objects of each class are.
[[nodiscard]] inline std::vector<TypicalSize> typical_sizes(std::span<const TemplateImage> images,
                                                            std::size_t classes) {
    std::vector<TypicalSize> sizes;
    for (std::uint32_t c = 0; c < classes; ++c) {
        std::vector<float> log_px, log_parts;
        for (const TemplateImage& image : images)
            for (const ObjectLabel& label : image.labels)
                if (label.class_index == c) {
                    const double area = label.box.area();
                    const double picture = double(image.color.width()) * double(image.color.height());
                    log_px.push_back(float(std::log(area)));
                    log_parts.push_back(float(std::log(area / picture)));
                }
        if (log_px.empty()) return {};  // TemplateFitter refuses it
        const std::size_t middle = log_px.size() / 2;
        sizes.push_back({nth_smallest(log_px, middle), nth_smallest(log_parts, middle)});
    }
    return sizes;
}

/// The images that a class does not learn from: of those that do not show it all but an even choice.
[[nodiscard]] inline std::vector<bool> left_out_images(std::span<const TrainingView* const> views,
                                                       std::uint32_t class_index, std::size_t classes) {
    std::vector<bool> left_out(views.size(), false);
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < views.size(); ++i)
        if (!shows(views[i]->labels, class_index)) others.push_back(i), left_out[i] = true;
    const std::size_t count = std::min(max_other_images(classes), others.size());
    for (std::size_t k = 0; k < count; ++k) left_out[others[k * others.size() / count]] = false;
    return left_out;
}

/// The training images whose pixels were kept.
[[nodiscard]] inline std::vector<const TrainingView*> views_with_pixels(const TrainingFeatures& features) {
    std::vector<const TrainingView*> views;
    for (const TrainingView& view : features.views)
        if (!view.pixels.empty()) views.push_back(&view);
    return views;
}

/// Votes of an image that are kept for judges, at most: 12 MB. A photograph of 10 megapixels has millions.
inline constexpr std::size_t most_kept_votes = 500000;

/// The training images with the hypotheses that their objects' own votes had no part in.
[[nodiscard]] inline std::vector<TemplateImage> template_images(const Model& model,
                                                                const TrainingFeatures& features,
                                                                unsigned threads, const Progress& progress) {
    const std::vector<const TrainingView*> views = views_with_pixels(features);
    const WordIndices words = word_indices(model);
    const std::size_t classes = model.shapes.class_names.size();
    std::vector<std::vector<bool>> left_out;  // by each class
    for (std::uint32_t c = 0; c < classes; ++c) left_out.push_back(left_out_images(views, c, classes));
    std::vector<TemplateImage> images(views.size());
    ProgressCounter counter(progress, "voting on training images", views.size());
    parallel_for(views.size(), threads, [&](std::size_t i) {
        const TrainingView& view = *views[i];
        const Frame blank{.gray = GrayImage(view.width, view.height)};
        ThreadPool pool(1);
        const Scene scene = training_scene(view, model, words, blank, pool);
        images[i] = {.color = view.pixels,
                     .labels = view.labels,
                     .ignored = view.ignored,
                     .masks = own_masks(view, model.shapes.objects),
                     .words = WordMap(scene.features, scene.matches, model.words())};
        const DetectOptions search = strongest_proposal_options();
        const auto votes = votes_of_others<Jism>(view, scene, search);
        for (const Detection& guess : find_hypotheses<EpanechnikovKernel, Jism::dimension>(
                 scene, votes, proposal_bandwidth<Jism>(), search))
            if (shows_any(guess.box, view.labels) || !is_ignored(guess.box, view.ignored))
                images[i].proposals.push_back({guess.class_index, guess.box});
        images[i].asked = asked_proposals(images[i].proposals, votes, asked_classes, model.shapes);
        images[i].voted = VotedBoxes(votes, scene.features, model.shapes);
        const std::size_t step =
            std::max<std::size_t>(1, (votes.size() + most_kept_votes - 1) / most_kept_votes);
        for (std::uint32_t c = 0; c < classes; ++c) {
            if (left_out[c][i]) images[i].asked[c] = {};
            if (const std::size_t own = left_out[c][i] ? 64 * step : step; own > 1)
                images[i].voted.thin(c, own);
        }
        counter.step();
    });
    return images;
}

}  // namespace detail

/// @brief Adds to a model the template of each class and what its scores are worth, learnt from the same
/// training features, whose pixels were kept (TrainingFeatureOptions::pixels). Where the model has exemplars
/// (learn_exemplars()), also what masks of each class are like (weigh_masks()) and how boxes are placed by
/// them (Placing).
/// @throws Error where the model is of other objects, no pixels were kept, or an option is out of range.
[[nodiscard]] inline Model learn_templates(Model model, const TrainingFeatures& features,
                                           const TemplateOptions& options = {}, unsigned threads = 0,
                                           const Progress& progress = {}) {
    check(options);
    detail::expect_same_objects(model, features, "templates");
    const auto images = detail::template_images(model, features, threads, progress);
    expect(!images.empty(), "templates: training images with pixels", "1 or more", 0);
    const std::size_t classes = model.shapes.class_names.size();
    model.figures = mean_figures(model.shapes);
    model.typical_sizes = detail::typical_sizes(images, classes);
    detail::FittedJudges fitted = detail::JudgeFitter(images, model, options, threads).fit(progress);
    model.cue_weights = detail::fit_cue_weights(fitted.judged, classes);
    model.template_calibration = detail::calibrated(fitted.judged, model.cue_weights, classes);
    model.templates = std::move(fitted.templates);
    model.patch_classifier = std::move(fitted.patches);
    model.figure_colors = std::move(fitted.colors);
    if (std::all_of(model.figure_colors.begin(), model.figure_colors.end(),
                    [](auto& c) { return c.empty(); }))
        model.figure_colors.clear();
    if (!model.exemplars.empty()) {
        detail::CutOuts learnt = detail::learn_cut_outs(model, detail::views_with_pixels(features),
                                                        fitted.judged, fitted.folds, threads);
        model.typical_masks = std::move(learnt.typical_masks), model.placings = std::move(learnt.placings);
    }
    return model;
}

}  // namespace ism
