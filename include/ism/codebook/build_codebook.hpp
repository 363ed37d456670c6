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
           lazy_text("a cluster of at least ", min_cluster_size, " features"),
           lazy_text("at most ", largest, " together among ", descriptors.size(), " features"));
    return codebook;
}

}  // namespace ism
