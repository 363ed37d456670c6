// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ism/evaluate/evaluate.hpp"
#include "ism/evaluate/table.hpp"
#include "ism/show/short_text.hpp"
#include "ism/show/svg.hpp"

namespace ism {

namespace detail {

/// The curve of one class, from recall 0 with the precision of the most confident detections.
[[nodiscard]] inline PlotCurve precision_recall_curve(const ClassEvaluation& of, Rgb color) {
    constexpr std::size_t most_letters = 28;
    PlotCurve curve{.name = "AP " + percent_text(of.figures.ap) + " %, " + shortened(of.name, most_letters),
                    .color = color};
    for (const PrecisionRecallPoint& point : of.curve.points) {
        if (curve.x.empty()) curve.x.push_back(0), curve.y.push_back(point.precision);
        curve.x.push_back(point.recall), curve.y.push_back(point.precision);
    }
    return curve;
}

/// The mean over classes of the best precision at each recall or any higher one.
[[nodiscard]] inline PlotCurve mean_curve(std::span<const ClassEvaluation* const> classes, double mean_ap) {
    PlotCurve curve{
        .name = join_text("AP ", percent_text(mean_ap), " %, mean of ", classes.size(), " classes"),
        .color = {120, 120, 128}};
    for (int k = 0; k <= 100; ++k) {
        double sum = 0;
        for (const ClassEvaluation* one : classes) {
            double best = 0;
            for (const PrecisionRecallPoint& point : one->curve.points)
                if (point.recall > 0.01 * k - 1e-9) best = std::max(best, point.precision);
            sum += best;
        }
        curve.x.push_back(0.01 * k), curve.y.push_back(sum / double(classes.size()));
    }
    return curve;
}

}  // namespace detail

/// @brief The precision–recall curves of all classes with objects, their average precision in the legend; of
/// more than twelve classes those of the mean and of the five worst.
/// @param colors  of the classes; those that are missing are class_color()
[[nodiscard]] inline Plot precision_recall_plot(const Evaluation& evaluation,
                                                std::string title = "Precision and recall",
                                                std::span<const Rgb> colors = {}) {
    constexpr std::size_t most_curves = 12, worst_shown = 5;
    Plot plot{.title = std::move(title), .x_label = "recall", .y_label = "precision"};
    std::vector<const ClassEvaluation*> shown;
    for (const ClassEvaluation& one : evaluation.classes)
        if (one.objects > 0) shown.push_back(&one);
    if (shown.size() > most_curves) {
        plot.curves.push_back(detail::mean_curve(shown, evaluation.mean.ap));
        std::stable_sort(shown.begin(), shown.end(),
                         [](const auto* a, const auto* b) { return a->figures.ap < b->figures.ap; });
        shown.resize(worst_shown);
    }
    for (const ClassEvaluation* one : shown) {
        const auto c = std::size_t(one - evaluation.classes.data());
        plot.curves.push_back(
            detail::precision_recall_curve(*one, c < colors.size() ? colors[c] : class_color(c)));
    }
    return plot;
}

}  // namespace ism
