// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/cluster/average_link.hpp"
#include "ism/cluster/cluster_moments.hpp"
#include "ism/cluster/merge_trace.hpp"
#include "ism/core/error.hpp"
#include "ism/core/thread_pool.hpp"

namespace ism {

/// @brief Clusters with all that average link needs to know of them; see ClusterMoments.
struct Clusters {
    std::size_t dimension = 0;
    std::vector<float> means = {};            ///< clusters one after another
    std::vector<float> mean_sq_lengths = {};  ///< of each cluster
    std::vector<std::uint32_t> sizes = {};    ///< points of each cluster

    [[nodiscard]] std::size_t size() const { return sizes.size(); }
    [[nodiscard]] ClusterMoments moments() const { return {dimension, means, mean_sq_lengths, sizes}; }
};

/// @brief The clusters that a clustering makes of others, or of points.
/// @throws Error where labels do not fit.
[[nodiscard]] inline Clusters join_clusters(const ClusterMoments& parts, const Clustering& clustering) {
    expect(parts.dimension > 0, "join clusters: dimension", "1 or more", parts.dimension);
    const std::size_t dimension = parts.dimension, count = clustering.count;
    expect(clustering.label.size() == parts.size(), "join clusters: labels", parts.size(),
           clustering.label.size());
    std::vector<double> sum(count * dimension, 0.0), sq_sum(count, 0.0);
    Clusters joined{.dimension = dimension, .sizes = std::vector<std::uint32_t>(count, 0)};
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::size_t label = clustering.label[i];
        expect(label < count, "join clusters: label", lazy_text("below ", count), label);
        const std::uint32_t size = parts.sizes.empty() ? 1 : parts.sizes[i];
        double square = 0;
        for (std::size_t k = 0; k < dimension; ++k) {
            const double value = parts.means[i * dimension + k];
            sum[label * dimension + k] += size * value;
            square += value * value;
        }
        sq_sum[label] += size * (parts.mean_sq_lengths.empty() ? square : double(parts.mean_sq_lengths[i]));
        joined.sizes[label] += size;
    }
    for (std::size_t c = 0; c < count; ++c) {
        for (std::size_t k = 0; k < dimension; ++k)
            joined.means.push_back(float(sum[c * dimension + k] / joined.sizes[c]));
        joined.mean_sq_lengths.push_back(float(sq_sum[c] / joined.sizes[c]));
    }
    return joined;
}

/// @brief Clusters after points were added, and where everything went.
struct GrownClusters {
    Clusters clusters;
    Clustering clustering;  ///< new cluster of each existing cluster, then of each point added
};

/// @brief Adds points to clusters: average link from the present clusters and the points on, up to a
/// distance. With the distance always the same, the descriptors of one class after another become words
/// without the descriptors of earlier classes; that costs O(M (M + N)) for M new points and N clusters. The
/// clusters are those of a dendrogram in which the earlier points merged first, so that they depend on the
/// order of classes a little.
/// @param present  clusters that lie further apart than `max_sq_distance` from each other, as those this
/// function gave; none, of the right dimension, to begin with
/// @param values  points one after another, `present.dimension` numbers each
/// @throws Error as trace_average_link() does.
[[nodiscard]] inline GrownClusters add_points(const Clusters& present, std::span<const float> values,
                                              double max_sq_distance, ThreadPool& pool) {
    expect(present.dimension > 0 && values.size() % present.dimension == 0, "clustering: number of values",
           lazy_text("a multiple of the dimension ", present.dimension), values.size());
    Clusters all = present;
    const std::size_t points = values.size() / present.dimension;
    all.means.insert(all.means.end(), values.begin(), values.end());
    all.sizes.resize(present.size() + points, 1);
    for (std::size_t i = 0; i < points; ++i) {
        double square = 0;
        for (const float value : values.subspan(i * present.dimension, present.dimension))
            square += double(value) * value;
        all.mean_sq_lengths.push_back(float(square));
    }
    const AverageLinkOptions options{.max_sq_distance = max_sq_distance, .settled = present.size()};
    Clustering clustering = cut(trace_average_link(all.moments(), options, pool), max_sq_distance);
    Clusters clusters = join_clusters(all.moments(), clustering);
    return {std::move(clusters), std::move(clustering)};
}

/// @brief The same on `threads` threads of its own; 0 = all hardware threads.
[[nodiscard]] inline GrownClusters add_points(const Clusters& present, std::span<const float> values,
                                              double max_sq_distance, unsigned threads = 0) {
    ThreadPool pool(threads);
    return add_points(present, values, max_sq_distance, pool);
}

}  // namespace ism
