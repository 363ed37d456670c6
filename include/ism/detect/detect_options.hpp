// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "ism/core/error.hpp"
#include "ism/vote/mean_shift.hpp"

namespace ism {

/// @brief Which words of a feature cast votes.
enum class MatchMode {
    all,      ///< every word within the threshold (soft matching)
    nearest,  ///< only the nearest of each group, if within the threshold
};

/// @brief How objects are searched for in an image, whatever the vote space.
struct DetectOptions {
    double min_relative_score = 0.05;  ///< T_ratio: weaker than this part of the strongest is dropped
    double min_relative_votes = 0;     ///< the same of hypotheses before they are rescored, where it is more
    double min_probability = 0;        ///< what is less probable is not told; needs a rescorer that knows it
    std::size_t max_candidates = 200;  ///< at most this many, the strongest, are rescored
    std::size_t max_hypotheses = 40;   ///< the best of these after rescoring are segmented and verified
    double min_size_px = 0;  ///< smaller objects are not looked for; 0 = half the smallest training object
    double max_size_px = 0;  ///< nor larger ones, nor any beyond the image's diagonal; 0 = twice the largest
                             ///< training object
    MatchMode matching = MatchMode::nearest;  ///< of votes; training and rescorers match softly
    float min_vote_weight = 0.0005f;          ///< lighter votes are dropped
    MeanShiftOptions mean_shift = {};
};

/// @brief Validates options.
/// @throws Error for one out of range.
inline void check(const DetectOptions& options) {
    const auto in_range = [](double value, const char* name) {
        expect(value >= 0 && value <= 1e9, lazy_text("DetectOptions::", name), "0 ... 1e9 px", value);
    };
    expect(options.min_relative_score >= 0 && options.min_relative_score <= 1,
           "DetectOptions::min_relative_score (T_ratio)", "0 ... 1", options.min_relative_score);
    expect(options.min_relative_votes >= 0 && options.min_relative_votes <= 1,
           "DetectOptions::min_relative_votes", "0 ... 1", options.min_relative_votes);
    expect(options.min_probability >= 0 && options.min_probability <= 1, "DetectOptions::min_probability",
           "0 ... 1", options.min_probability);
    expect(options.max_candidates > 0, "DetectOptions::max_candidates", "1 or more", 0);
    expect(options.max_hypotheses > 0, "DetectOptions::max_hypotheses", "1 or more", 0);
    in_range(options.min_size_px, "min_size_px");
    in_range(options.max_size_px, "max_size_px");
    expect(options.max_size_px == 0 || options.max_size_px >= options.min_size_px,
           "DetectOptions::max_size_px", "0 or at least min_size_px", options.max_size_px);
    expect(options.min_vote_weight >= 0 && options.min_vote_weight <= 1, "DetectOptions::min_vote_weight",
           "0 ... 1", options.min_vote_weight);
    check(options.mean_shift);
}

}  // namespace ism
