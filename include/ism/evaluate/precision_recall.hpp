// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "ism/core/error.hpp"

namespace ism {

/// @brief The score of a detection and whether it is a true positive.
struct ScoredVerdict {
    double score = 0;
    bool right = false;
};

/// @brief The operating point at one score threshold.
struct PrecisionRecallPoint {
    double score = 0;                ///< the lowest score kept
    std::size_t kept = 0;            ///< detections kept
    std::size_t true_positives = 0;  ///< of these
    double precision = 0;            ///< true positives / kept
    double recall = 0;               ///< true positives / objects
};

/// @brief A precision–recall curve: one point for each distinct score, in descending order, since detections
/// of equal score are kept or dropped together.
struct PrecisionRecall {
    std::size_t objects = 0;  ///< objects there are to find
    std::vector<PrecisionRecallPoint> points;
};

/// @brief The precision–recall curve of detections in any order, `objects` being there to find.
/// @throws Error where a score is not finite or there are more true positives than objects.
[[nodiscard]] inline PrecisionRecall precision_recall(std::span<const ScoredVerdict> verdicts,
                                                      std::size_t objects) {
    std::vector<ScoredVerdict> sorted(verdicts.begin(), verdicts.end());
    for (const ScoredVerdict& v : sorted)
        expect(std::isfinite(v.score), "score of a detection", "a finite number", v.score);
    std::sort(sorted.begin(), sorted.end(),
              [](const ScoredVerdict& a, const ScoredVerdict& b) { return a.score > b.score; });
    PrecisionRecall curve{.objects = objects, .points = {}};
    std::size_t right = 0;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        right += sorted[i].right;
        if (i + 1 < sorted.size() && sorted[i + 1].score == sorted[i].score) continue;
        curve.points.push_back({.score = sorted[i].score,
                                .kept = i + 1,
                                .true_positives = right,
                                .precision = double(right) / double(i + 1),
                                .recall = objects > 0 ? double(right) / double(objects) : 0});
    }
    expect(right <= objects, "right detections", lazy_text("at most ", objects, ", one an object"), right);
    return curve;
}

/// @brief Area under the curve where the precision at a recall is the best one at that recall or beyond
/// (all points; Everingham et al. 2010), 0 … 1; NaN without objects.
[[nodiscard]] inline double average_precision(const PrecisionRecall& curve) {
    if (curve.objects == 0) return std::numeric_limits<double>::quiet_NaN();
    double area = 0, best = 0;
    for (std::size_t i = curve.points.size(); i-- > 0;) {
        best = std::max(best, curve.points[i].precision);
        area += (curve.points[i].recall - (i > 0 ? curve.points[i - 1].recall : 0)) * best;
    }
    return area;
}

/// @brief Precision where it equals recall, 1 − the equal error rate (papers print it as "EER performance" or
/// "EER"): as many detections are kept as there are objects. With fewer
/// detections than objects it is the recall of all of them. Where a cut there parts detections of one score,
/// it is the mean over their orders. 0 … 1; NaN without objects.
[[nodiscard]] inline double precision_at_equal_recall(const PrecisionRecall& curve) {
    if (curve.objects == 0) return std::numeric_limits<double>::quiet_NaN();
    const double objects = double(curve.objects);
    PrecisionRecallPoint before;
    for (const PrecisionRecallPoint& point : curve.points) {
        if (point.kept >= curve.objects) {
            const double share = (objects - double(before.kept)) / double(point.kept - before.kept);
            return (double(before.true_positives) +
                    share * double(point.true_positives - before.true_positives)) /
                   objects;
        }
        before = point;
    }
    return before.recall;
}

/// @brief The point of the best F1.
struct BestF1 {
    double f1 = std::numeric_limits<double>::quiet_NaN();  ///< 2·true positives / (kept + objects), 0 … 1
    double score = std::numeric_limits<double>::quiet_NaN();  ///< keep what reaches this score; NaN: nothing
};

/// @brief The best harmonic mean of precision and recall along the curve; of equal ones that with the highest
/// score. NaN without objects.
[[nodiscard]] inline BestF1 best_f1(const PrecisionRecall& curve) {
    BestF1 best;
    if (curve.objects == 0) return best;
    best.f1 = 0;
    for (const PrecisionRecallPoint& point : curve.points) {
        const double f1 = 2 * double(point.true_positives) / double(point.kept + curve.objects);
        if (f1 > best.f1) best = {f1, point.score};
    }
    return best;
}

}  // namespace ism
