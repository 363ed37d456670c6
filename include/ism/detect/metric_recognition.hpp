// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include "ism/detect/mask_judge_score.hpp"
#include "ism/detect/mask_suppression.hpp"
#include "ism/detect/metric.hpp"
#include "ism/detect/metric_proposals.hpp"
#include "ism/detect/recognition.hpp"

namespace ism {

/// @brief Votes in metres and segments of the surface propose, votes, colours and shape judge: a Recognition
/// for RGB-D frames and models of learn_mask_judge(), as the program `ism` detects in the space metric.
[[nodiscard]] inline Recognition<Metric, EpanechnikovKernel, MaskJudgeScore, KeepSegmentation,
                                 MaskSuppression>
metric_recognition() {
    return {.options = metric_proposal_options(), .bandwidth = default_bandwidth<Metric>()};
}

}  // namespace ism
