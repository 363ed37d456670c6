// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "ism/core/error.hpp"
#include "ism/core/parallel.hpp"

namespace ism {

/// @brief Which cluster every point belongs to. Clusters are numbered by their first point.
struct Clustering {
    std::vector<std::uint32_t> label;  ///< cluster of each point
    std::uint32_t count = 0;           ///< number of clusters
};

namespace detail {

/// Clusters still alive in an average-link agglomeration, one column each. With Euclidean distances a cluster
/// is fully told by its size, its mean and the mean square length of its points:
/// mean over all pairs |x − y|² = square(X) + square(Y) − 2 mean(X)·mean(Y).
struct LiveClusters {
    Eigen::MatrixXf means;
    std::vector<float> squares;
    std::vector<float> sizes;
    std::vector<std::uint32_t> roots;  // a point of the cluster, its name in the union of points
    std::vector<std::uint32_t> nearest;
    std::vector<float> sq_distance;  // to the nearest; infinity = not searched yet
    std::size_t count = 0;

    void move(std::size_t from, std::size_t to) {
        if (from == to) return;
        const auto target = static_cast<Eigen::Index>(to);
        means.col(target) = means.col(static_cast<Eigen::Index>(from));
        squares[to] = squares[from], sizes[to] = sizes[from], roots[to] = roots[from];
        nearest[to] = nearest[from], sq_distance[to] = sq_distance[from];
    }
};

/// The nearest other cluster of each cluster named in `queries`; the lowest index where several are equal.
inline void search_nearest(LiveClusters& live, std::span<const std::uint32_t> queries, unsigned threads) {
    constexpr std::size_t rows = 64, columns = 512;
    parallel_for((queries.size() + rows - 1) / rows, threads, [&](std::size_t block) {
        const auto part = queries.subspan(block * rows, std::min(rows, queries.size() - block * rows));
        Eigen::MatrixXf wanted(live.means.rows(), static_cast<Eigen::Index>(part.size()));
        for (std::size_t q = 0; q < part.size(); ++q)
            wanted.col(static_cast<Eigen::Index>(q)) = live.means.col(part[q]);
        std::vector<float> best(part.size(), std::numeric_limits<float>::infinity());
        std::vector<std::uint32_t> best_at(part.size(), 0);
        Eigen::MatrixXf dots;
        for (std::size_t first = 0; first < live.count; first += columns) {
            const std::size_t width = std::min(columns, live.count - first);
            dots.noalias() =
                live.means.middleCols(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(width))
                    .transpose() *
                wanted;
            for (std::size_t q = 0; q < part.size(); ++q) {
                const float* dot = dots.col(static_cast<Eigen::Index>(q)).data();
                for (std::size_t j = 0; j < width; ++j) {
                    const float distance = live.squares[first + j] - 2 * dot[j];
                    if (distance < best[q] && first + j != part[q])
                        best[q] = distance, best_at[q] = static_cast<std::uint32_t>(first + j);
                }
            }
        }
        for (std::size_t q = 0; q < part.size(); ++q) {
            live.nearest[part[q]] = best_at[q];
            live.sq_distance[part[q]] = std::max(0.0f, best[q] + live.squares[part[q]]);
        }
    });
}

}  // namespace detail

/// @brief Average-link agglomerative clustering, stopped where the nearest clusters lie further apart than
/// `max_sq_distance` (mean squared Euclidean distance over all pairs of their points). All reciprocal nearest
/// neighbours of a round are merged at once, which for average link gives the same clusters as merging the
/// closest pair again and again (Benzécri 1982; Leibe, Leonardis, Schiele 2008, appendix). O(N² d) time, O(N
/// d) memory.
/// @param values  N points one after another, `dimension` numbers each
/// @throws Error for an empty dimension, numbers that are not finite, or a threshold that is negative or NaN.
[[nodiscard]] inline Clustering cluster_average_link(std::span<const float> values, std::size_t dimension,
                                                     double max_sq_distance, unsigned threads = 0) {
    expect(dimension > 0 && values.size() % dimension == 0, "clustering: number of values",
           join_text("a multiple of the dimension ", dimension), values.size());
    expect(max_sq_distance >= 0, "clustering: largest squared distance", "0 or more", max_sq_distance);
    for (const float value : values)
        expect(std::isfinite(value), "clustering: points", "finite numbers", value);

    const std::size_t points = values.size() / dimension;
    std::vector<std::uint32_t> parent(points);
    for (std::size_t i = 0; i < points; ++i) parent[i] = static_cast<std::uint32_t>(i);

    detail::LiveClusters live;
    live.means = Eigen::Map<const Eigen::MatrixXf>(values.data(), static_cast<Eigen::Index>(dimension),
                                                   static_cast<Eigen::Index>(points));
    live.count = points;
    live.sizes.assign(points, 1.0f);
    live.squares.resize(points);
    for (std::size_t i = 0; i < points; ++i)
        live.squares[i] = live.means.col(static_cast<Eigen::Index>(i)).squaredNorm();
    live.roots = parent;
    live.nearest.assign(points, 0);
    live.sq_distance.assign(points, std::numeric_limits<float>::infinity());

    std::vector<std::uint32_t> queries = parent;
    while (live.count > 1) {
        detail::search_nearest(live, queries, threads);

        // Clusters without a neighbour within reach are final: merging others never brings them nearer.
        // Those that stay are moved together, and what they point to is renamed.
        constexpr std::uint32_t gone = std::numeric_limits<std::uint32_t>::max();
        std::vector<std::uint32_t> renamed(live.count, gone);
        std::size_t kept = 0;
        for (std::size_t i = 0; i < live.count; ++i)
            if (live.sq_distance[i] <= max_sq_distance) {
                renamed[i] = static_cast<std::uint32_t>(kept);
                live.move(i, kept++);
            }
        live.count = kept;
        if (kept < 2) break;
        for (std::size_t i = 0; i < kept; ++i) live.nearest[i] = renamed[live.nearest[i]];

        // Reciprocal pairs merge. Rounding may leave none although some pair is closest: then that one
        // merges.
        std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
        std::size_t closest = 0;
        for (std::uint32_t i = 0; i < kept; ++i) {
            const std::uint32_t j = live.nearest[i];
            if (j == gone) continue;
            if (live.nearest[j] == i && i < j) pairs.emplace_back(i, j);
            if (live.sq_distance[i] < live.sq_distance[closest]) closest = i;
        }
        if (pairs.empty() && live.nearest[closest] != gone)
            pairs.emplace_back(static_cast<std::uint32_t>(closest), live.nearest[closest]);

        std::vector<bool> changed(kept, false), dead(kept, false);
        for (const auto& [i, j] : pairs) {
            const float n = live.sizes[i], m = live.sizes[j];
            live.means.col(i) = (n * live.means.col(i) + m * live.means.col(j)) / (n + m);
            live.squares[i] = (n * live.squares[i] + m * live.squares[j]) / (n + m);
            live.sizes[i] = n + m;
            parent[live.roots[j]] = live.roots[i];
            changed[i] = changed[j] = dead[j] = true;
        }
        std::fill(renamed.begin(), renamed.end(), gone);
        std::vector<bool> search_again;
        std::size_t alive = 0;
        for (std::size_t i = 0; i < kept; ++i) {
            if (dead[i]) continue;
            search_again.push_back(changed[i] || live.nearest[i] == gone || changed[live.nearest[i]]);
            renamed[i] = static_cast<std::uint32_t>(alive);
            live.move(i, alive++);
        }
        live.count = alive;
        queries.clear();
        for (std::uint32_t i = 0; i < alive; ++i) {
            if (search_again[i])
                queries.push_back(i);
            else
                live.nearest[i] = renamed[live.nearest[i]];
        }
    }

    Clustering result;
    result.label.resize(points);
    std::vector<std::uint32_t> number(points, std::numeric_limits<std::uint32_t>::max());
    for (std::uint32_t i = 0; i < points; ++i) {
        std::uint32_t root = i;
        while (parent[root] != root) root = parent[root] = parent[parent[root]];
        if (number[root] == std::numeric_limits<std::uint32_t>::max()) number[root] = result.count++;
        result.label[i] = number[root];
    }
    return result;
}

}  // namespace ism
