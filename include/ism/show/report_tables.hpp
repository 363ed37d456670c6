// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ism/detect/detection.hpp"
#include "ism/model/training_object.hpp"
#include "ism/show/feature_weights.hpp"
#include "ism/show/report_parts.hpp"

namespace ism {

/// @brief What is known of a detection: votes, position, depth, scale, box.
[[nodiscard]] inline ReportTable fact_table(const Detection& detection) {
    ReportTable table;
    const auto add = [&](std::string what, std::string value) {
        table.rows.push_back({std::move(what), std::move(value)});
    };
    std::vector<std::uint32_t> features, words;
    for (const Support& s : detection.support) features.push_back(s.feature), words.push_back(s.word);
    for (auto* list : {&features, &words}) {
        std::sort(list->begin(), list->end());
        list->erase(std::unique(list->begin(), list->end()), list->end());
    }
    if (!std::isnan(detection.probability)) add("probability", number_text(detection.probability, 2));
    add("score", number_text(detection.score));
    add("votes", join_text(detection.support.size(), " by ", features.size(), " features through ",
                           words.size(), " words"));
    if (const auto& p = detection.position_m)
        add("position x, y, z",
            number_text(p->x, 3) + ", " + number_text(p->y, 3) + ", " + number_text(p->z, 3) + " m" +
                (std::isnan(detection.position_error_m)
                     ? ""
                     : ", votes scatter by " + number_text(1000 * detection.position_error_m, 2) + " mm"));
    if (!std::isnan(detection.size_m)) add("size", number_text(detection.size_m, 3) + " m");
    if (is_depth(detection.depth_m)) add("depth", number_text(detection.depth_m, 3) + " m");
    add("scale", number_text(detection.scale, 3));
    add("centre", number_text(detection.centre.x) + ", " + number_text(detection.centre.y) + " px");
    add("figure", join_text(mask_area(detection.segmentation.mask), " px"));
    return table;
}

namespace detail {

[[nodiscard]] inline std::string signed_text(double number) {
    return join_text(number > 0 ? "+" : "", number_text(number, 2));
}

}  // namespace detail

/// @brief What speaks for the class of a mask that was judged (MaskJudge), in logarithms of odds, and the
/// training objects it looks like.
[[nodiscard]] inline ReportTable reason_table(const MaskReasons& reasons,
                                              std::span<const TrainingObject> objects = {}) {
    ReportTable table{.caption = "why this class", .header = {"what", "log odds", "most like"}};
    const auto like = [&](const std::optional<std::uint32_t>& object) -> std::string {
        if (!object) return "";
        if (*object >= objects.size()) return join_text("training object ", *object);
        return join_text("training object ", *object, ", ", objects[*object].image);
    };
    const auto add = [&](const char* what, double log_odds, std::string example) {
        table.rows.push_back({what, detail::signed_text(log_odds), std::move(example)});
    };
    add("votes", reasons.votes, "");
    add("colour", reasons.color, like(reasons.color_object));
    add("shape", reasons.shape, like(reasons.shape_object));
    add("colour and shape together", reasons.look, "");
    add("outline", reasons.outline, "");
    return table;
}

/// @brief What speaks for a box that a template judged with other cues (TemplateScore), in logarithms of
/// odds.
[[nodiscard]] inline ReportTable reason_table(const BoxReasons& reasons) {
    ReportTable table{.caption = "why this class", .header = {"what", "log odds"}};
    const auto add = [&](const char* what, double log_odds) {
        table.rows.push_back({what, detail::signed_text(log_odds)});
    };
    add("look: gradients and colours of the template", reasons.look);
    add("what patches look like, wherever they lie", reasons.patches);
    add("words in the box", reasons.words);
    add("votes that agree with the box", reasons.votes);
    add("share of the class in all votes that do", reasons.share);
    add("colours shared with what is around", reasons.contrast);
    add("colours of the class", reasons.colors);
    add("size: false boxes are mostly small", reasons.size);
    add("any box of the class", reasons.any);
    add("rivals: other classes here, wholes or parts", reasons.rivals);
    add("what was cut out", reasons.mask);
    add("together", reasons.sum());
    return table;
}

/// @brief The words that speak most for a detection: votes and weight of each, and its share of all weight.
[[nodiscard]] inline ReportTable word_table(const Detection& detection, std::size_t count) {
    struct Sum {
        std::uint32_t word = 0;
        std::size_t votes = 0;
        double weight = 0;
    };
    std::map<std::uint32_t, Sum> by_word;
    double all = 0;
    for (const Support& s : detection.support) {
        Sum& sum = by_word[s.word];
        sum.word = s.word, ++sum.votes, sum.weight += double(s.weight), all += double(s.weight);
    }
    std::vector<Sum> sums;
    for (const auto& [word, sum] : by_word) sums.push_back(sum);
    std::stable_sort(sums.begin(), sums.end(),
                     [](const Sum& a, const Sum& b) { return a.weight > b.weight; });
    ReportTable table{.caption = "strongest words", .header = {"word", "votes", "weight", "share"}};
    for (const Sum& sum : std::span(sums).first(std::min(count, sums.size())))
        table.rows.push_back({std::to_string(sum.word), std::to_string(sum.votes), number_text(sum.weight, 3),
                              all > 0 ? number_text(100 * sum.weight / all, 3) + " %" : number_text(NAN)});
    return table;
}

/// @brief The image features that speak most for a detection: place, scale, depth and weight of each.
/// @throws Error where a vote points to a feature that is not there.
[[nodiscard]] inline ReportTable feature_table(const Detections& detections, const Detection& detection,
                                               std::size_t count) {
    std::vector<detail::FeatureWeight> weights = detail::feature_weights(detections, detection);
    std::reverse(weights.begin(), weights.end());
    ReportTable table{.caption = "strongest features",
                      .header = {"at x, y (px)", "scale (px)", "depth (m)", "weight"}};
    for (const detail::FeatureWeight& w : std::span(weights).first(std::min(count, weights.size()))) {
        const Feature& f = detections.features[w.feature];
        table.rows.push_back(
            {number_text(double(f.x)) + ", " + number_text(double(f.y)), number_text(double(f.scale), 3),
             is_depth(double(f.depth_m)) ? number_text(double(f.depth_m), 3) : number_text(NAN),
             number_text(w.weight, 3)});
    }
    return table;
}

}  // namespace ism
