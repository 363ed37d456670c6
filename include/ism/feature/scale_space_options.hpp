// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "ism/feature/range.hpp"

namespace ism {

/// @brief How a scale space is laid out. Deviations are in pixels.
struct ScaleSpaceOptions {
    int levels_per_octave = 3;        ///< S
    float base_sigma = 1.6f;          ///< of an octave's first level, in pixels of that level
    float input_sigma = 0.5f;         ///< blur the image comes with, in its pixels
    bool double_first_octave = true;  ///< begin with the image at twice its size
    int max_octaves = 16;             ///< at most this many
    int smallest_side = 8;            ///< no octave's shorter side, in its pixels, is below this
    [[nodiscard]] bool operator==(const ScaleSpaceOptions&) const = default;
};

inline constexpr int max_scale_octaves = 32;
inline constexpr float max_input_sigma = 16;  ///< of ScaleSpaceOptions, pixels; above no level is blurred

/// @brief Validates `options`.
/// @throws Error where one is out of range.
inline void check(const ScaleSpaceOptions& options) {
    detail::expect_range("levels_per_octave", options.levels_per_octave, 1, 32);
    detail::expect_range("base_sigma (pixels)", options.base_sigma, 0.5f, 16.0f);
    detail::expect_range("input_sigma (pixels)", options.input_sigma, 0.0f, max_input_sigma);
    detail::expect_range("max_octaves", options.max_octaves, 1, max_scale_octaves);
    detail::expect_range("smallest_side (pixels)", options.smallest_side, 3, 65536);
}

namespace detail {

/// The deviation of the kernel that makes a level from the one before it, or the first level from the image,
/// doubled or not; 0 where it needs none.
[[nodiscard]] inline double missing_sigma(const ScaleSpaceOptions& options, int octave, int level) {
    if (level > 0) {
        const double octaves = 2.0 / options.levels_per_octave;
        return options.base_sigma * std::sqrt(std::exp2(level * octaves) - std::exp2((level - 1) * octaves));
    }
    if (octave > 0) return 0;
    const double have = double(options.input_sigma) * (options.double_first_octave ? 2 : 1);
    const double missing = double(options.base_sigma) * options.base_sigma - have * have;
    return missing > 1e-3 ? std::sqrt(missing) : 0;
}

}  // namespace detail

}  // namespace ism
