// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "ism/cluster/active_clusters.hpp"
#include "ism/cluster/neighbour_lists.hpp"

namespace ism::detail {

/// The result of a round of merges.
struct MergedClusters {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    explicit MergedClusters(std::size_t count) : merged_into(count), partner(count, none) {
        std::iota(merged_into.begin(), merged_into.end(), 0u);
    }
    /// Whether a cluster from before the round merged in it.
    [[nodiscard]] bool merged(std::uint32_t i) const { return partner[merged_into[i]] != none; }

    std::vector<std::uint32_t>
        merged_into;  ///< the cluster that took its place when it last merged; itself where it stayed
    std::vector<std::uint32_t> partner;  ///< the one that was merged into it in this round
};

/// Brings the list of a cluster up to date with the merges of a round. What was not on it stays beyond its
/// radius, for the distance to a merged cluster is the mean of those to its parts, weighed by their sizes.
/// For the same reason a merged cluster's list holds what was on that of either part, and its radius is the
/// mean.
inline void update_neighbours(std::uint32_t i, const MergedClusters& clusters, const ActiveClusters& active,
                              NeighbourLists& lists) {
    const std::span<const Neighbour> own = lists.of(i);
    const bool changed = clusters.merged(i);
    if (!changed &&
        std::none_of(own.begin(), own.end(), [&](const Neighbour& n) { return clusters.merged(n.cluster); }))
        return;
    std::array<Neighbour, 2 * NeighbourLists::capacity> old;
    auto end = std::copy(own.begin(), own.end(), old.begin());
    double sq_radius = lists.sq_radius(i);
    if (changed) {
        const std::uint32_t gone = clusters.partner[i];
        end = std::copy(lists.of(gone).begin(), lists.of(gone).end(), end);
        const double share = double(active.points_of(gone)) / active.points_of(i);
        sq_radius += share * (lists.sq_radius(gone) - sq_radius);
    }
    lists.clear(i, float(sq_radius));
    for (auto at = old.begin(); at != end; ++at) {
        const bool again = changed || clusters.merged(at->cluster);
        const std::uint32_t c = at->cluster = clusters.merged_into[at->cluster];
        const auto listed = [&] {
            return std::any_of(old.begin(), at, [&](const Neighbour& n) { return n.cluster == c; });
        };
        if (c != i && !(again && listed()))
            lists.insert(i, {again ? active.sq_distance(i, c) : at->sq_distance, c});
    }
}

}  // namespace ism::detail
