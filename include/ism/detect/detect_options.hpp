// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "ism/codebook/codebook.hpp"
#include "ism/core/error.hpp"
#include "ism/detect/segment.hpp"
#include "ism/vote/bandwidth.hpp"
#include "ism/vote/mean_shift.hpp"
#include "ism/vote/vote_space.hpp"

namespace ism {

/// @brief How objects are searched in a picture.
template <AnyVoteSpace Space>
struct DetectOptions {
    Bandwidth<Space::dimension> bandwidth = default_bandwidth<Space>();
    double keep = 0.05;  ///< T_ratio: weaker hypotheses than this part of the strongest are dropped
    std::size_t max_candidates = 200;  ///< so many of the strongest hypotheses does the judge of boxes see
    std::size_t max_hypotheses = 40;   ///< so many of these, the best after it, are cut out and verified
    double min_size_px = 0;  ///< smaller objects are not looked for; 0 = half the smallest training object
    double max_size_px = 0;  ///< larger ones neither; 0 = twice the largest training object
    MatchMode matching = MatchMode::nearest;  ///< of votes; training and the judge of boxes match softly
    float min_vote_weight = 0.0005f;          ///< lighter votes are dropped
    MeanShiftOptions mean_shift = {};
    SegmentOptions segmentation = {};
    unsigned threads = 0;  ///< 0 = all the machine has
};

/// @brief Does nothing where `options` can be used.
/// @throws Error for an option out of range.
template <AnyVoteSpace Space>
void check(const DetectOptions<Space>& options) {
    expect(options.keep >= 0 && options.keep <= 1, "detection: part of the strongest score to keep (T_ratio)",
           "0 ... 1", options.keep);
    check(options.bandwidth);
    expect(options.min_size_px >= 0 && options.max_size_px >= 0, "detection: least and largest object size",
           "0 px or more", lazy_text(options.min_size_px, ", ", options.max_size_px));
}

}  // namespace ism
