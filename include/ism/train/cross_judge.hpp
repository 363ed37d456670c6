// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/progress.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/color_overlap.hpp"
#include "ism/hog/hog_pyramid.hpp"
#include "ism/hog/propose_boxes.hpp"
#include "ism/hog/search_box.hpp"
#include "ism/model/box_classifier.hpp"
#include "ism/model/box_cues.hpp"
#include "ism/model/model.hpp"
#include "ism/train/fit_box_classifier.hpp"
#include "ism/train/fit_box_templates.hpp"
#include "ism/train/fit_calibration.hpp"
#include "ism/train/fit_patch_classifier.hpp"
#include "ism/train/pyramid_workers.hpp"
#include "ism/train/training_boxes.hpp"

/// What templates and other cues are worth together, from boxes on images that neither was fitted to.
namespace ism::detail {

/// A box that was found on an image that its judges had not seen: what speaks for it, and whether it is
/// right.
struct JudgedBox {
    std::uint32_t class_index = 0;
    BoxCues cues = {};
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
/// @param pyramid  of another image, whose memory is used
[[nodiscard]] inline std::vector<JudgedBox> judged_boxes(
    const TemplateImage& image, std::span<const TemplateScorer> scorers, const BoxClassifier& words,
    const PatchClassifier& patches, std::span<const ClassFigure> figures, HogPyramid& pyramid) {
    std::vector<JudgedBox> judged;
    const FisherEncoder encoder(patches.mixture);
    CellScratch scratch;
    ThreadPool pool(1);
    pyramid.assign(image.color, finest_level(image.proposals), pool);
    for (std::uint32_t c = 0; c < scorers.size(); ++c) {
        std::vector<SearchedBox> kept;
        for (const SearchedBox& box :
             propose_boxes(scorers[c], c, pyramid, image.proposals, searched_boxes, pool)) {
            if (std::any_of(kept.begin(), kept.end(),
                            [&](const SearchedBox& k) { return overlaps(k.box, box.box); }))
                continue;
            kept.push_back(box);
            BoxCues cues{.margin = box.score,
                         .patch_margin = patches.margin(c, encoder.encode(pyramid, box.box, scratch)),
                         .vote_weight = image.voted.weight(c, box.box),
                         .color_overlap = color_overlap(image.color, box.box, figures[c])};
            if (!words.empty()) cues.word_logit = words.logit(c, image.words.histogram(box.box));
            judged.push_back({c, cues, best_iou(box.box, image.labels, c) >= 0.5});
        }
    }
    return judged;
}

/// Each half of the images judged by what was fitted to the other; empty where a half lacks a class.
[[nodiscard]] inline std::vector<JudgedBox> cross_judged(std::span<const TemplateImage> images,
                                                         const Model& model, const PatchMixture& mixture,
                                                         const TemplateOptions& options,
                                                         PyramidWorkers& workers, const Progress& progress) {
    const std::size_t classes = model.shapes.class_names.size();
    std::vector<std::size_t> seen(classes + 1, 0);
    std::vector<const TemplateImage*> halves[2];
    for (const TemplateImage& image : images)
        halves[seen[image.labels.empty() ? classes : image.labels.front().class_index]++ % 2].push_back(
            &image);
    const BoxClassifierOptions word_options;
    const std::size_t of_image = std::max<std::size_t>(3, word_options.max_hypotheses / 2 / images.size());
    std::vector<JudgedBox> judged;
    for (int half = 0; half < 2; ++half) {
        const std::vector<const TemplateImage*>& unknown = halves[half];
        std::vector<TemplateImage> known;
        for (const TemplateImage* image : halves[1 - half])
            known.push_back({image->color, image->labels, image->proposals, image->words});
        std::vector<bool> shown(classes, false);
        for (const TemplateImage& image : known)
            for (const ObjectLabel& label : image.labels) shown[label.class_index] = true;
        if (std::find(shown.begin(), shown.end(), false) != shown.end()) continue;
        const FittedTemplates fitted = fit_box_templates(known, classes, options, workers, progress);
        const PatchClassifier patches = fit_patch_classifier(known, fitted.taken, mixture, classes, workers);
        BoxClassifier words;
        if (!model.box_classifier.empty())
            words = fit_box_classifier(word_boxes(known, of_image), model.words(), classes, word_options,
                                       workers.pool().size());
        const std::vector<TemplateScorer> scorers(fitted.templates.begin(), fitted.templates.end());
        std::vector<std::vector<JudgedBox>> found(unknown.size());
        workers.for_each(unknown.size(), [&](std::size_t i, HogPyramid& pyramid) {
            found[i] = judged_boxes(*unknown[i], scorers, words, patches, model.figures, pyramid);
        });
        for (const auto& part : found) judged.insert(judged.end(), part.begin(), part.end());
    }
    return judged;
}

/// Those of all classes, or of one, scored by all cues.
[[nodiscard]] inline std::vector<ScoredExample> scored(std::span<const JudgedBox> judged,
                                                       const CueWeights& weights,
                                                       std::optional<std::uint32_t> class_index = {}) {
    std::vector<ScoredExample> examples;
    for (const JudgedBox& box : judged)
        if (!class_index || *class_index == box.class_index)
            examples.push_back({std::exp(weights.margin(box.cues)), box.right});
    return examples;
}

/// What scores are worth by a curve of each class.
[[nodiscard]] inline Calibration calibrated(std::span<const JudgedBox> judged, const CueWeights& weights,
                                            std::size_t classes) {
    std::vector<std::vector<ScoredExample>> of_class;
    for (std::uint32_t c = 0; c < classes; ++c) of_class.push_back(scored(judged, weights, c));
    return calibration_of(of_class, scored(judged, weights));
}

/// With what weights the cues tell right from wrong best together, by the likelihood of calibrated scores:
/// each in its turn in eight steps up to the most that it may be worth. Words and votes no more than .1,
/// since the codebook has seen both halves, which flatters them. Colours are expected to be worth about 1.5 ±
/// .35: training images show little but the classes, and tell little of what they are worth elsewhere.
[[nodiscard]] inline CueWeights fit_cue_weights(std::span<const JudgedBox> judged, std::size_t classes) {
    constexpr std::pair<double CueWeights::*, double> most[] = {{&CueWeights::patches, 1.2},
                                                                {&CueWeights::words, 0.1},
                                                                {&CueWeights::votes, 0.1},
                                                                {&CueWeights::colors, 3}};
    CueWeights best;
    double least_loss = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 3; ++round)
        for (const auto& [weight, limit] : most)
            for (int step = 0; step <= 8; ++step) {
                CueWeights weights = best;
                weights.*weight = limit * step / 8;
                const Calibration calibration = calibrated(judged, weights, classes);
                const double unexpected = (weights.colors - 1.5) / 0.35;
                double loss = unexpected * unexpected / 2;
                for (const JudgedBox& box : judged) {
                    const Calibration::Curve& curve = calibration.curves[box.class_index];
                    const double odds = curve.slope * weights.margin(box.cues) + curve.offset;
                    loss += std::log1p(std::exp(box.right ? -odds : odds));
                }
                if (loss < least_loss) least_loss = loss, best = weights;
            }
    return best;
}

}  // namespace ism::detail
