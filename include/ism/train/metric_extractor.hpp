// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include "ism/feature/difference_of_gaussians.hpp"
#include "ism/feature/extractor.hpp"
#include "ism/feature/sift.hpp"

namespace ism {

/// @brief The features that learn_metric() is best with: many, also of low contrast, each with its
/// direction.
[[nodiscard]] inline Extractor<DifferenceOfGaussians, RootSift> metric_extractor() {
    return {.detector = {.contrast_threshold = 0.008f},
            .descriptor = {},
            .options = {.scale_space = {}, .oriented = true}};
}

}  // namespace ism
