// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "ism/evaluate/evaluate.hpp"
#include "ism/evaluate/table.hpp"
#include "ism/show/svg.hpp"

namespace ism {

/// @brief The precision–recall curves of all classes with objects, their average precision in the legend.
[[nodiscard]] inline Plot precision_recall_plot(const Evaluation& evaluation,
                                                std::string title = "Precision and recall") {
    Plot plot{.title = std::move(title), .x_label = "recall", .y_label = "precision"};
    for (std::size_t c = 0; c < evaluation.classes.size(); ++c) {
        const ClassEvaluation& figures = evaluation.classes[c];
        if (figures.objects == 0) continue;
        PlotCurve curve{.name = figures.name + ", AP " + percent_text(figures.figures.ap) + " %",
                        .color = class_color(c)};
        for (const PrecisionRecallPoint& point : figures.curve.points) {
            // the curve starts at recall 0 with the precision of the most confident detections
            if (curve.x.empty()) curve.x.push_back(0), curve.y.push_back(point.precision);
            curve.x.push_back(point.recall), curve.y.push_back(point.precision);
        }
        plot.curves.push_back(std::move(curve));
    }
    return plot;
}

}  // namespace ism
