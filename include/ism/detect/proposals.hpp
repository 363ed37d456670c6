// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include "ism/detect/detect_options.hpp"
#include "ism/hog/propose_boxes.hpp"
#include "ism/vote/bandwidth.hpp"
#include "ism/vote/vote_space.hpp"

namespace ism {

/// @brief What is asked of votes that only propose, for templates to judge: the strongest hypotheses of the
/// picture, weak ones too, of any size that it holds. Where templates learn they judge as well from these
/// few, in less time.
[[nodiscard]] inline DetectOptions strongest_proposal_options() {
    return {.min_relative_score = 0.01, .max_candidates = 150, .max_size_px = 1e6};
}

/// @brief The same where templates detect: the strongest of each place, for a wide picture has more places
/// than a close one. Their number is limited for the sake of memory alone. In spaces with depth they are the
/// strongest of the whole picture, since there more of them lowered the mean AP of osd.
template <VoteSpaceType Space>
[[nodiscard]] DetectOptions proposal_options() {
    if (Space::needs_depth) return strongest_proposal_options();
    return {.min_relative_score = 0.01,
            .min_relative_votes = 0.06,
            .max_candidates = most_proposals,
            .max_hypotheses = 400,
            .max_size_px = 1e6,
            .mean_shift = {.max_seeds = most_proposals, .peaks_only = true}};
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
