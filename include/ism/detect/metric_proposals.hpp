// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include "ism/detect/detect_options.hpp"

namespace ism {

/// @brief What is asked of votes in metres that only propose.
[[nodiscard]] inline DetectOptions metric_proposal_options() {
    DetectOptions options{.min_relative_score = 0,
                          .max_candidates = 60,
                          .max_hypotheses = 400,
                          .max_size_px = 1e6,
                          .matching = MatchMode::all,
                          .min_vote_weight = 0};
    options.mean_shift.max_seeds = 100;
    options.mean_shift.min_relative_weight = 0.01;
    return options;
}

}  // namespace ism
