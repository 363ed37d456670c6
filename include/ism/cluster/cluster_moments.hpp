// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "ism/core/error.hpp"

namespace ism {

/// @brief Clusters to start an agglomeration from, told by what average link of squared Euclidean distances
/// asks of them: the mean over all pairs |x − y|² = sq(X) + sq(Y) − 2 mean(X)·mean(Y), sq being the mean
/// squared length. A single point is a cluster of size 1.
struct ClusterMoments {
    std::size_t dimension = 0;
    std::span<const float> means;            ///< clusters one after another, `dimension` numbers each
    std::span<const float> mean_sq_lengths;  ///< mean |x|² of each cluster's points; empty: |mean|²
    std::span<const std::uint32_t> sizes;    ///< points of each cluster, ≥ 1; empty: 1

    [[nodiscard]] std::size_t size() const { return means.size() / dimension; }
};

/// @brief Throws Error unless all numbers are finite, sizes are 1 or more and in all below 2³², a mean square
/// is not less than the square of the mean (but for rounding), and squared distances fit into a float.
inline void check_moments(const ClusterMoments& clusters) {
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    expect(clusters.dimension > 0 && clusters.means.size() % clusters.dimension == 0,
           "clustering: number of values", lazy_text("a multiple of the dimension ", clusters.dimension),
           clusters.means.size());
    const std::size_t count = clusters.size();
    expect(count < most / 2, "clustering: number of points", lazy_text("below ", most / 2), count);
    const bool single = clusters.sizes.empty(), spreadless = clusters.mean_sq_lengths.empty();
    expect(single || clusters.sizes.size() == count, "clustering: number of sizes", count,
           clusters.sizes.size());
    expect(spreadless || clusters.mean_sq_lengths.size() == count,
           "clustering: number of mean squared lengths", count, clusters.mean_sq_lengths.size());
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < count; ++i) {
        double square = 0;
        for (const float value : clusters.means.subspan(i * clusters.dimension, clusters.dimension))
            square += double(value) * value;
        expect(std::isfinite(square), "clustering: points", "finite numbers", square);
        expect(square < 1e36, "clustering: squared length of a point", "below 1e36", square);
        if (!single) {
            expect(clusters.sizes[i] > 0, "clustering: size of a cluster", "1 or more", clusters.sizes[i]);
            total += clusters.sizes[i];
        }
        if (!spreadless) {
            const float mean_square = clusters.mean_sq_lengths[i];
            expect(mean_square < 1e36f && double(mean_square) >= square * (1 - 1e-5),
                   "clustering: mean squared length of a cluster",
                   lazy_text("at least that of its mean, ", square, ", and below 1e36"), mean_square);
        }
    }
    expect(total <= most, "clustering: points of all clusters", lazy_text("at most ", most), total);
}

}  // namespace ism
