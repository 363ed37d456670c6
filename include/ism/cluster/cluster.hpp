// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "ism/cluster/average_link.hpp"
#include "ism/cluster/merge_trace.hpp"

namespace ism {

/// @brief The clusters of trace_average_link() from single points, stopped where the nearest clusters lie
/// further apart than `max_sq_distance`.
/// @param values  N points one after another, `dimension` numbers each
/// @throws Error for an empty dimension, numbers that are not finite, or a threshold that is negative or NaN.
[[nodiscard]] inline Clustering cluster_average_link(std::span<const float> values, std::size_t dimension,
                                                     double max_sq_distance, unsigned threads = 0) {
    const ClusterMoments points{.dimension = dimension, .means = values, .mean_sq_lengths = {}, .sizes = {}};
    const AverageLinkOptions options{.max_sq_distance = max_sq_distance, .threads = threads};
    return cut(trace_average_link(points, options), max_sq_distance);
}

}  // namespace ism
