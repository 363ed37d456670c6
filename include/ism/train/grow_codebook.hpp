// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/cluster/growing_clusters.hpp"
#include "ism/codebook/byte_codebook.hpp"
#include "ism/codebook/build_codebook.hpp"
#include "ism/core/error.hpp"

namespace ism {

/// @brief The clusters that words stand for.
/// @throws Error where a word has no size or no length.
template <std::size_t Dimension, DescriptorScalar Scalar>
[[nodiscard]] Clusters clusters_of(const Codebook<Dimension, Scalar>& codebook) {
    for (const std::size_t known : {codebook.sizes.size(), codebook.mean_sq_length.size()})
        expect(known == codebook.size(), "codebook: words whose size and length are known", codebook.size(),
               known);
    const auto values = codebook.words.values();
    return {.dimension = Dimension,
            .means = {values.begin(), values.end()},
            .mean_sq_lengths = codebook.mean_sq_length,
            .sizes = codebook.sizes};
}

/// @brief A codebook after descriptors were added, and where the words of before are in it.
template <std::size_t Dimension, DescriptorScalar Scalar>
struct GrownCodebook {
    Codebook<Dimension, Scalar> codebook;
    std::vector<std::uint32_t> word_now;  ///< of each word of before
};

/// @brief Goes on clustering from the words of a codebook, as if they were clusters (they are), with more
/// descriptors: words take in descriptors and may merge, others are made of new descriptors alone. Words of
/// before stay, however small; new ones need `min_cluster_size` descriptors. Without descriptors nothing
/// changes. Words of before come first, in their order.
/// @param present  words of one group; further apart than its threshold, as build_codebook() makes them
/// @throws Error where the words are of several groups, sizes are not known, or numbers are not finite.
template <std::size_t Dimension, DescriptorScalar Scalar>
[[nodiscard]] GrownCodebook<Dimension, Scalar> grow_codebook(const Codebook<Dimension, Scalar>& present,
                                                             const Descriptors<float, Dimension>& added,
                                                             std::size_t min_cluster_size,
                                                             unsigned threads = 0) {
    const std::uint32_t group = present.group.empty() ? 0 : present.group.front();
    for (const std::uint32_t other : present.group)
        expect(other == group, "codebook to grow: group of a word", group, other);
    const auto [clusters, clustering] =
        add_points(clusters_of(present), added.values(), present.max_sq_distance, threads);
    Codebook<Dimension> grown{
        .words = {}, .mean_sq_length = {}, .group = {}, .max_sq_distance = present.max_sq_distance};
    // Clusters are numbered as they first come up, so that those of words are the first.
    const auto word_now = std::span(clustering.label).first(present.size());
    const std::size_t kept = word_now.empty() ? 0 : 1 + *std::max_element(word_now.begin(), word_now.end());
    for (std::size_t c = 0; c < clusters.size(); ++c)
        if (c < kept || clusters.sizes[c] >= min_cluster_size) detail::add_word(grown, clusters, c, group);
    return {words_as<Scalar>(std::move(grown)), {word_now.begin(), word_now.end()}};
}

}  // namespace ism
