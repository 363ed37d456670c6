// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include "ism/detect/proposals.hpp"
#include "ism/detect/recognition.hpp"
#include "ism/detect/segment.hpp"
#include "ism/detect/template_score.hpp"
#include "ism/detect/verify.hpp"
#include "ism/vote/kernel.hpp"
#include "ism/vote/vote_space.hpp"

namespace ism {

/// @brief Votes propose, templates judge and place, and of boxes that overlap the best stays: a Recognition
/// for models of learn_templates(), as the program `ism` detects.
template <VoteSpaceType Space = Jism, Segmenter S = PatchSegmenter>
[[nodiscard]] Recognition<Space, EpanechnikovKernel, TemplateScore, S, NonMaximumSuppression>
template_recognition(S segmenter = {}) {
    return {.options = proposal_options<Space>(),
            .bandwidth = proposal_bandwidth<Space>(),
            .segmenter = segmenter,
            .verifier = {.across_classes = false}};
}

}  // namespace ism
