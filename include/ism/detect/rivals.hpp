// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ism/core/geometry.hpp"
#include "ism/detect/detection.hpp"
#include "ism/model/calibration.hpp"

namespace ism {

/// @brief What shares this much of its place with a box (IoU) is a rival of it, if of another class.
inline constexpr double rival_iou = 0.25;

/// @brief Share of its lead that a rival takes.
inline constexpr double default_rival_share = 0.5;

/// @brief Makes a detection more or less probable by a change of the logarithm of its odds, and its score
/// with it.
/// @param calibration  that gave it its probability, with a slope above 0 for its class
inline void change_log_odds(Detection& detection, double change, const Calibration& calibration) {
    const std::uint32_t c = detection.class_index;
    detection.score *= std::exp(change / calibration.curves[c].slope);
    detection.probability = calibration.probability(c, detection.score);
}

/// @brief Whether one of another class lies at about the same place.
[[nodiscard]] inline bool is_rival(const Detection& other, const Detection& detection) {
    return other.class_index != detection.class_index && iou(other.box, detection.box) >= rival_iou;
}

/// @brief By how much the most probable box of another class at about the same place leads each detection, in
/// logarithms of odds; 0 where none does. What was lost to rivals before does not count.
/// @param detections  with reasons of their boxes
[[nodiscard]] inline std::vector<double> rival_leads(const std::vector<Detection>& detections) {
    std::vector<double> odds, leads;
    for (const Detection& d : detections) odds.push_back(d.box_reasons.sum() - d.box_reasons.rivals);
    for (std::size_t i = 0; i < detections.size(); ++i) {
        double strongest = odds[i];
        for (std::size_t j = 0; j < detections.size(); ++j)
            if (odds[j] > strongest && is_rival(detections[j], detections[i])) strongest = odds[j];
        leads.push_back(strongest - odds[i]);
    }
    return leads;
}

/// @brief One place shows one object: where a box of another class at about the same place is more probable,
/// a detection loses a share of its lead, instead of what it lost before. The most probable stay as they are.
/// @param detections   with reasons of their boxes
/// @param calibration  that gave them their probabilities
/// @param share        0 = none ... 1 = all
inline void yield_to_rivals(std::vector<Detection>& detections, const Calibration& calibration,
                            double share) {
    const std::vector<double> leads = rival_leads(detections);
    for (std::size_t i = 0; i < detections.size(); ++i) {
        Detection& detection = detections[i];
        const double slope = calibration.curves[detection.class_index].slope;
        const double lost = leads[i] > 0 ? -share * leads[i] : 0, before = detection.box_reasons.rivals;
        if (lost == before || !(slope > 0)) continue;
        detection.box_reasons.rivals = lost;
        change_log_odds(detection, lost - before, calibration);
    }
}

}  // namespace ism
