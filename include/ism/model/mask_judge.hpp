// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "ism/depth/shape_bins.hpp"

namespace ism {

/// @brief Bins of a region's colours: 12 hues × 3 values where there is colour, 6 values of grey.
inline constexpr std::size_t color_histogram_bins = 42;

/// @brief What a region of an RGB-D image looks like: roots of shares, so that squares of a histogram add up
/// to 1. Without depth the shape is all 0; colours of a grey picture are greys.
struct MaskLook {
    std::array<float, color_histogram_bins> color{};
    ShapeHistogram shape{};
    [[nodiscard]] bool operator==(const MaskLook&) const = default;
};

/// @brief A region of a training image: a labelled object, or what was taken for one.
struct MaskExample {
    static constexpr std::uint32_t background = std::numeric_limits<std::uint32_t>::max();
    MaskLook look = {};
    std::uint32_t class_index = background;
    std::uint32_t object = background;  ///< which training object it shows; background shows none
    [[nodiscard]] bool operator==(const MaskExample&) const = default;
};

/// @brief Numbers by which a region is judged for a class: see mask_cues().
inline constexpr std::size_t vote_cue_count = 5, look_cue_count = 4 * 3, outline_cue_count = 3,
                             mask_cue_count = vote_cue_count + look_cue_count + outline_cue_count;
using MaskCues = std::array<float, mask_cue_count>;

/// @brief Whether a region shows an object of a class: examples it is compared with, and one logistic
/// regression for all classes over the cues of a class, so that a further class only adds examples.
struct MaskJudge {
    std::vector<MaskExample> examples = {};
    MaskCues mean = {}, deviation = {};  ///< of the cues in training
    MaskCues weights = {};               ///< of the cues, brought to mean 0 and deviation 1
    float bias = 0;
    float shape_bin_m = 0.04f;  ///< width of a bin of distances

    [[nodiscard]] bool empty() const { return examples.empty(); }
    [[nodiscard]] bool operator==(const MaskJudge&) const = default;

    /// @brief What each cue adds to the logit of a class.
    [[nodiscard]] MaskCues shares(const MaskCues& cues) const {
        MaskCues shares{};
        for (std::size_t i = 0; i < mask_cue_count; ++i)
            shares[i] = weights[i] * (cues[i] - mean[i]) / deviation[i];
        return shares;
    }
    /// @brief The logarithm of the odds that a region with these cues of a class shows it.
    [[nodiscard]] double logit(const MaskCues& cues) const {
        double sum = bias;
        for (const float share : shares(cues)) sum += share;
        return sum;
    }
};

}  // namespace ism
