// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "ism/core/geometry.hpp"
#include "ism/detect/detection.hpp"
#include "ism/model/calibration.hpp"

namespace ism {

/// @brief What shares this much of its place with a box (IoU) is a rival of it, if of another class.
inline constexpr double rival_iou = 0.25;

/// @brief One place shows one object: where a box of another class at about the same place is more probable,
/// a detection loses a share of the difference between the logarithms of their odds. The most probable stay
/// as they are.
/// @param detections   with reasons of their boxes
/// @param calibration  that gave them their probabilities
/// @param share        0 = none ... 1 = all
inline void yield_to_rivals(std::vector<Detection>& detections, const Calibration& calibration,
                            double share) {
    std::vector<double> odds;
    for (const Detection& detection : detections) odds.push_back(detection.box_reasons.sum());
    for (std::size_t i = 0; i < detections.size(); ++i) {
        Detection& detection = detections[i];
        const double slope = calibration.curves[detection.class_index].slope;
        double strongest = odds[i];
        for (std::size_t j = 0; j < detections.size(); ++j)
            if (odds[j] > strongest && detections[j].class_index != detection.class_index &&
                iou(detections[j].box, detection.box) >= rival_iou)
                strongest = odds[j];
        if (strongest == odds[i] || !(slope > 0)) continue;
        detection.box_reasons.rivals = share * (odds[i] - strongest);
        detection.score *= std::exp(detection.box_reasons.rivals / slope);
        detection.probability = calibration.probability(detection.class_index, detection.score);
    }
}

}  // namespace ism
