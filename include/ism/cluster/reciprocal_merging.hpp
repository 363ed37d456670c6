// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "ism/cluster/active_clusters.hpp"
#include "ism/cluster/cluster_moments.hpp"
#include "ism/cluster/merge_trace.hpp"
#include "ism/cluster/neighbour_lists.hpp"
#include "ism/cluster/neighbour_search.hpp"
#include "ism/cluster/update_neighbours.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/order.hpp"
#include "ism/core/processor.hpp"
#include "ism/core/thread_pool.hpp"

namespace ism::detail {

/// Average link by merging all reciprocal nearest neighbours of a round at once.
///
/// Each cluster has a list of near ones that is complete within some radius. A merge never brings clusters
/// nearer to others than the nearer of the two was, so lists stay complete when clusters merge, and a merged
/// cluster's list follows from those of its two. Only where nothing is left on a list, all are searched.
class ReciprocalMerging {
public:
    /// The first `settled` clusters are known to lie further apart than `max_sq_distance`.
    ReciprocalMerging(const ClusterMoments& start, double max_sq_distance, std::size_t settled,
                      ThreadPool& pool, InstructionSet isa = best_instruction_set())
        : pool_(pool),
          settled_(settled),
          clusters_(start, pool_, isa),
          lists_(start.size(), NeighbourLists::limit_of(max_sq_distance)),
          merged_(start.size()),
          alive_(clusters_.spatial_order()),
          node_(merged_.merged_into) {
        trace_.points = std::uint32_t(start.size());
        trace_.max_sq_distance = max_sq_distance;
    }

    [[nodiscard]] MergeTrace run() && {
        merge_equal();
        sort_by(alive_, [&](std::uint32_t i) { return std::uint64_t(i < settled_); });
        const auto settled =
            std::count_if(alive_.begin(), alive_.end(), [&](std::uint32_t i) { return i < settled_; });
        NeighbourSearch(clusters_, lists_, alive_, {}, std::size_t(settled)).run(pool_);
        while (keep_those_with_neighbours()) {
            merge_reciprocal();
            update_all_neighbours();
            search_again();
        }
        sort_merges(trace_);
        drop_if(trace_.merges, [&](const Merge& m) { return m.sq_distance > trace_.max_sq_distance; });
        return std::move(trace_);
    }

private:
    [[nodiscard]] std::uint32_t nearest(std::uint32_t i) const {
        return lists_.of(i).empty() ? MergedClusters::none : lists_.of(i).front().cluster;
    }

    /// Merges equal points before any search: many of them would fill each other's lists in every round.
    void merge_equal() {
        std::vector<Ranked> order;
        for (const std::uint32_t i : alive_) order.push_back({clusters_.fingerprint(i), i});
        sort_ranked(order.data(), order.size());
        for (std::size_t first = 0, at = 1; at < order.size(); ++at) {
            const std::uint32_t kept = order[first].index, gone = order[at].index;
            if (order[first].key != order[at].key || !clusters_.equal(kept, gone)) {
                first = at;
                continue;
            }
            trace_.merges.emplace_back();
            merge(trace_.merges.size() - 1, kept, gone);
        }
        forget_gone();
    }

    /// Clusters without a neighbour on their lists are final: merging others never brings them nearer.
    bool keep_those_with_neighbours() {
        drop_if(alive_, [&](std::uint32_t i) { return lists_.of(i).empty(); });
        return !alive_.empty();
    }

    void merge_reciprocal() {
        pairs_.clear();
        for (const std::uint32_t i : alive_)
            if (const std::uint32_t j = nearest(i); i < j && nearest(j) == i) pairs_.emplace_back(i, j);
        if (pairs_.empty()) {
            // rounding took the pair away that must be there: the nearest two
            const std::uint32_t i =
                *std::min_element(alive_.begin(), alive_.end(), [&](std::uint32_t a, std::uint32_t b) {
                    const float of_a = lists_.of(a).front().sq_distance,
                                of_b = lists_.of(b).front().sq_distance;
                    return of_a < of_b || (of_a == of_b && a < b);
                });
            pairs_.emplace_back(std::minmax(i, nearest(i)));
        }
        const std::size_t made = trace_.merges.size();
        trace_.merges.resize(made + pairs_.size());
        pool_.for_each(pairs_.size(), [&](std::size_t p, unsigned /*worker*/) {
            const auto [kept, gone] = pairs_[p];
            merge(made + p, kept, gone);
            merged_.partner[kept] = gone;
        });
        forget_gone();
    }

    /// Merge number t.
    void merge(std::size_t t, std::uint32_t kept, std::uint32_t gone) {
        const double sq_distance = clusters_.merge(kept, gone);
        trace_.merges[t] = {node_[kept], node_[gone], clusters_.points_of(kept), sq_distance};
        node_[kept] = trace_.points + std::uint32_t(t);
        merged_.merged_into[gone] = kept;
    }

    void forget_gone() {
        drop_if(alive_, [&](std::uint32_t i) { return merged_.merged_into[i] != i; });
    }

    /// Brings all lists up to date with the merges of the round.
    void update_all_neighbours() {
        constexpr std::size_t part = 64;
        pool_.for_each((alive_.size() + part - 1) / part, [&](std::size_t p, unsigned /*worker*/) {
            for (std::size_t a = p * part; a < std::min(alive_.size(), (p + 1) * part); ++a)
                update_neighbours(alive_[a], merged_, clusters_, lists_);
        });
        for (const auto& [kept, gone] : pairs_) merged_.partner[kept] = MergedClusters::none;
    }

    void search_again() {
        std::vector<std::uint32_t> asking, others;
        for (const std::uint32_t i : alive_) (lists_.is_exact(i) ? others : asking).push_back(i);
        for (const std::uint32_t i : asking) lists_.clear(i, std::numeric_limits<float>::max());
        if (!asking.empty()) NeighbourSearch(clusters_, lists_, asking, others).run(pool_);
    }

    ThreadPool& pool_;
    std::size_t settled_;
    ActiveClusters clusters_;
    NeighbourLists lists_;
    MergedClusters merged_;
    std::vector<std::uint32_t> alive_;
    std::vector<std::uint32_t> node_;  // of each cluster in the trace
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;
    MergeTrace trace_;
};

}  // namespace ism::detail
