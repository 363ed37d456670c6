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
#include <vector>

#include "ism/core/progress.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/hog/hog_pyramid.hpp"
#include "ism/hog/propose_boxes.hpp"
#include "ism/hog/search_box.hpp"
#include "ism/model/box_classifier.hpp"
#include "ism/model/model.hpp"
#include "ism/train/fit_box_classifier.hpp"
#include "ism/train/fit_box_templates.hpp"
#include "ism/train/fit_calibration.hpp"
#include "ism/train/training_boxes.hpp"

/// What templates and words are worth together, from boxes on images that neither was fitted to.
namespace ism::detail {

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
        for (const SearchedBox& box :
             propose_boxes(scorers[c], c, pyramid, image.proposals, searched_boxes, pool)) {
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

/// Those of all classes, or of one, scored by templates and words at a weight.
[[nodiscard]] inline std::vector<ScoredExample> scored(std::span<const JudgedBox> judged, double word_weight,
                                                       std::optional<std::uint32_t> class_index = {}) {
    std::vector<ScoredExample> examples;
    for (const JudgedBox& box : judged)
        if (!class_index || *class_index == box.class_index)
            examples.push_back({std::exp(box.margin + word_weight * box.logit), box.right});
    return examples;
}

/// How many margins one logit of the words is worth: with what weight, in steps of .025 up to .2, their sum
/// tells right from wrong best, by the likelihood of a logistic curve. No more than .2, since the codebook
/// has seen both halves, which flatters words.
[[nodiscard]] inline double fit_word_weight(std::span<const JudgedBox> judged) {
    double best = 0, least_loss = std::numeric_limits<double>::infinity();
    for (int step = 0; step <= 8; ++step) {
        const double weight = 0.025 * step;
        const std::vector<ScoredExample> examples = scored(judged, weight);
        const Calibration::Curve curve = fit_curve(examples);
        double loss = 0;
        for (const ScoredExample& e : examples) {
            const double odds = curve.slope * std::log(e.score) + curve.offset;
            loss += std::log1p(std::exp(e.positive ? -odds : odds));
        }
        if (loss < least_loss) least_loss = loss, best = weight;
    }
    return best;
}

}  // namespace ism::detail
