// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "ism/cluster/average_link.hpp"
#include "ism/cluster/merge_trace.hpp"
#include "ism/core/thread_pool.hpp"

namespace ism {

/// @brief The clusters of trace_average_link() from single points, stopped where the nearest clusters lie
/// further apart than `max_sq_distance`.
/// @param values  N points one after another, `dimension` numbers each
/// @throws Error for an empty dimension, numbers that are not finite, or a threshold that is negative or NaN.
[[nodiscard]] inline Clustering cluster_average_link(std::span<const float> values, std::size_t dimension,
                                                     double max_sq_distance, ThreadPool& pool) {
    const ClusterMoments points{.dimension = dimension, .means = values, .mean_sq_lengths = {}, .sizes = {}};
    return cut(trace_average_link(points, {.max_sq_distance = max_sq_distance}, pool), max_sq_distance);
}

/// @brief The same on `threads` threads of its own; 0 = all hardware threads.
[[nodiscard]] inline Clustering cluster_average_link(std::span<const float> values, std::size_t dimension,
                                                     double max_sq_distance, unsigned threads = 0) {
    ThreadPool pool(threads);
    return cluster_average_link(values, dimension, max_sq_distance, pool);
}

}  // namespace ism
