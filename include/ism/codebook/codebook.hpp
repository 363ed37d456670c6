// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "ism/codebook/cluster.hpp"
#include "ism/core/error.hpp"
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

/// @brief Clusters descriptors into words and drops words of fewer than `min_cluster_size` descriptors
/// (T_Q + 1 in the paper).
/// @throws Error where no word is left.
template <std::size_t Dimension>
[[nodiscard]] Codebook<Dimension> build_codebook(const Descriptors<float, Dimension>& descriptors,
                                                 double max_sq_distance, std::size_t min_cluster_size,
                                                 std::uint32_t group = 0, unsigned threads = 0) {
    const Clustering clustering =
        cluster_average_link(descriptors.values(), Dimension, max_sq_distance, threads);
    std::vector<std::size_t> size(clustering.count, 0);
    std::vector<double> sq_length(clustering.count, 0);
    Descriptors<float, Dimension> means(clustering.count);
    for (std::size_t i = 0; i < descriptors.size(); ++i) {
        const std::uint32_t label = clustering.label[i];
        ++size[label];
        for (std::size_t k = 0; k < Dimension; ++k) {
            const float value = descriptors.row(i)[k];
            means.row(label)[k] += value;
            sq_length[label] += double(value) * value;
        }
    }
    Codebook<Dimension> codebook{
        .words = {}, .mean_sq_length = {}, .group = {}, .max_sq_distance = max_sq_distance};
    std::size_t largest = 0;
    for (std::uint32_t label = 0; label < clustering.count; ++label) {
        largest = std::max(largest, size[label]);
        if (size[label] < min_cluster_size) continue;
        for (float& value : means.row(label)) value /= static_cast<float>(size[label]);
        codebook.words.push_back(means.row(label));
        codebook.mean_sq_length.push_back(static_cast<float>(sq_length[label] / double(size[label])));
        codebook.group.push_back(group);
    }
    expect(codebook.size() > 0, "codebook",
           join_text("a cluster of at least ", min_cluster_size, " features"),
           join_text("at most ", largest, " together among ", descriptors.size(), " features"));
    return codebook;
}

}  // namespace ism
