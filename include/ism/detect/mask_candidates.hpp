// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/region_mask.hpp"
#include "ism/depth/convex_segments.hpp"
#include "ism/detect/detection.hpp"
#include "ism/detect/scene.hpp"
#include "ism/detect/vote_mask.hpp"

namespace ism {

/// @brief Regions that may be objects: segments of the surface, and the masks of hypotheses.
struct MaskCandidateOptions {
    SegmentOptions segments = {};
    std::size_t max_vote_masks = 30;  ///< hypotheses that give a mask, the strongest
};

/// @brief The segments of a scene with a surface, then the masks of hypotheses that are not much like a
/// segment or each other.
/// @param hypotheses  strongest first, of a space with poses
[[nodiscard]] inline std::vector<RegionMask> mask_candidates(const Scene& scene,
                                                             std::span<const Detection> hypotheses,
                                                             const MaskCandidateOptions& options) {
    DepthSegments found = depth_segments(*scene.surface, options.segments, scene.pool);
    const std::size_t count = std::min(options.max_vote_masks, hypotheses.size());
    std::vector<RegionMask> of_votes(count);
    scene.pool.for_each(
        count, [&](std::size_t i, unsigned) { of_votes[i] = vote_mask(hypotheses[i], found.fine, scene); });
    const double least =
        options.segments.min_share * double(scene.surface->width()) * scene.surface->height();
    std::vector<RegionMask> candidates = std::move(found.segments);
    for (RegionMask& mask : of_votes)
        if (const auto area = area_of(mask); area > 0 && double(area) >= least)
            candidates.push_back(std::move(mask));
    return without_duplicates(std::move(candidates), options.segments.max_iou);
}

}  // namespace ism
