// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ism/core/number_text.hpp"
#include "ism/detect/detection.hpp"

namespace ism::detail {

/// The probability of a detection in percent, or where it is not known its score.
[[nodiscard]] inline std::string confidence_text(const Detection& detection) {
    return std::isnan(detection.probability) ? number_text(detection.score, 3)
                                             : number_text(std::round(100 * detection.probability)) + " %";
}

/// @throws Error where the class of a detection has no name.
[[nodiscard]] inline const std::string& name_of(const Detection& detection,
                                                std::span<const std::string> names) {
    expect(detection.class_index < names.size(), "class of a detection", lazy_text("below ", names.size()),
           detection.class_index);
    return names[detection.class_index];
}

/// "cup 83 %", how probable it is; or, where that is not known, its score, "cup 0.412"
[[nodiscard]] inline std::string label_text(const Detection& detection, std::span<const std::string> names) {
    return name_of(detection, names) + " " + confidence_text(detection);
}

/// What a feature adds to a detection, all its votes together.
struct FeatureWeight {
    std::uint32_t feature = 0;
    double weight = 0;
};

/// The features that support a detection, strongest last, so that they are drawn on top.
[[nodiscard]] inline std::vector<FeatureWeight> feature_weights(const Detections& detections,
                                                                const Detection& detection) {
    std::vector<FeatureWeight> weights(detections.features.size());
    for (const Support& s : detection.support) {
        expect(s.feature < weights.size(), "feature of a vote", lazy_text("below ", weights.size()),
               s.feature);
        weights[s.feature] = {s.feature, weights[s.feature].weight + double(s.weight)};
    }
    weights.erase(std::remove_if(weights.begin(), weights.end(),
                                 [](const FeatureWeight& f) { return !(f.weight > 0); }),
                  weights.end());
    std::stable_sort(weights.begin(), weights.end(),
                     [](const FeatureWeight& a, const FeatureWeight& b) { return a.weight < b.weight; });
    return weights;
}

}  // namespace ism::detail
