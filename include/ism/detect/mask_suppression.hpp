// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/region_mask.hpp"
#include "ism/detect/detection.hpp"
#include "ism/detect/scene.hpp"
#include "ism/detect/verify.hpp"

namespace ism {

/// @brief Non-maximum suppression of masks: of those that share much the most probable stays, whatever the
/// class.
struct MaskSuppression {
    double max_iou = 0.4;     ///< boxes that overlap more are of one object
    double max_inside = 0.5;  ///< … or masks of which the smaller lies in the other with a larger part
    /// Whether a kept mask is also told as its other classes, their logit lowered by 1: where the first class
    /// is wrong the right one is not lost. For evaluation of all hypotheses, not for users.
    bool second_choices = false;

    /// @brief Candidates have their masks already; nothing has to be cut out for this.
    [[nodiscard]] static constexpr bool needs_masks() { return false; }

    [[nodiscard]] std::vector<Verified> verify(const std::vector<Detection>& candidates) const;
    [[nodiscard]] std::vector<Verified> verify(const std::vector<Detection>& candidates, const Scene&) const {
        return verify(candidates);
    }
};

/// @brief Validates options.
/// @throws Error for one out of range.
inline void check(const MaskSuppression& options) {
    expect(options.max_iou >= 0 && options.max_iou <= 1, "MaskSuppression::max_iou", "0 ... 1",
           options.max_iou);
    expect(options.max_inside >= 0 && options.max_inside <= 1, "MaskSuppression::max_inside", "0 ... 1",
           options.max_inside);
}

inline std::vector<Verified> MaskSuppression::verify(const std::vector<Detection>& candidates) const {
    std::vector<RegionMask> regions;
    std::vector<std::size_t> areas;
    for (const Detection& candidate : candidates) {
        regions.push_back({candidate.segmentation.x, candidate.segmentation.y, candidate.segmentation.mask});
        areas.push_back(area_of(regions.back()));
    }
    std::vector<Verified> kept =
        detail::strongest_of_each(candidates, [&](std::size_t stronger, std::size_t weaker) {
            return iou(candidates[stronger].box, candidates[weaker].box) > max_iou ||
                   double(intersection_area(regions[stronger], regions[weaker])) >
                       max_inside * double(std::min(areas[stronger], areas[weaker]));
        });
    if (!second_choices) return kept;
    std::vector<bool> told(candidates.size(), false);
    for (const Verified& choice : kept) told[choice.index] = true;
    const std::size_t first_choices = kept.size();
    for (std::size_t k = 0; k < first_choices; ++k)
        for (std::size_t i = 0; i < candidates.size(); ++i)
            if (!told[i] && regions[i] == regions[kept[k].index]) {
                kept.push_back({i, candidates[i].score * std::exp(-1.0)});
                told[i] = true;
            }
    return kept;
}

}  // namespace ism
