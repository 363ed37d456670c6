// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/feature/feature.hpp"

namespace ism {

/// @brief A visual word: a cluster of descriptors.
struct Word {
    std::span<const float> mean;  ///< in the units of the descriptor
    float mean_sq_length = 0;     ///< mean of |d|² over the descriptors d of the cluster
    std::uint32_t size = 1;       ///< number of these descriptors
    std::uint32_t group = 0;      ///< 0 in a joint codebook, the class in a codebook of words a class
};

/// @brief Visual words. The distance of a descriptor d to a word is that of the clustering: the mean squared
/// distance to the descriptors the word stands for, |d|² + mean_sq_length − 2 d·mean.
class Codebook {
public:
    Codebook() = default;
    /// @param dimension        numbers of a descriptor
    /// @param max_sq_distance  a descriptor matches every word no further away
    Codebook(std::size_t dimension, double max_sq_distance)
        : max_sq_distance_(max_sq_distance), means_(dimension) {}

    [[nodiscard]] std::size_t size() const { return sizes_.size(); }
    [[nodiscard]] bool empty() const { return sizes_.empty(); }
    [[nodiscard]] std::size_t dimension() const { return means_.dimension(); }
    [[nodiscard]] double max_sq_distance() const { return max_sq_distance_; }

    [[nodiscard]] Word operator[](std::size_t word) const {
        return {means_.row(word), mean_sq_lengths_[word], sizes_[word], groups_[word]};
    }
    /// @throws Error for a mean of another dimension.
    void push_back(const Word& word) {
        means_.push_back(word.mean);
        mean_sq_lengths_.push_back(word.mean_sq_length);
        sizes_.push_back(word.size);
        groups_.push_back(word.group);
    }

    /// @brief A word that stands for this descriptor alone.
    void push_back_descriptor(std::span<const float> descriptor) {
        double sq_length = 0;
        for (const float number : descriptor) sq_length += double(number) * number;
        push_back({descriptor, static_cast<float>(sq_length)});
    }

    /// @brief The means of all words, and what else is known of each: a list as long as there are words.
    [[nodiscard]] const Descriptors<float>& means() const { return means_; }
    [[nodiscard]] const std::vector<float>& mean_sq_lengths() const { return mean_sq_lengths_; }
    [[nodiscard]] const std::vector<std::uint32_t>& sizes() const { return sizes_; }
    [[nodiscard]] const std::vector<std::uint32_t>& groups() const { return groups_; }

    /// @brief A codebook of some of the words, in the order given.
    [[nodiscard]] Codebook select(const std::vector<std::uint32_t>& words) const {
        Codebook selected(dimension(), max_sq_distance_);
        for (const std::uint32_t word : words) selected.push_back((*this)[word]);
        return selected;
    }

private:
    double max_sq_distance_ = 0;
    Descriptors<float> means_;
    std::vector<float> mean_sq_lengths_;
    std::vector<std::uint32_t> sizes_, groups_;
};

/// @brief A word that a feature looks like.
struct Match {
    std::uint32_t feature = 0;
    std::uint32_t word = 0;
    float weight = 0;      ///< p(word | feature) = 1 / number of words of the group that the feature matches
    bool nearest = false;  ///< no other word of the group is nearer
    [[nodiscard]] bool operator==(const Match&) const = default;
};

}  // namespace ism
