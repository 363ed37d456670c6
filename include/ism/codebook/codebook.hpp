// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/codebook/growing_clusters.hpp"
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

namespace detail {

/// One more word: cluster c.
template <std::size_t Dimension>
void add_word(Codebook<Dimension>& codebook, const Clusters& clusters, std::size_t c, std::uint32_t group) {
    codebook.words.push_back(
        std::span<const float, Dimension>(clusters.means.data() + c * Dimension, Dimension));
    codebook.mean_sq_length.push_back(clusters.mean_sq_lengths[c]);
    codebook.sizes.push_back(clusters.sizes[c]);
    codebook.group.push_back(group);
}

}  // namespace detail

/// @brief Clusters descriptors into words and drops words of fewer than `min_cluster_size` descriptors
/// (T_Q + 1 in the paper).
/// @throws Error where no word is left.
template <std::size_t Dimension>
[[nodiscard]] Codebook<Dimension> build_codebook(const Descriptors<float, Dimension>& descriptors,
                                                 double max_sq_distance, std::size_t min_cluster_size,
                                                 std::uint32_t group = 0, unsigned threads = 0) {
    const Clusters points{.dimension = Dimension};
    const auto [clusters, clustering] = add_points(points, descriptors.values(), max_sq_distance, threads);
    Codebook<Dimension> codebook{
        .words = {}, .mean_sq_length = {}, .group = {}, .max_sq_distance = max_sq_distance};
    std::uint32_t largest = 0;
    for (std::size_t c = 0; c < clusters.size(); ++c) {
        largest = std::max(largest, clusters.sizes[c]);
        if (clusters.sizes[c] >= min_cluster_size) detail::add_word(codebook, clusters, c, group);
    }
    expect(codebook.size() > 0, "codebook",
           join_text("a cluster of at least ", min_cluster_size, " features"),
           join_text("at most ", largest, " together among ", descriptors.size(), " features"));
    return codebook;
}

}  // namespace ism
