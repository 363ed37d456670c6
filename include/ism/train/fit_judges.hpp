// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/lists.hpp"
#include "ism/core/progress.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/hog/box_template.hpp"
#include "ism/hog/hog_pyramid.hpp"
#include "ism/hog/propose_boxes.hpp"
#include "ism/model/figure_colors.hpp"
#include "ism/model/model.hpp"
#include "ism/model/patch_classifier.hpp"
#include "ism/train/balanced_folds.hpp"
#include "ism/train/cross_judge.hpp"
#include "ism/train/fit_box_classifier.hpp"
#include "ism/train/fit_box_templates.hpp"
#include "ism/train/fit_patch_classifier.hpp"
#include "ism/train/fit_patch_mixture.hpp"
#include "ism/train/learn_cut_outs.hpp"
#include "ism/train/learn_figure_colors.hpp"
#include "ism/train/pyramid_workers.hpp"
#include "ism/train/template_examples.hpp"
#include "ism/train/training_boxes.hpp"

namespace ism::detail {

/// The objects of a class in an image, as far as their masks are known.
[[nodiscard]] inline std::vector<ColoredObject> colored_objects(const TemplateImage& image,
                                                                std::size_t class_index) {
    std::vector<ColoredObject> objects;
    for (std::size_t i = 0; i < image.labels.size(); ++i)
        if (image.labels[i].class_index == class_index && image.masks[i])
            objects.push_back({image.color, image.labels[i].box, image.masks[i]});
    return objects;
}

/// What is fitted to pixels, and what it says of boxes on images that it has not seen.
struct FittedJudges {
    std::vector<BoxTemplate> templates = {};
    PatchClassifier patches = {};
    std::vector<FigureColors> colors = {};
    std::vector<JudgedBox> judged = {};  ///< by judges that were fitted without the image's fold
    ImageFolds folds = {};
};

/// Fits templates and what judges their boxes to all images, and side by side to all but each fold, the
/// judges of which then judge boxes on its images. It goes over the images in a few rounds, in each of which
/// the pyramid of an image serves all who have to see it: first boxes are described, then negatives are
/// mined, for folds in one round at most, and in the round after their last the folds' judges judge.
class JudgeFitter {
public:
    /// @param model  with words, figures and typical sizes; this, and images, have to stay as long as this
    JudgeFitter(std::span<const TemplateImage> images, const Model& model, const TemplateOptions& options,
                unsigned threads)
        : images_(images),
          model_(model),
          rounds_(options.mining_rounds),
          fold_rounds_(std::min(options.mining_rounds, 1)),
          classes_(model.shapes.class_names.size()),
          fold_of_(balanced_folds(labels_of(images), classes_, folds)),
          templates_(images, fold_of_, folds, classes_, options),
          workers_(threads),
          mixture_(fit_patch_mixture(sampled_patches(images, workers_))),
          patches_(mixture_, images, classes_),
          words_(images.size()),
          object_rows_(images.size()),
          taken_rows_(fits().size(), std::vector<PatchRows>(images.size())),
          judges_(fits().size(), {.colors = std::vector<FigureColors>(classes_)}),
          judged_(images.size()) {}

    [[nodiscard]] FittedJudges fit(const Progress& progress) {
        learn_colors();
        for (int round = 0; round <= std::max(rounds_, fold_rounds_ + 1); ++round) {
            std::vector<std::size_t> going_on;
            for (std::size_t f = 0; f < fits().size(); ++f)
                if (round <= rounds_of(f)) going_on.push_back(f);
            const char* const task = round == 0         ? "describing boxes"
                                     : going_on.empty() ? "judging boxes"
                                                        : "mining negatives";
            ProgressCounter counter(progress, task, images_.size());
            workers_.for_each(images_.size(), [&](std::size_t i, HogPyramid& pyramid) {
                visit(i, round, going_on, pyramid);
                counter.step();
            });
            templates_.fit(going_on, workers_.pool());
            if (round == fold_rounds_) fit_judges_of_folds();
        }
        judges_[0].patches = fitted_patches(0);
        return result();
    }

private:
    // Judges of halves know too little: with two folds photographs without objects were told 1.2 times as
    // often as with three. Four gain no more and take a tenth longer.
    static constexpr std::size_t folds = 3;

    [[nodiscard]] static std::vector<std::vector<ObjectLabel>> labels_of(
        std::span<const TemplateImage> images) {
        std::vector<std::vector<ObjectLabel>> labels;
        for (const TemplateImage& image : images) labels.push_back(image.labels);
        return labels;
    }
    [[nodiscard]] const std::vector<TemplateFit>& fits() const { return templates_.fits(); }
    [[nodiscard]] bool sees(std::size_t f, std::size_t image) const {
        return templates_.sees(fits()[f], image);
    }
    /// Rounds of mining of a fit, of which the first is the one of all images.
    [[nodiscard]] int rounds_of(std::size_t f) const { return f == 0 ? rounds_ : fold_rounds_; }

    /// The colours of each class, by each fit.
    void learn_colors() {
        workers_.pool().for_each(fits().size() * classes_, [&](std::size_t i, unsigned) {
            const std::size_t f = i / classes_, c = i % classes_;
            std::vector<ColoredObject> seen;
            for (std::size_t k = 0; k < images_.size(); ++k)
                if (sees(f, k)) append(seen, colored_objects(images_[k], c));
            judges_[f].colors[c] = learn_figure_colors(seen);
        });
    }
    /// All that one image is looked at for in a round.
    void visit(std::size_t i, int round, std::span<const std::size_t> going_on, HogPyramid& pyramid) {
        const TemplateImage& image = images_[i];
        ThreadPool pool(1);
        pyramid.assign(image.color, finest_level(all_boxes(image)), pool);
        std::vector<std::size_t> seeing;
        for (const std::size_t f : going_on)
            if (sees(f, i)) seeing.push_back(f);
        if (round == 0) {
            templates_.describe(i, pyramid, pool);
            object_rows_[i] = patches_.objects(i, pyramid);
            words_[i] = word_boxes(
                image, std::max<std::size_t>(3, word_options_.max_hypotheses / 2 / images_.size()));
        } else {
            templates_.mine(i, seeing, round, pyramid, pool);
        }
        for (const std::size_t f : seeing)
            if (round == rounds_of(f))
                taken_rows_[f][i] =
                    patches_.others(i, fits()[f].taken[i], f == 0 ? 1 : fits().size() - 1, pyramid);
        if (round == fold_rounds_ + 1)
            for (std::size_t f = 1; f < fits().size(); ++f)
                if (!sees(f, i))
                    judged_[i] = judged_boxes(i, image, fits()[f].scorers, judges_[f], model_.figures,
                                              model_.typical_sizes, pyramid, pool);
    }
    void fit_judges_of_folds() {
        for (std::size_t f = 1; f < fits().size(); ++f) {
            if (!model_.box_classifier.empty()) judges_[f].words = fitted_words(f);
            judges_[f].patches = fitted_patches(f);
        }
    }
    [[nodiscard]] BoxClassifier fitted_words(std::size_t f) {
        std::vector<TrainingBox> boxes;
        for (std::size_t i = 0; i < images_.size(); ++i)
            if (sees(f, i)) append(boxes, words_[i]);
        return fit_box_classifier(boxes, model_.words(), classes_, word_options_, workers_.pool().size());
    }
    [[nodiscard]] PatchClassifier fitted_patches(std::size_t f) {
        std::vector<const PatchRows*> rows;
        for (std::size_t i = 0; i < images_.size(); ++i)
            if (sees(f, i)) rows.push_back(&object_rows_[i]), rows.push_back(&taken_rows_[f][i]);
        return fit_patch_classifier(rows, mixture_, classes_, workers_.pool());
    }
    [[nodiscard]] FittedJudges result() {
        FittedJudges fitted{.templates = templates_.mean_templates(),
                            .patches = mean_patches(judges_),
                            .colors = judges_[0].colors,
                            .folds = {fold_of_, std::vector<std::vector<FigureColors>>(folds)}};
        for (std::size_t f = 1; f < fits().size(); ++f)
            fitted.folds.colors_without[fits()[f].fold] = std::move(judges_[f].colors);
        for (const std::vector<JudgedBox>& boxes : judged_) append(fitted.judged, boxes);
        return fitted;
    }

    std::span<const TemplateImage> images_;
    const Model& model_;
    int rounds_, fold_rounds_;  // of mining
    std::size_t classes_;
    std::vector<std::size_t> fold_of_;  // of each image
    TemplateFitter templates_;
    PyramidWorkers workers_;
    PatchMixture mixture_;
    PatchDescriber patches_;
    BoxClassifierOptions word_options_ = {};
    std::vector<std::vector<TrainingBox>> words_;     // of each image
    std::vector<PatchRows> object_rows_;              // patches of objects, of each image
    std::vector<std::vector<PatchRows>> taken_rows_;  // … of what each fit took for objects in it
    std::vector<FoldJudges> judges_;                  // of each fit
    std::vector<std::vector<JudgedBox>> judged_;      // of each image, by the fit that does not see it
};

}  // namespace ism::detail
