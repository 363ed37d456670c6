// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "ism/hog/patch_mixture.hpp"

namespace ism {

/// @brief Whether a box shows an object of a class, judged by what its patches look like, wherever they lie:
/// a linear classifier of Fisher vectors for each class. Empty = none.
struct PatchClassifier {
    PatchMixture mixture = {};
    std::vector<std::vector<float>> weights = {};  ///< of each class, PatchMixture::vector_numbers
    std::vector<float> bias = {};                  ///< of each class

    [[nodiscard]] bool empty() const { return bias.empty(); }
    /// @brief Whether it has learnt a class.
    [[nodiscard]] bool knows(std::size_t class_index) const { return !weights[class_index].empty(); }
    /// @brief Above 0: rather an object of the class than none.
    /// @param vector  of FisherEncoder::encode() with the mixture
    [[nodiscard]] double margin(std::size_t class_index, std::span<const float> vector) const {
        double sum = bias[class_index];
        for (std::size_t k = 0; k < vector.size(); ++k) sum += weights[class_index][k] * vector[k];
        return sum;
    }
    [[nodiscard]] bool operator==(const PatchClassifier&) const = default;
};

}  // namespace ism
