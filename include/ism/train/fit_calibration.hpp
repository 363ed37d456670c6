// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ism/core/logistic.hpp"
#include "ism/model/calibration.hpp"
#include "ism/train/balanced_folds.hpp"
#include "ism/train/fit_box_classifier.hpp"
#include "ism/train/train_options.hpp"
#include "ism/train/training_boxes.hpp"
#include "ism/train/training_features.hpp"

namespace ism {

/// @brief A score, and whether it was that of a true positive.
struct ScoredExample {
    double score = 0;
    bool positive = false;
};

/// @brief Fits a logistic curve over the logarithm of scores (Platt 1999, with his targets of
/// (N₊ + 1)/(N₊ + 2) and 1/(N₋ + 2), by Newton's method). Examples without score, and lists without both
/// kinds, tell nothing of the slope: then the curve is flat at the share of positives, and so it is where
/// higher scores are not more often right.
[[nodiscard]] inline Calibration::Curve fit_curve(const std::vector<ScoredExample>& examples) {
    double positives = 0, negatives = 0;
    for (const ScoredExample& e : examples) (e.positive ? positives : negatives) += e.score > 0;
    const double high = (positives + 1) / (positives + 2), low = 1 / (negatives + 2);
    const Calibration::Curve flat{.slope = 0, .offset = std::log((positives + 1) / (negatives + 1))};
    if (positives == 0 || negatives == 0) return flat;
    Calibration::Curve curve = flat;
    const auto loss = [&](const Calibration::Curve& at) {
        double sum = 0;
        for (const ScoredExample& e : examples) {
            if (!(e.score > 0)) continue;
            const double z = at.slope * std::log(e.score) + at.offset, target = e.positive ? high : low;
            sum += softplus(z) - target * z;
        }
        return sum;
    };
    double now = loss(curve);
    for (int step = 0; step < 100; ++step) {
        double ga = 0, gb = 0, haa = 1e-9, hab = 0, hbb = 1e-9;
        for (const ScoredExample& e : examples) {
            if (!(e.score > 0)) continue;
            const double x = std::log(e.score), z = curve.slope * x + curve.offset;
            const double p = logistic(z), error = p - (e.positive ? high : low), w = p * (1 - p);
            ga += error * x, gb += error;
            haa += w * x * x, hab += w * x, hbb += w;
        }
        const double determinant = haa * hbb - hab * hab;
        if (!(determinant > 0)) break;
        const double da = (hbb * ga - hab * gb) / determinant, db = (haa * gb - hab * ga) / determinant;
        bool better = false;
        for (double length = 1; length > 1e-6 && !better; length /= 2) {
            const Calibration::Curve next{curve.slope - length * da, curve.offset - length * db};
            if (const double there = loss(next); there < now - 1e-12)
                curve = next, now = there, better = true;
        }
        if (!better) break;
    }
    constexpr double least_slope = 0.01;  // scores a million times as high are hardly more probable
    return curve.slope >= least_slope ? curve : flat;
}

/// @brief A curve for each class; one with few examples of either kind has that of all.
[[nodiscard]] inline Calibration calibration_of(const std::vector<std::vector<ScoredExample>>& of_class,
                                                const std::vector<ScoredExample>& all) {
    constexpr std::size_t least = 8;  // of each kind for a curve of its own
    const auto enough = [&](const std::vector<ScoredExample>& examples) {
        std::size_t positives = 0;
        for (const ScoredExample& e : examples) positives += e.positive;
        return positives >= least && examples.size() - positives >= least;
    };
    Calibration calibration;
    const Calibration::Curve common = fit_curve(all);
    for (const auto& examples : of_class)
        calibration.curves.push_back(enough(examples) ? fit_curve(examples) : common);
    return calibration;
}

/// @brief Which half of the training images each view belongs to, 0 or 1: each half has its share of the
/// images of each class and of background, and a mirror image goes with its image.
[[nodiscard]] inline std::vector<std::uint8_t> halves_of_views(const TrainingFeatures& features) {
    std::vector<std::vector<ObjectLabel>> labels;  // of each image
    std::vector<std::size_t> image_of;             // of each view
    for (const TrainingView& view : features.views) {
        if (!view.mirrored || labels.empty()) labels.push_back(view.labels);
        image_of.push_back(labels.size() - 1);
    }
    const auto half = detail::balanced_folds(labels, features.class_names.size(), 2);
    std::vector<std::uint8_t> half_of_view;
    for (const std::size_t image : image_of) half_of_view.push_back(std::uint8_t(half[image]));
    return half_of_view;
}

/// @brief Learns how scores become probabilities, from hypotheses that were found without votes of their own
/// image, judged by classifiers of boxes that were fitted without it: on the other half of the images. Where
/// there are few, the halves take turns. A class with few examples has the curve of all classes.
/// @param boxes         of training_boxes()
/// @param half_of_view  see halves_of_views()
[[nodiscard]] inline Calibration fit_calibration(const std::vector<TrainingBox>& boxes,
                                                 const std::vector<std::uint8_t>& half_of_view,
                                                 std::size_t words, std::size_t classes,
                                                 const TrainOptions& options) {
    constexpr std::size_t many = 1000;  // hypotheses of one half are enough
    std::array<std::vector<TrainingBox>, 2> halves;
    for (const TrainingBox& box : boxes) halves[half_of_view[box.view]].push_back(box);
    std::vector<std::vector<ScoredExample>> of_class(classes);
    std::vector<ScoredExample> all;
    for (const std::size_t half : {0u, 1u}) {
        if (half == 1 && all.size() >= many) break;
        BoxClassifier classifier;
        if (options.box_classifier)
            classifier = fit_box_classifier(halves[1 - half], words, classes, *options.box_classifier,
                                            options.threads);
        for (const TrainingBox& box : halves[half]) {
            if (!box.is_hypothesis()) continue;
            const double score = box.score * classifier.probability(box.predicted_class, box.histogram);
            const bool positive = box.true_class == box.predicted_class && box.overlap >= right_iou;
            of_class[box.predicted_class].push_back({score, positive});
            all.push_back({score, positive});
        }
    }
    return calibration_of(of_class, all);
}

}  // namespace ism
