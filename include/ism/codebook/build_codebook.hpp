// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "ism/cluster/growing_clusters.hpp"
#include "ism/codebook/codebook.hpp"
#include "ism/core/error.hpp"

namespace ism {

/// @brief Clusters descriptors (average link) and adds a word to the codebook for each cluster of at least
/// `min_cluster_size` descriptors (T_Q + 1 in the paper). Clusters and words use the codebook's threshold.
/// @throws Error where no word was added, or the descriptors are of another dimension.
inline void add_words(Codebook& codebook, const Descriptors<float>& descriptors, std::size_t min_cluster_size,
                      std::uint32_t group = 0, unsigned threads = 0) {
    const std::size_t dimension = codebook.dimension(), before = codebook.size();
    expect(descriptors.dimension() == dimension, "codebook: dimension of descriptors", dimension,
           descriptors.dimension());
    const auto [clusters, clustering] = add_points(Clusters{.dimension = dimension}, descriptors.values(),
                                                   codebook.max_sq_distance(), threads);
    std::uint32_t largest = 0;
    for (std::size_t c = 0; c < clusters.size(); ++c) {
        largest = std::max(largest, clusters.sizes[c]);
        if (clusters.sizes[c] >= min_cluster_size)
            codebook.push_back({.mean = std::span(clusters.means).subspan(c * dimension, dimension),
                                .mean_sq_length = clusters.mean_sq_lengths[c],
                                .size = clusters.sizes[c],
                                .group = group});
    }
    expect(codebook.size() > before, "codebook",
           lazy_text("a cluster of at least ", min_cluster_size, " features"),
           lazy_text("at most ", largest, " together among ", descriptors.size(), " features"));
}

/// @brief A codebook of descriptors: see add_words().
[[nodiscard]] inline Codebook build_codebook(const Descriptors<float>& descriptors, double max_sq_distance,
                                             std::size_t min_cluster_size, unsigned threads = 0) {
    Codebook codebook(descriptors.dimension(), max_sq_distance);
    add_words(codebook, descriptors, min_cluster_size, 0, threads);
    return codebook;
}

}  // namespace ism
