// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "ism/evaluate/coco_rule.hpp"
#include "ism/evaluate/evaluate.hpp"

namespace ism {

namespace detail {

using OrderedJson = nlohmann::ordered_json;

[[nodiscard]] inline OrderedJson json_number(double value) {
    return std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr);
}

/// What to_json() writes.
[[nodiscard]] inline OrderedJson json_of(const Evaluation& evaluation) {
    const auto add = [&](OrderedJson record, const Figures& figures) {
        record["ap"] = json_number(figures.ap);
        record["eer"] = json_number(figures.eer);
        record["best_f1"] = json_number(figures.best_f1);
        record["mask_iou"] = json_number(figures.mask_iou);
        return record;
    };
    OrderedJson classes = OrderedJson::object();
    for (const ClassEvaluation& c : evaluation.classes) {
        const OrderedJson counts = {{"objects", c.objects},
                                    {"detections", c.detections},
                                    {"right", c.true_positives},
                                    {"masks", c.masks}};
        classes[c.name] = add(counts, c.figures);
        classes[c.name]["best_f1_score"] = json_number(c.best_f1_score);
    }
    OrderedJson root = {{"classes", classes}, {"mean", add(OrderedJson::object(), evaluation.mean)}};
    root["accuracy"] =
        evaluation.confusion ? OrderedJson(evaluation.confusion->accuracy()) : OrderedJson(nullptr);
    if (const auto& matrix = evaluation.confusion) {
        OrderedJson rows = OrderedJson::array(), names = OrderedJson::array();
        for (std::size_t truth = 0; truth < matrix->class_count; ++truth) {
            OrderedJson row = OrderedJson::array();
            for (std::size_t found = 0; found <= matrix->class_count; ++found)
                row.push_back(matrix->count(truth, found));
            rows.push_back(std::move(row));
            names.push_back(evaluation.classes.at(truth).name);
        }
        root["confusion"] = {{"classes", names}, {"images", rows}};
    }
    return root;
}

[[nodiscard]] inline OrderedJson json_of(const CocoEvaluation& evaluation) {
    const auto add = [](OrderedJson record, const CocoFigures& figures) {
        record["ap"] = json_number(figures.ap);
        record["ap50"] = json_number(figures.ap50);
        record["ap75"] = json_number(figures.ap75);
        record["recall"] = json_number(figures.recall);
        return record;
    };
    OrderedJson classes = OrderedJson::object();
    for (const CocoClass& c : evaluation.classes)
        classes[c.name] = add({{"objects", c.objects}, {"detections", c.detections}}, c.figures);
    return {{"classes", classes}, {"mean", add(OrderedJson::object(), evaluation.mean)}};
}

[[nodiscard]] inline std::string indented(const OrderedJson& root) {
    return root.dump(2, ' ', false, OrderedJson::error_handler_t::replace);
}

}  // namespace detail

/// @brief An evaluation as JSON text: `classes` {name: {objects, detections, right, masks, ap, eer,
/// best_f1, best_f1_score, mask_iou}}, `mean` {ap, eer, best_f1, mask_iou}, `accuracy`; null where there was
/// nothing to measure; where every image holds one object `confusion` {classes: names, images: a row for each
/// true class, a column for each class it was taken for and one for none}.
[[nodiscard]] inline std::string to_json(const Evaluation& evaluation) {
    return detail::indented(detail::json_of(evaluation));
}

/// @brief An evaluation by COCO's rule as JSON text: `classes` {name: {objects, detections, ap, ap50, ap75,
/// recall}}, `mean` {ap, ap50, ap75, recall}; null where there was nothing to measure.
[[nodiscard]] inline std::string to_json(const CocoEvaluation& evaluation) {
    return detail::indented(detail::json_of(evaluation));
}

}  // namespace ism
