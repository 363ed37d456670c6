// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ism/cluster/cluster_moments.hpp"
#include "ism/cluster/projected_means.hpp"
#include "ism/cluster/pruning.hpp"
#include "ism/core/aligned.hpp"
#include "ism/core/processor.hpp"
#include "ism/core/thread_pool.hpp"

namespace ism::detail {

/// The clusters of an agglomeration. A cluster is told by its size, its mean and its spread, the mean squared
/// distance of its points to the mean; the mean over all pairs |x − y|² = spread(X) + spread(Y) +
/// |mean(X) − mean(Y)|², which unlike a form with dot products loses no digits. A merged cluster takes the
/// place of one of the two.
class ActiveClusters {
public:
    ActiveClusters(const ClusterMoments& start, ThreadPool& pool, InstructionSet isa = best_instruction_set())
        : stride_((start.dimension + 7) / 8 * 8),
          means_(start.size() * stride_),
          spread_(start.size(), 0.0),
          size_(start.size(), 1),
          projected_(start, pool),
          kernels_(isa) {
        if (!start.sizes.empty()) size_.assign(start.sizes.begin(), start.sizes.end());
        for (std::size_t i = 0; i < start.size(); ++i) {
            const auto from = start.means.subspan(i * start.dimension, start.dimension);
            std::copy(from.begin(), from.end(), mean(i));
            if (start.mean_sq_lengths.empty()) continue;
            double square = 0;
            for (const float value : from) square += double(value) * value;
            // in float, so that a single point has none
            spread_[i] = std::max(0.0f, start.mean_sq_lengths[i] - float(square));
        }
    }

    [[nodiscard]] std::size_t size() const { return size_.size(); }
    [[nodiscard]] std::uint32_t points_of(std::size_t i) const { return size_[i]; }
    [[nodiscard]] const DistanceKernels& kernels() const { return kernels_; }
    [[nodiscard]] const float* projected(std::size_t i) const { return projected_.of(i); }
    [[nodiscard]] float half_sq_norm(std::size_t i) const { return projected_.half_sq_norm(i, spread_[i]); }
    [[nodiscard]] std::vector<std::uint32_t> spatial_order() const { return projected_.spatial_order(); }

    /// The mean squared distance between the points of two clusters; the same for (i, j) and (j, i), and the
    /// same bits for every instruction set.
    [[nodiscard]] float sq_distance(std::size_t i, std::size_t j) const {
        return kernels_.sq_difference(mean(i), mean(j), stride_) + float(spread_[i] + spread_[j]);
    }

    /// At most sq_distance(), and hardly less; faster.
    [[nodiscard]] float sq_distance_bound(std::size_t i, std::size_t j) const {
        const float rough =
            kernels_.rough_sq_difference(mean(i), mean(j), stride_) + float(spread_[i] + spread_[j]);
        return rough * (1 - rough_error(stride_)) - float(stride_) * 0x1p-126f;
    }

    /// Whether two clusters are one and the same point, however often.
    [[nodiscard]] bool equal(std::size_t i, std::size_t j) const {
        return spread_[i] == 0 && spread_[j] == 0 && std::equal(mean(i), mean(i) + stride_, mean(j));
    }

    /// A number that is the same for equal clusters, and hardly ever for others.
    [[nodiscard]] std::uint64_t fingerprint(std::size_t i) const {
        std::uint64_t key = 0;
        for (std::size_t k = 0; k < stride_; ++k)
            key = (key ^ (key >> 29) ^ std::bit_cast<std::uint32_t>(mean(i)[k] + 0.0f)) * 0x9e3779b97f4a7c15u;
        return key;
    }

    /// Puts cluster `gone` into cluster `kept`.
    /// @return their squared distance, in double
    double merge(std::size_t kept, std::size_t gone) {
        const double n = size_[kept], m = size_[gone], share = m / (n + m);
        float* to = mean(kept);
        const float* from = mean(gone);
        double between = 0;
        for (std::size_t k = 0; k < stride_; ++k) {
            const double x = to[k], y = from[k];
            between += (x - y) * (x - y);
            to[k] = float(x + share * (y - x));
        }
        const double distance = spread_[kept] + spread_[gone] + between;
        spread_[kept] += share * (spread_[gone] - spread_[kept] + (1 - share) * between);
        size_[kept] += size_[gone];
        projected_.merge(kept, gone, share, between);
        return distance;
    }

private:
    [[nodiscard]] float* mean(std::size_t i) { return means_.data() + i * stride_; }
    [[nodiscard]] const float* mean(std::size_t i) const { return means_.data() + i * stride_; }

    std::size_t stride_;
    AlignedVector<float> means_;
    std::vector<double> spread_;
    std::vector<std::uint32_t> size_;
    ProjectedMeans projected_;
    DistanceKernels kernels_;
};

}  // namespace ism::detail
