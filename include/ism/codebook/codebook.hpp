// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ism/feature/feature.hpp"

namespace ism {

/// @brief Visual words: the means of clusters of descriptors. The distance of a descriptor to a word is that
/// of the clustering: the mean squared distance to the descriptors the word stands for, |d|² + mean_sq_length
/// − 2 d·mean. In a joint codebook all words belong to group 0; in a codebook of one part a class, a word's
/// group is its class.
/// @tparam Scalar  float, or bytes for descriptors of bytes: see in_bytes()
template <std::size_t Dimension, DescriptorScalar Scalar = float>
struct Codebook {
    Descriptors<Scalar, Dimension> words;  ///< one row a word, in the units of the descriptor
    std::vector<float> mean_sq_length;  ///< of each word: mean of |d|² over the descriptors d it stands for
    std::vector<std::uint32_t> group;   ///< of each word
    double max_sq_distance = 0;         ///< a descriptor matches every word no further away
    std::vector<std::uint32_t> sizes = {};  ///< descriptors each word stands for

    [[nodiscard]] std::size_t size() const { return words.size(); }
};

/// @brief A word that a feature looks like.
struct Match {
    std::uint32_t feature = 0;
    std::uint32_t word = 0;
    float weight = 0;      ///< p(word | feature) = 1 / number of words of the group that the feature matches
    bool nearest = false;  ///< no other word of the group is nearer
    [[nodiscard]] bool operator==(const Match&) const = default;
};

/// @brief Which words of a feature cast votes.
enum class MatchMode {
    all,      ///< every word within the threshold (soft matching)
    nearest,  ///< only the nearest of each group, if within the threshold
};

}  // namespace ism
