// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/logistic.hpp"
#include "ism/core/order.hpp"
#include "ism/detect/detection.hpp"
#include "ism/hog/propose_boxes.hpp"
#include "ism/model/calibration.hpp"

namespace ism {

/// @brief What shares this much of its place with a box (IoU) is a rival of it, if of another class.
inline constexpr double rival_iou = 0.25;

/// @brief Makes a detection more or less probable by a change of the logarithm of its odds, and its score
/// with it.
/// @param calibration  that gave it its probability, with a slope above 0 for its class
inline void change_log_odds(Detection& detection, double change, const Calibration& calibration) {
    const std::uint32_t c = detection.class_index;
    using Score = std::numeric_limits<double>;  // flat curves ask for scores beyond all numbers
    const double factor = std::min(std::exp(change / calibration.curves[c].slope), Score::max());
    detection.score = std::clamp(detection.score * factor, Score::min(), Score::max());
    detection.probability = calibration.probability(c, detection.score);
}

/// @brief Whether one of another class lies at about the same place.
[[nodiscard]] inline bool is_rival(const Detection& other, const Detection& detection) {
    return other.class_index != detection.class_index && iou(other.box, detection.box) >= rival_iou;
}

/// @brief The most probable box of another class at about the same place as detection i; i itself where none
/// is more probable.
/// @param odds  logarithms of each detection's
[[nodiscard]] inline std::size_t strongest_rival(const std::vector<Detection>& detections,
                                                 const std::vector<double>& odds, std::size_t i) {
    std::size_t strongest = i;
    for (std::size_t j = 0; j < detections.size(); ++j)
        if (odds[j] > odds[strongest] && is_rival(detections[j], detections[i])) strongest = j;
    return strongest;
}

/// @brief Whether a box may show a part of what another shows.
[[nodiscard]] inline bool is_part(const Box& part, const Box& whole) {
    return part.area() < whole.area() && lies_within(part, whole) && !is_one_object(part, whole);
}

/// @brief A place shows a whole or what lies in it, parts of it or objects of their own, but not both: of a
/// box of odds O and those of its class within it, which are apart and of odds oᵢ, the whole is there with
/// odds O / Π (1 + oᵢ), that is with a probability P, and each of the others with pᵢ · (1 − P).
/// @param odds  logarithms of each detection's
/// @return logarithms of these
[[nodiscard]] inline std::vector<double> odds_of_wholes_and_parts(const std::vector<Detection>& detections,
                                                                  const std::vector<double>& odds) {
    const auto same_class = [&](std::size_t i, std::size_t j) {
        return detections[i].class_index == detections[j].class_index;
    };
    const auto is_part_of = [&](std::size_t part, std::size_t whole) {
        return same_class(part, whole) && is_part(detections[part].box, detections[whole].box);
    };
    std::vector<detail::Ranked> order;
    for (const double o : odds) order.push_back({detail::falling(o), std::uint32_t(order.size())});
    detail::sort_ranked(order.data(), order.size());
    std::vector<std::size_t> objects;  // the most probable box of each, the most probable first
    for (const detail::Ranked& ranked : order) {
        const std::size_t i = ranked.index;
        if (!detail::any_of(objects, [&](std::size_t object) {
                return same_class(i, object) && is_one_object(detections[i].box, detections[object].box);
            }))
            objects.push_back(i);
    }

    std::vector<double> as_whole = odds;
    for (std::size_t i = 0; i < odds.size(); ++i) {
        std::vector<std::size_t> parts;
        for (const std::size_t object : objects) {
            const auto is_nested = [&](std::size_t part) {
                return is_part_of(object, part) || is_part_of(part, object);
            };
            if (!is_part_of(object, i) || detail::any_of(parts, is_nested)) continue;
            parts.push_back(object);
            as_whole[i] -= softplus(odds[object]);
        }
    }
    std::vector<double> result = as_whole;
    for (std::size_t i = 0; i < odds.size(); ++i) {
        double whole = -std::numeric_limits<double>::infinity();
        for (const std::size_t object : objects)
            if (is_part_of(i, object)) whole = std::max(whole, as_whole[object]);
        result[i] -= softplus(whole + softplus(result[i]));
    }
    return result;
}

/// @brief How much detections lose to rivals.
struct RivalOptions {
    double other_classes = 0.5;    ///< of the lead of a more probable class at the same place; 0 = nothing
    bool wholes_and_parts = true;  ///< of a class exclude each other, see odds_of_wholes_and_parts()
};

/// @brief Validates options.
/// @throws Error for one out of range.
inline void check(const RivalOptions& options) {
    expect(options.other_classes >= 0 && options.other_classes <= 1, "RivalOptions::other_classes", "0 ... 1",
           options.other_classes);
}

/// @brief One place shows one object: a detection loses a share of the lead of the most probable box of
/// another class at about the same place, and wholes and parts of one class exclude each other. What was lost
/// before does not count.
/// @param detections   with reasons of their boxes
/// @param calibration  that gave them their probabilities
inline void yield_to_rivals(std::vector<Detection>& detections, const Calibration& calibration,
                            const RivalOptions& options = {}) {
    std::vector<double> alone;
    for (const Detection& d : detections) alone.push_back(d.box_reasons.sum() - d.box_reasons.rivals);
    std::vector<double> odds = alone;
    for (std::size_t i = 0; i < odds.size(); ++i)
        odds[i] -= options.other_classes * (alone[strongest_rival(detections, alone, i)] - alone[i]);
    if (options.wholes_and_parts) odds = odds_of_wholes_and_parts(detections, odds);
    for (std::size_t i = 0; i < odds.size(); ++i) {
        Detection& detection = detections[i];
        const double before = detection.box_reasons.rivals, now = odds[i] - alone[i];
        if (now == before || !(calibration.curves[detection.class_index].slope > 0)) continue;
        detection.box_reasons.rivals = now;
        change_log_odds(detection, now - before, calibration);
    }
}

}  // namespace ism
