// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ism/evaluate/confusion.hpp"
#include "ism/evaluate/matching.hpp"
#include "ism/evaluate/precision_recall.hpp"

namespace ism {

/// @brief The figures of one class or their mean, all 0 … 1; NaN where there is nothing to measure.
struct Figures {
    double ap = std::numeric_limits<double>::quiet_NaN();   ///< average precision
    double eer = std::numeric_limits<double>::quiet_NaN();  ///< precision_at_equal_recall(): larger is better
    double best_f1 = std::numeric_limits<double>::quiet_NaN();   ///< best F1 along the curve
    double mask_iou = std::numeric_limits<double>::quiet_NaN();  ///< mean over the objects found, every score
};

/// @brief The evaluation of one class.
struct ClassEvaluation {
    std::string name;
    std::size_t objects = 0;         ///< to find
    std::size_t detections = 0;      ///< counted, ignored ones left out
    std::size_t true_positives = 0;  ///< of these
    std::size_t masks = 0;  ///< true positives whose masks were compared: mask_iou is the mean of these
    Figures figures;
    double best_f1_score = std::numeric_limits<double>::quiet_NaN();  ///< the cut of the best F1
    PrecisionRecall curve;
};

/// @brief The evaluation of all classes.
struct Evaluation {
    std::vector<ClassEvaluation> classes;  ///< in the order of the class names
    Figures mean;                          ///< over classes with objects (mask_iou: with any measured)
    std::optional<Confusion> confusion;    ///< where every image holds exactly one object
    std::vector<Judgement> judgements;     ///< of each found object, in the order given
};

/// @brief Returns the IoU of the masks of a detection and a ground-truth object, given by index; NaN = one
/// has no mask. Called once for each true positive.
template <class F>
concept MaskOverlap = requires(F& overlap, std::size_t index) {
    { overlap(index, index) } -> std::convertible_to<double>;
};

/// @brief For evaluations without masks.
struct NoMasks {
    [[nodiscard]] double operator()(std::size_t, std::size_t) const {
        return std::numeric_limits<double>::quiet_NaN();
    }
};

namespace detail {

/// A mean that skips NaN; NaN if there is nothing else.
struct Mean {
    double sum = 0;
    std::size_t count = 0;
    void add(double value) {
        if (!std::isnan(value)) sum += value, ++count;
    }
    [[nodiscard]] double value() const {
        return count > 0 ? sum / double(count) : std::numeric_limits<double>::quiet_NaN();
    }
};

/// @throws Error where an index of an image or class is too large.
inline void check_indices(std::span<const TruthObject> truth, std::span<const FoundObject> found,
                          std::size_t images, std::size_t classes) {
    const auto check = [&](const auto& object, const char* whose) {
        expect(object.image < images, lazy_text("image of ", whose), lazy_text("below ", images),
               object.image);
        expect(object.class_index < classes, lazy_text("class of ", whose), lazy_text("below ", classes),
               object.class_index);
    };
    for (const TruthObject& t : truth) check(t, "an object");
    for (const FoundObject& f : found) check(f, "a found object");
}

/// The figures of class `c`.
template <MaskOverlap Masks>
[[nodiscard]] ClassEvaluation evaluate_class(std::span<const TruthObject> truth,
                                             std::span<const FoundObject> found,
                                             std::span<const Judgement> judgements, std::size_t c,
                                             Masks& masks) {
    ClassEvaluation result;
    for (const TruthObject& t : truth) result.objects += t.class_index == c && !t.ignore;
    std::vector<ScoredVerdict> verdicts;
    Mean overlap;
    for (std::size_t f = 0; f < found.size(); ++f) {
        if (found[f].class_index != c || judgements[f].verdict == Verdict::ignored) continue;
        const bool right = judgements[f].verdict == Verdict::true_positive;
        verdicts.push_back({found[f].score, right});
        result.true_positives += right;
        if (right) overlap.add(masks(f, judgements[f].truth));
    }
    result.detections = verdicts.size();
    result.masks = overlap.count;
    result.curve = precision_recall(verdicts, result.objects);
    const BestF1 best = best_f1(result.curve);
    result.best_f1_score = best.score;
    result.figures = {.ap = average_precision(result.curve),
                      .eer = precision_at_equal_recall(result.curve),
                      .best_f1 = best.f1,
                      .mask_iou = overlap.value()};
    return result;
}

}  // namespace detail

/// @brief Measures what was found in `image_count` images against the truth, class by class.
/// @throws Error where an index of an image or class is too large, or a score or box is not finite.
template <MatchRule Rule, MaskOverlap Masks = NoMasks>
[[nodiscard]] Evaluation evaluate(std::span<const TruthObject> truth, std::span<const FoundObject> found,
                                  std::size_t image_count, std::span<const std::string> class_names,
                                  const Rule& rule, Masks masks = {}) {
    detail::check_indices(truth, found, image_count, class_names.size());
    Evaluation result;
    result.judgements = match(truth, found, rule);
    detail::Mean ap, eer, f1, mask;
    for (std::size_t c = 0; c < class_names.size(); ++c) {
        result.classes.push_back(detail::evaluate_class(truth, found, result.judgements, c, masks));
        result.classes.back().name = class_names[c];
        const Figures& figures = result.classes.back().figures;
        ap.add(figures.ap), eer.add(figures.eer), f1.add(figures.best_f1), mask.add(figures.mask_iou);
    }
    result.mean = {.ap = ap.value(), .eer = eer.value(), .best_f1 = f1.value(), .mask_iou = mask.value()};
    if (one_object_each(truth, image_count))
        result.confusion = confusion(truth, found, image_count, class_names.size());
    return result;
}

}  // namespace ism
