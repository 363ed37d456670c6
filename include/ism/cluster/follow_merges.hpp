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

#include "ism/cluster/live_clusters.hpp"
#include "ism/cluster/near_lists.hpp"

namespace ism::detail {

/// What became of clusters.
struct MergedClusters {
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    explicit MergedClusters(std::size_t count) : now(count), partner(count, none) {
        std::iota(now.begin(), now.end(), 0u);
    }
    /// Whether the cluster, of before the round, merged in this round.
    [[nodiscard]] bool merged(std::uint32_t i) const { return partner[now[i]] != none; }

    std::vector<std::uint32_t> now;      ///< where a cluster went when it last merged; itself where it stayed
    std::vector<std::uint32_t> partner;  ///< the one that came to it in this round
};

/// Brings the list of a cluster up to date with the merges of a round. What was not on it stays beyond its
/// reach, for the distance to a merged cluster is the mean of those to its parts, weighed by their sizes. For
/// the same reason a merged cluster's list holds what was on that of either part, and its reach is the mean.
inline void follow(std::uint32_t i, const MergedClusters& clusters, const LiveClusters& live,
                   NearLists& lists) {
    const std::span<const Near> own = lists.of(i);
    const bool changed = clusters.merged(i);
    if (!changed &&
        std::none_of(own.begin(), own.end(), [&](const Near& n) { return clusters.merged(n.cluster); }))
        return;
    std::array<Near, 2 * NearLists::capacity> old;
    auto end = std::copy(own.begin(), own.end(), old.begin());
    double reach = lists.reach(i);
    if (changed) {
        const std::uint32_t gone = clusters.partner[i];
        end = std::copy(lists.of(gone).begin(), lists.of(gone).end(), end);
        const double share = double(live.points_of(gone)) / live.points_of(i);
        reach += share * (lists.reach(gone) - reach);
    }
    lists.clear(i, float(reach));
    for (auto at = old.begin(); at != end; ++at) {
        const bool again = changed || clusters.merged(at->cluster);
        const std::uint32_t c = at->cluster = clusters.now[at->cluster];
        const auto listed = [&] {
            return std::any_of(old.begin(), at, [&](const Near& n) { return n.cluster == c; });
        };
        if (c != i && !(again && listed()))
            lists.insert(i, {again ? live.sq_distance(i, c) : at->sq_distance, c});
    }
}

}  // namespace ism::detail
