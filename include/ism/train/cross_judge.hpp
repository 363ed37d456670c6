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

#include "ism/core/geometry.hpp"
#include "ism/core/logistic.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/box_cue_reader.hpp"
#include "ism/hog/hog_pyramid.hpp"
#include "ism/hog/propose_boxes.hpp"
#include "ism/hog/search_box.hpp"
#include "ism/model/box_classifier.hpp"
#include "ism/model/box_cues.hpp"
#include "ism/model/calibration.hpp"
#include "ism/model/figure_colors.hpp"
#include "ism/model/patch_classifier.hpp"
#include "ism/train/fit_box_classifier.hpp"
#include "ism/train/fit_calibration.hpp"
#include "ism/train/linear_svm.hpp"
#include "ism/train/template_examples.hpp"
#include "ism/train/training_boxes.hpp"

/// What templates and other cues are worth together, from boxes on images that neither was fitted to.
namespace ism::detail {

/// A box that was found on an image that its judges had not seen: what speaks for it, and whether it is
/// right.
struct JudgedBox {
    std::size_t image = 0;
    std::uint32_t class_index = 0;
    Box box = {};
    BoxCues cues = {};
    bool right = false;
};

/// Whether a box is that of an object of another class.
[[nodiscard]] inline bool shows_another(const Box& box, const std::vector<ObjectLabel>& labels,
                                        std::uint32_t class_index) {
    return std::any_of(labels.begin(), labels.end(), [&](const ObjectLabel& label) {
        return label.class_index != class_index && iou(box, label.box) >= right_iou;
    });
}

/// The words in boxes of an image, in those labelled and in the strongest hypotheses.
[[nodiscard]] inline std::vector<TrainingBox> word_boxes(const TemplateImage& image, std::size_t hypotheses) {
    std::vector<TrainingBox> boxes;
    for (const ObjectLabel& label : image.labels) boxes.push_back(labelled_box(label, image.words));
    for (const ProposedBox& guess :
         std::span(image.proposals).first(std::min(hypotheses, image.proposals.size())))
        boxes.push_back(hypothesis_box(guess.class_index, guess.box, 0, image.labels, image.words));
    return boxes;
}

/// What was learnt without a fold, beside templates.
struct FoldJudges {
    BoxClassifier words = {};
    PatchClassifier patches = {};
    std::vector<FigureColors> colors = {};  ///< of each class
};

/// The mean of the judges' classifiers of patches, as of templates (TemplateFitter::mean_templates()), for
/// each class of those that know it.
[[nodiscard]] inline PatchClassifier mean_patches(std::span<const FoldJudges> judges) {
    PatchClassifier mean = judges[0].patches;
    for (std::size_t c = 0; c < mean.bias.size(); ++c) {
        const auto knows = [c](const FoldJudges& judge) { return judge.patches.knows(c); };
        const float share = 1 / float(std::count_if(judges.begin(), judges.end(), knows));
        std::fill(mean.weights[c].begin(), mean.weights[c].end(), 0.0f), mean.bias[c] = 0;
        for (const FoldJudges& judge : judges) {
            if (!knows(judge)) continue;
            add_share(share, judge.patches.weights[c], mean.weights[c]);
            mean.bias[c] += share * judge.patches.bias[c];
        }
    }
    return mean;
}

/// What judges say of the boxes of an image that they have not seen, of those that overlap the best alone.
/// What is ignored is left out, and what shows an object of another class: that it is none of this one its
/// rivals tell (yield_to_rivals()).
[[nodiscard]] inline std::vector<JudgedBox> judged_boxes(std::size_t image_index, const TemplateImage& image,
                                                         std::span<const TemplateScorer> scorers,
                                                         const FoldJudges& judges,
                                                         std::span<const ClassFigure> figures,
                                                         std::span<const TypicalSize> sizes,
                                                         const HogPyramid& pyramid, ThreadPool& pool) {
    std::vector<JudgedBox> judged;
    const BoxCueReader reader({.words = judges.words.empty() ? nullptr : &judges.words,
                               .patches = &judges.patches,
                               .figures = figures,
                               .colors = judges.colors,
                               .sizes = sizes},
                              {pyramid, image.color, image.voted, image.words});
    CellScratch scratch;
    for (std::uint32_t c = 0; c < scorers.size(); ++c) {
        if (!judges.patches.knows(c)) continue;  // the fold shows all there is of the class
        std::vector<SearchedBox> kept;
        for (const SearchedBox& box :
             propose_boxes(scorers[c], c, pyramid, image.asked[c], searched_boxes, pool)) {
            if (std::any_of(kept.begin(), kept.end(), [&](const SearchedBox& k) {
                    return is_one_object(k.box, box.box) || lies_within(box.box, k.box);
                }))
                continue;
            kept.push_back(box);
            const bool right = best_iou(box.box, image.labels, c) >= right_iou;
            if (!right && (shows_another(box.box, image.labels, c) || is_ignored(box.box, image.ignored)))
                continue;
            judged.push_back({image_index, c, box.box, reader.cues(c, box, scratch), right});
        }
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

/// Whether there are boxes of both kinds.
[[nodiscard]] inline bool tells_right_from_wrong(std::span<const JudgedBox> judged) {
    const auto right =
        std::count_if(judged.begin(), judged.end(), [](const JudgedBox& b) { return b.right; });
    return right > 0 && std::size_t(right) < judged.size();
}

/// What scores are worth by a curve of each class; a typical one where boxes tell nothing of it.
[[nodiscard]] inline Calibration calibrated(std::span<const JudgedBox> judged, const CueWeights& weights,
                                            std::size_t classes) {
    if (!tells_right_from_wrong(judged))
        return {std::vector<Calibration::Curve>(classes, typical_template_curve)};
    std::vector<std::vector<ScoredExample>> of_class;
    for (std::uint32_t c = 0; c < classes; ++c) of_class.push_back(scored(judged, weights, c));
    return calibration_of(of_class, scored(judged, weights));
}

/// What each cue is worth beside templates. Patches and words by the likelihood of calibrated scores, each in
/// its turn in eight steps up to the most that it may be worth: words no more than .1, since the codebook has
/// seen all folds, which flatters them. All others the same for any classes, as chosen on halves of four sets
/// of images among photographs of other things: training images show little but the classes, and tell
/// little of what these cues are worth elsewhere.
[[nodiscard]] inline CueWeights fit_cue_weights(std::span<const JudgedBox> judged, std::size_t classes) {
    constexpr std::pair<double CueWeights::*, double> most[] = {{&CueWeights::patches, 1.2},
                                                                {&CueWeights::words, 0.1}};
    CueWeights best{.votes = 0.3, .share = 0.25, .contrast = 1.5, .colors = 0.5, .size = 0.2};
    if (!tells_right_from_wrong(judged)) {
        best.patches = 1;  // as models of few objects learn
        return best;
    }
    double least_loss = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 3; ++round)
        for (const auto& [weight, limit] : most)
            for (int step = 0; step <= 8; ++step) {
                CueWeights weights = best;
                weights.*weight = limit * step / 8;
                const Calibration calibration = calibrated(judged, weights, classes);
                double loss = 0;
                for (const JudgedBox& box : judged) {
                    const Calibration::Curve& curve = calibration.curves[box.class_index];
                    const double odds = curve.slope * weights.margin(box.cues) + curve.offset;
                    loss += softplus(box.right ? -odds : odds);
                }
                if (loss < least_loss) least_loss = loss, best = weights;
            }
    return best;
}

}  // namespace ism::detail
