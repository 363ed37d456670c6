// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/order.hpp"

namespace ism {

/// @brief Which cluster every point belongs to. Clusters are numbered by their first point.
struct Clustering {
    std::vector<std::uint32_t> label;  ///< cluster of each point
    std::uint32_t count = 0;           ///< number of clusters
};

/// @brief Two clusters that became one. Clusters 0 … points − 1 are the points themselves, cluster points + t
/// is what merge t made (as in the linkage matrices of R, MATLAB and SciPy).
struct Merge {
    std::uint32_t first = 0, second = 0;  ///< first < second
    std::uint32_t size = 0;               ///< points in the new cluster
    double sq_distance = 0;               ///< between the two, never less than of the merges that made them
    [[nodiscard]] bool operator==(const Merge&) const = default;
};

/// @brief The merges of an agglomerative clustering, the nearest clusters first: a dendrogram, or its lower
/// part. cut() gives the clusters at any threshold.
struct MergeTrace {
    std::uint32_t points = 0;
    std::vector<Merge> merges;
    double max_sq_distance = std::numeric_limits<double>::infinity();  ///< merges up to here are all known
};

/// @brief The clusters that are left where only clusters no further apart than `max_sq_distance` merge.
/// @throws Error for a threshold that is negative, NaN or beyond what the trace knows.
[[nodiscard]] inline Clustering cut(const MergeTrace& trace, double max_sq_distance) {
    expect(max_sq_distance >= 0 && max_sq_distance <= trace.max_sq_distance, "cut: largest squared distance",
           lazy_text("0 to ", trace.max_sq_distance), max_sq_distance);
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    const std::size_t points = trace.points;
    std::vector<std::uint32_t> parent(points + trace.merges.size(), none);
    for (std::size_t t = 0; t < trace.merges.size() && trace.merges[t].sq_distance <= max_sq_distance; ++t)
        parent[trace.merges[t].first] = parent[trace.merges[t].second] = std::uint32_t(points + t);
    // a cluster's parent comes after it, so that going backwards meets every root before what hangs from it
    std::vector<std::uint32_t> root(parent.size());
    for (std::size_t i = parent.size(); i-- > 0;)
        root[i] = parent[i] == none ? std::uint32_t(i) : root[parent[i]];

    Clustering result;
    result.label.resize(points);
    std::vector<std::uint32_t> number(parent.size(), none);
    for (std::size_t i = 0; i < points; ++i) {
        if (number[root[i]] == none) number[root[i]] = result.count++;
        result.label[i] = number[root[i]];
    }
    return result;
}

namespace detail {

/// Brings merges that were made in any order, children before parents, into the order of their distances, of
/// equal ones of their sizes and then first points: whatever order they were made in, the result is the same.
/// Rounding may leave a merge a hair nearer than one that made its clusters: it then gets that one's.
inline void sort_merges(MergeTrace& trace) {
    std::vector<Merge>& merges = trace.merges;
    std::vector<std::uint32_t> first_point(merges.size()), order(merges.size()), renamed(merges.size());
    for (std::size_t t = 0; t < merges.size(); ++t) {
        first_point[t] = trace.points;
        for (const std::uint32_t part : {merges[t].first, merges[t].second}) {
            const bool point = part < trace.points;
            first_point[t] = std::min(first_point[t], point ? part : first_point[part - trace.points]);
            if (!point)
                merges[t].sq_distance =
                    std::max(merges[t].sq_distance, merges[part - trace.points].sq_distance);
        }
    }
    std::iota(order.begin(), order.end(), 0u);
    // a merge is larger than those that made its clusters
    sort_by(order, [&](std::uint32_t t) { return joined(merges[t].size, first_point[t]); });
    sort_by(order, [&](std::uint32_t t) { return rising(merges[t].sq_distance); });
    std::vector<Merge> sorted;
    sorted.reserve(merges.size());
    for (const std::uint32_t t : order) {
        renamed[t] = trace.points + std::uint32_t(sorted.size());
        Merge merge = merges[t];
        for (std::uint32_t* part : {&merge.first, &merge.second})
            if (*part >= trace.points) *part = renamed[*part - trace.points];
        if (merge.first > merge.second) std::swap(merge.first, merge.second);
        sorted.push_back(merge);
    }
    merges = std::move(sorted);
}

}  // namespace detail

}  // namespace ism
