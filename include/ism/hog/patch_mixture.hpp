// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "ism/hog/box_template.hpp"

namespace ism {

/// @brief A patch is a square of four cells that touch: so many numbers, which are reduced to so few.
inline constexpr std::size_t patch_numbers = 4 * cell_numbers, patch_axes = 32;

/// @brief What patches of boxes look like: Gaussians over the principal axes of patches (Perronnin and Dance
/// 2007). Empty = none.
struct PatchMixture {
    static constexpr std::size_t gaussians = 16;
    /// @brief Boxes are described whole and in thirds, each by means and variances: numbers of a part, of
    /// all.
    static constexpr std::size_t parts = 4, part_numbers = 2 * gaussians * patch_axes,
                                 vector_numbers = parts * part_numbers;

    std::vector<float> mean;     ///< of patches: patch_numbers
    std::vector<float> axes;     ///< patch_axes numbers for each number of a patch: its share in each axis
    std::vector<float> weights;  ///< of each Gaussian; their sum is 1
    std::vector<float> means, spreads;  ///< patch_axes numbers of each Gaussian: mean and standard deviation

    [[nodiscard]] bool empty() const { return weights.empty(); }
    [[nodiscard]] bool operator==(const PatchMixture&) const = default;
};

}  // namespace ism
