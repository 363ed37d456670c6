// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include "ism/detect/detect_options.hpp"
#include "ism/vote/bandwidth.hpp"
#include "ism/vote/vote_space.hpp"

namespace ism {

/// @brief What is asked of votes that only propose, for templates to judge: weak hypotheses too, of any size
/// that the image holds.
[[nodiscard]] inline DetectOptions proposal_options() {
    return {.min_relative_score = 0.01, .max_candidates = 150, .max_size_px = 1e6};
}

/// @brief The bandwidth of votes that only propose: narrower than where votes decide, so that neighbours stay
/// apart and none pulls the other's box.
template <VoteSpaceType Space>
[[nodiscard]] constexpr Bandwidth<Space::dimension> proposal_bandwidth() {
    Bandwidth<Space::dimension> bandwidth = default_bandwidth<Space>();
    for (double& window : bandwidth.at_scale_1) window *= 0.7;
    return bandwidth;
}

}  // namespace ism
