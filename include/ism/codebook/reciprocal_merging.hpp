// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "ism/codebook/cluster_moments.hpp"
#include "ism/codebook/live_clusters.hpp"
#include "ism/codebook/merge_trace.hpp"
#include "ism/codebook/near_lists.hpp"
#include "ism/codebook/near_search.hpp"
#include "ism/core/parallel.hpp"

namespace ism::detail {

/// Average link by merging all reciprocal nearest neighbours of a round at once.
///
/// Each cluster has a list of near ones that is complete up to some reach. A merge never brings clusters
/// nearer to others than the nearer of the two was, so lists stay complete when clusters on them or beyond
/// them merge, and the list of a merged cluster follows from those of its two. Only when nothing is left on
/// a list, all clusters are searched again.
class ReciprocalMerging {
public:
    ReciprocalMerging(const ClusterMoments& start, double max_sq_distance, unsigned threads)
        : team_(threads),
          live_(start, team_),
          lists_(start.size(), limit_of(max_sq_distance)),
          now_(start.size()),
          partner_(start.size(), none),
          node_(start.size()) {
        std::iota(now_.begin(), now_.end(), 0u);
        node_ = now_;
        alive_ = live_.spatial_order();
        trace_.points = std::uint32_t(start.size());
        trace_.max_sq_distance = max_sq_distance;
    }

    [[nodiscard]] MergeTrace run() && {
        search(alive_, {});
        while (keep_those_with_neighbours()) {
            merge_reciprocal();
            follow_merges();
            search_again();
        }
        sort_merges(trace_);
        std::erase_if(trace_.merges, [&](const Merge& m) { return m.sq_distance > trace_.max_sq_distance; });
        return std::move(trace_);
    }

private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    /// A bit more than asked, so that what a merge decides in double is not lost by rounding here.
    [[nodiscard]] static float limit_of(double max_sq_distance) {
        constexpr float most = std::numeric_limits<float>::max();
        if (max_sq_distance >= 0.5 * double(most)) return most;
        return std::nextafter(float(max_sq_distance * (1 + 1e-6)), most);
    }

    [[nodiscard]] std::uint32_t nearest(std::uint32_t i) const {
        return lists_.of(i).empty() ? none : lists_.of(i).front().cluster;
    }

    void search(std::span<const std::uint32_t> asking, std::span<const std::uint32_t> others) {
        NearSearch(live_, lists_, asking, others).run(team_);
    }

    /// Clusters without a neighbour within reach are final: merging others never brings them nearer.
    bool keep_those_with_neighbours() {
        std::erase_if(alive_, [&](std::uint32_t i) { return lists_.of(i).empty(); });
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
                    return lists_.of(a).front().sq_distance < lists_.of(b).front().sq_distance;
                });
            pairs_.emplace_back(std::minmax(i, nearest(i)));
        }
        const std::size_t made = trace_.merges.size();
        trace_.merges.resize(made + pairs_.size());
        team_.each(pairs_.size(), [&](std::size_t p, unsigned /*worker*/) {
            const auto [kept, gone] = pairs_[p];
            Merge& merge = trace_.merges[made + p];
            merge = {node_[kept], node_[gone], 0, live_.merge(kept, gone)};
            merge.size = live_.points_of(kept);
            node_[kept] = trace_.points + std::uint32_t(made + p);
            now_[gone] = kept;
            partner_[kept] = gone;
        });
        std::erase_if(alive_, [&](std::uint32_t i) { return now_[i] != i; });
    }

    /// Brings all lists up to date with the merges of the round.
    void follow_merges() {
        constexpr std::size_t part = 64;
        team_.each((alive_.size() + part - 1) / part, [&](std::size_t p, unsigned /*worker*/) {
            for (std::size_t a = p * part; a < std::min(alive_.size(), (p + 1) * part); ++a)
                follow(alive_[a]);
        });
        for (const auto& [kept, gone] : pairs_) partner_[kept] = none;
    }

    void follow(std::uint32_t i) {
        const auto merged = [&](std::uint32_t c) { return partner_[now_[c]] != none; };
        const std::span<const Near> own = lists_.of(i);
        if (!merged(i) &&
            std::none_of(own.begin(), own.end(), [&](const Near& n) { return merged(n.cluster); }))
            return;
        std::array<Near, 2 * NearLists::capacity> old;
        auto end = std::copy(own.begin(), own.end(), old.begin());
        double reach = lists_.reach(i);
        if (const std::uint32_t gone = partner_[i]; gone != none) {
            end = std::copy(lists_.of(gone).begin(), lists_.of(gone).end(), end);
            // its distance to any other is the mean of theirs, weighed by their sizes
            const double share = double(live_.points_of(gone)) / live_.points_of(i);
            reach += share * (lists_.reach(gone) - reach);
        }
        lists_.clear(i, float(reach));
        for (auto at = old.begin(); at != end; ++at) {
            const std::uint32_t c = now_[at->cluster];
            const bool again = merged(i) || merged(at->cluster);
            at->cluster = c;
            if (c == i ||
                (again && std::any_of(old.begin(), at, [&](const Near& n) { return n.cluster == c; })))
                continue;
            lists_.insert(i, {again ? live_.sq_distance(i, c) : at->sq_distance, c});
        }
    }

    void search_again() {
        std::vector<std::uint32_t> asking, others;
        for (const std::uint32_t i : alive_) (lists_.sure(i) ? others : asking).push_back(i);
        for (const std::uint32_t i : asking) lists_.clear(i, std::numeric_limits<float>::max());
        if (!asking.empty()) search(asking, others);
    }

    Team team_;
    LiveClusters live_;
    NearLists lists_;
    std::vector<std::uint32_t> alive_, now_, partner_, node_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;
    MergeTrace trace_;
};

}  // namespace ism::detail
