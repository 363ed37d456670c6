// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

/// @file
/// @brief Detection in the vote space Metric, or in one of your own that has its axes.

#include <cstddef>
#include <vector>

#include "ism/codebook/match.hpp"
#include "ism/codebook/match_nearest.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/detect.hpp"
#include "ism/detect/frame_matcher.hpp"
#include "ism/detect/posed_hypothesis.hpp"
#include "ism/detect/surface_scene.hpp"
#include "ism/vote/metric.hpp"

namespace ism {

inline std::vector<Match> match_neighbours(const WordIndex& words, const Descriptors<float>& descriptors,
                                           std::size_t neighbours, ThreadPool& pool) {
    if (neighbours == 0) return match(words, descriptors, pool);
    return match_nearest(words, descriptors, neighbours, pool);
}

}  // namespace ism
