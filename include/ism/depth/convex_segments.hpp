// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/region_mask.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/depth/merge_supervoxels.hpp"
#include "ism/depth/supervoxels.hpp"
#include "ism/depth/surface.hpp"

namespace ism {

/// @brief How a surface is cut into segments.
struct SegmentOptions {
    SupervoxelOptions supervoxels = {};  ///< whose step a level may change
    /// Without a common neighbour more is merged, with a small tolerance less; a large one keeps hollow
    /// things whole. The first reaches most objects, the others add some.
    std::vector<SegmentLevel> levels = {{12, 20, true}, {16, 20, true}, {12, 10, true},
                                        {12, 5, true},  {12, 40, true}, {12, 25, false}};
    int min_border_px = 3;     ///< pixels side by side that two supervoxels need to be neighbours
    double min_share = 0.001;  ///< smaller parts of the image are dropped: 307 px of 640 × 480
    double max_share = 0.95;   ///< and larger ones
    double max_iou = 0.85;     ///< with a segment before it; what is more alike is dropped
};

/// @brief Validates `options`.
/// @throws Error for one out of range or NaN.
inline void check(const SegmentOptions& options) {
    check(options.supervoxels);
    for (const SegmentLevel& level : options.levels) {
        expect(level.step_px >= 2 && level.step_px <= 1000, "SegmentLevel::step_px", "2 to 1000",
               level.step_px);
        expect(level.tolerance_deg >= 0 && level.tolerance_deg <= 90, "SegmentLevel::tolerance_deg",
               "0 to 90", level.tolerance_deg);
    }
    expect(options.min_border_px >= 1, "SegmentOptions::min_border_px", "1 or more", options.min_border_px);
    expect(options.min_share >= 0 && options.min_share <= 1, "SegmentOptions::min_share", "0 to 1",
           options.min_share);
    expect(options.max_share >= 0 && options.max_share <= 1, "SegmentOptions::max_share", "0 to 1",
           options.max_share);
    expect(options.max_iou >= 0 && options.max_iou <= 1, "SegmentOptions::max_iou", "0 to 1",
           options.max_iou);
}

/// @brief What a surface is made of.
struct DepthSegments {
    Supervoxels fine;                  ///< those of SegmentOptions::supervoxels
    std::vector<RegionMask> segments;  ///< level after level, within one from the top left of the image
};

/// @brief Cuts a surface into segments that may be objects: supervoxels merged where they meet without a step
/// in depth and convexly, in several ways at once, for no one way is right everywhere. No support plane and
/// no up direction is assumed.
/// @throws Error as check(const SegmentOptions&) does.
[[nodiscard]] inline DepthSegments depth_segments(const Surface& surface, const SegmentOptions& options,
                                                  ThreadPool& pool) {
    check(options);
    struct Step {
        Supervoxels supervoxels;
        std::vector<detail::SupervoxelEdge> edges;
    };
    std::vector<int> steps_px = {options.supervoxels.step_px};
    std::vector<std::size_t> step_of(options.levels.size());
    for (std::size_t l = 0; l < options.levels.size(); ++l) {
        const int step_px = options.levels[l].step_px;
        step_of[l] = std::size_t(std::find(steps_px.begin(), steps_px.end(), step_px) - steps_px.begin());
        if (step_of[l] == steps_px.size()) steps_px.push_back(step_px);
    }
    std::vector<Step> steps(steps_px.size());
    for (std::size_t s = 0; s < steps.size(); ++s) {
        SupervoxelOptions of_step = options.supervoxels;
        of_step.step_px = steps_px[s];
        steps[s].supervoxels = supervoxels_of(surface, of_step, pool);
    }
    pool.for_each(steps.size(), [&](std::size_t s, unsigned) {
        steps[s].edges = detail::supervoxel_edges(surface, steps[s].supervoxels, options.min_border_px);
    });
    const double pixels = double(surface.width()) * surface.height();
    std::vector<std::vector<RegionMask>> of_level(options.levels.size());
    pool.for_each(of_level.size(), [&](std::size_t l, unsigned) {
        const Step& step = steps[step_of[l]];
        of_level[l] = detail::group_masks(
            step.supervoxels, detail::merge_convex(step.supervoxels.all, step.edges, options.levels[l]),
            options.min_share * pixels, options.max_share * pixels);
    });
    std::vector<RegionMask> joined;
    for (auto& masks : of_level)
        for (RegionMask& mask : masks) joined.push_back(std::move(mask));
    return {std::move(steps.front().supervoxels), without_duplicates(std::move(joined), options.max_iou)};
}

}  // namespace ism
