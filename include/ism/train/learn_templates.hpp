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
#include "ism/model/figure_colors.hpp"
#include "ism/train/balanced_folds.hpp"
#include "ism/train/cross_judge.hpp"
#include "ism/train/describe_object.hpp"
#include "ism/train/fit_box_classifier.hpp"
#include "ism/train/fit_box_templates.hpp"
#include "ism/train/fit_calibration.hpp"
#include "ism/train/fit_patch_classifier.hpp"
#include "ism/train/fit_patch_mixture.hpp"
#include "ism/train/learn_cut_outs.hpp"
#include "ism/train/learn_figure_colors.hpp"
#include "ism/train/mean_figures.hpp"
#include "ism/train/pyramid_workers.hpp"
#include "ism/train/training_boxes.hpp"
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

/// The objects of a class in an image, as far as their masks are known.
[[nodiscard]] inline std::vector<ColoredObject> colored_objects(const TemplateImage& image,
                                                                std::size_t class_index) {
    std::vector<ColoredObject> objects;
    for (std::size_t i = 0; i < image.labels.size(); ++i)
        if (image.labels[i].class_index == class_index && image.masks[i])
            objects.push_back({image.color, image.labels[i].box, image.masks[i]});
    return objects;
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
        for (std::uint32_t c = 0; c < classes; ++c)
            if (left_out[c][i]) images[i].asked[c] = {}, images[i].voted.thin(c);
        counter.step();
    });
    return images;
}

/// What is fitted to pixels, and what it says of boxes on images that it has not seen.
struct FittedJudges {
    std::vector<BoxTemplate> templates = {};
    PatchClassifier patches = {};
    std::vector<FigureColors> colors = {};
    std::vector<JudgedBox> judged = {};  ///< by judges that were fitted without the image's fold
    ImageFolds folds = {};
};

/// Fits templates and what judges their boxes to all images, and side by side to all but each fold: in a few
/// rounds over the images, in each of which the pyramid of an image serves all who have to see it.
[[nodiscard]] inline FittedJudges fit_judges(std::span<const TemplateImage> images, const Model& model,
                                             const TemplateOptions& options, unsigned threads,
                                             const Progress& progress) {
    // Judges of halves know too little: with two folds photographs without objects were told 1.2 times as
    // often as with three. Four gain no more and take a tenth longer.
    constexpr std::size_t folds = 3;
    const std::size_t classes = model.shapes.class_names.size();
    std::vector<std::vector<ObjectLabel>> labels;
    for (const TemplateImage& image : images) labels.push_back(image.labels);
    const std::vector<std::size_t> fold_of = balanced_folds(labels, classes, folds);
    TemplateFitter fitter(images, fold_of, folds, classes, options);
    const std::vector<TemplateFit>& fits = fitter.fits();
    PyramidWorkers workers(threads);
    const PatchMixture mixture = fit_patch_mixture(sampled_patches(images, workers));
    const PatchDescriber describer(mixture, images, classes);

    const BoxClassifierOptions word_options;
    const std::size_t boxes_per_image =
        std::max<std::size_t>(3, word_options.max_hypotheses / 2 / images.size());
    std::vector<std::vector<TrainingBox>> words(images.size());
    const auto words_without = [&](std::size_t f) {
        std::vector<TrainingBox> boxes;
        for (std::size_t i = 0; i < images.size(); ++i)
            if (fitter.sees(fits[f], i)) append(boxes, words[i]);
        return fit_box_classifier(boxes, model.words(), classes, word_options, workers.pool().size());
    };
    std::vector<PatchRows> objects(images.size());
    std::vector<std::vector<PatchRows>> taken(fits.size(), std::vector<PatchRows>(images.size()));
    const auto patches_without = [&](std::size_t f) {
        std::vector<const PatchRows*> rows;
        for (std::size_t i = 0; i < images.size(); ++i)
            if (fitter.sees(fits[f], i)) rows.push_back(&objects[i]), rows.push_back(&taken[f][i]);
        return fit_patch_classifier(rows, mixture, classes, workers.pool());
    };
    std::vector<FoldJudges> judges(fits.size(), {.colors = std::vector<FigureColors>(classes)});
    workers.pool().for_each(fits.size() * classes, [&](std::size_t i, unsigned) {
        const TemplateFit& fit = fits[i / classes];
        const std::size_t c = i % classes;
        std::vector<ColoredObject> seen;
        for (std::size_t k = 0; k < images.size(); ++k)
            if (fitter.sees(fit, k)) append(seen, colored_objects(images[k], c));
        judges[i / classes].colors[c] = learn_figure_colors(seen);
    });
    std::vector<std::vector<JudgedBox>> judged(images.size());

    const int rounds = options.mining_rounds, fold_rounds = std::min(rounds, 1);
    for (int round = 0; round <= std::max(rounds, fold_rounds + 1); ++round) {
        std::vector<std::size_t> going_on;
        for (std::size_t f = 0; f < fits.size(); ++f)
            if (round <= (f == 0 ? rounds : fold_rounds)) going_on.push_back(f);
        ProgressCounter counter(progress,
                                round == 0         ? "describing boxes"
                                : going_on.empty() ? "judging boxes"
                                                   : "mining negatives",
                                images.size());
        workers.for_each(images.size(), [&](std::size_t i, HogPyramid& pyramid) {
            ThreadPool pool(1);
            pyramid.assign(images[i].color, finest_level(all_boxes(images[i])), pool);
            std::vector<std::size_t> seeing = going_on;
            std::erase_if(seeing, [&](std::size_t f) { return !fitter.sees(fits[f], i); });
            if (round > 0) {
                fitter.mine(i, seeing, round, pyramid, pool);
            } else {
                fitter.describe(i, pyramid, pool);
                objects[i] = describer.objects(i, pyramid);
                words[i] = word_boxes(images[i], boxes_per_image);
            }
            for (const std::size_t f : seeing)
                if (round == (f == 0 ? rounds : fold_rounds))
                    taken[f][i] =
                        describer.others(i, fits[f].taken[i], f == 0 ? 1 : fits.size() - 1, pyramid);
            for (std::size_t f = 1; f < fits.size() && round == fold_rounds + 1; ++f)
                if (!fitter.sees(fits[f], i))
                    judged[i] = judged_boxes(i, images[i], fits[f].scorers, judges[f], model.figures,
                                             model.typical_sizes, pyramid, pool);
            counter.step();
        });
        fitter.fit(going_on, workers.pool());
        for (std::size_t f = 1; f < fits.size() && round == fold_rounds; ++f) {
            if (!model.box_classifier.empty()) judges[f].words = words_without(f);
            judges[f].patches = patches_without(f);
        }
    }
    judges[0].patches = patches_without(0);
    FittedJudges fitted{
        .templates = fitter.mean_templates(), .patches = mean_patches(judges), .colors = judges[0].colors};
    fitted.folds = {fold_of, std::vector<std::vector<FigureColors>>(folds)};
    for (std::size_t f = 1; f < fits.size(); ++f)
        fitted.folds.colors_without[fits[f].fold] = std::move(judges[f].colors);
    for (const std::vector<JudgedBox>& boxes : judged) append(fitted.judged, boxes);
    return fitted;
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
    detail::FittedJudges fitted = detail::fit_judges(images, model, options, threads, progress);
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
