// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "ism/cluster/cluster_moments.hpp"
#include "ism/cluster/principal_directions.hpp"
#include "ism/cluster/pruning.hpp"
#include "ism/cluster/spatial_order.hpp"
#include "ism/core/aligned.hpp"
#include "ism/core/thread_pool.hpp"

namespace ism::detail {

/// Projections of clusters that bounds of distances are taken from: the coordinates of their means, from the
/// middle of all on, along a few directions of large spread, and the length across these. A dot product is at
/// most that of the coordinates and of the lengths across (Cauchy–Schwarz), so that half of a squared
/// distance is at least half_sq_norm + half_sq_norm − dot of the projections. Points of few dimensions are
/// taken as they are.
class ProjectedMeans {
public:
    ProjectedMeans(const ClusterMoments& start, ThreadPool& pool)
        : numbers_(start.size() * projected_dimension, 0.0f),
          sq_length_(start.size()),
          whole_(start.dimension <= projected_dimension) {
        using Eigen::Index;
        const std::size_t count = start.size(), dimension = start.dimension;
        std::vector<double> sum(dimension, 0.0);
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t k = 0; k < dimension; ++k) sum[k] += start.means[i * dimension + k];
        const Eigen::VectorXf middle =
            (Eigen::Map<Eigen::VectorXd>(sum.data(), Index(dimension)) / double(count)).cast<float>();

        const std::size_t sample = whole_ ? 0 : std::min<std::size_t>(count, 512);
        Eigen::MatrixXf points(dimension, sample);
        for (std::size_t s = 0; s < sample; ++s)
            points.col(Index(s)) = Eigen::Map<const Eigen::VectorXf>(
                                       &start.means[s * count / sample * dimension], Index(dimension)) -
                                   middle;
        const Eigen::MatrixXf directions =
            whole_ ? Eigen::MatrixXf() : principal_directions(points, Index(projected_dimension) - 1);

        constexpr std::size_t block = 256;
        pool.for_each((count + block - 1) / block, [&](std::size_t part, unsigned /*worker*/) {
            const std::size_t first = part * block, width = std::min(block, count - first);
            const Eigen::MatrixXf centred = Eigen::Map<const Eigen::MatrixXf>(&start.means[first * dimension],
                                                                              Index(dimension), Index(width))
                                                .colwise() -
                                            middle;
            Eigen::Map<Eigen::MatrixXf> projected(numbers_.data() + first * projected_dimension,
                                                  Index(projected_dimension), Index(width));
            if (whole_)
                projected.topRows(Index(dimension)) = centred;
            else
                projected.topRows(directions.cols()).noalias() = directions.transpose() * centred;
            for (std::size_t i = 0; i < width; ++i) {
                sq_length_[first + i] = centred.col(Index(i)).cast<double>().squaredNorm();
                measure_across(first + i);
            }
        });
    }

    [[nodiscard]] const float* of(std::size_t i) const { return numbers_.data() + i * projected_dimension; }

    /// Half of the mean squared length of a cluster with that spread; less by more than rounding may do, also
    /// where squares are too small for a float.
    [[nodiscard]] float half_sq_norm(std::size_t i, double spread) const {
        return float(0.5 * (1 - 1e-5) * (sq_length_[i] + spread) - 0x1p-118);
    }

    /// All clusters, near ones together.
    [[nodiscard]] std::vector<std::uint32_t> spatial_order() const {
        std::vector<std::uint32_t> order(sq_length_.size());
        std::iota(order.begin(), order.end(), 0u);
        order_spatially(numbers_, projected_dimension, tile_rows * tile_columns, order);
        return order;
    }

    /// Puts cluster `gone`, of that share of the points of both, into cluster `kept`.
    /// @param between  squared distance of the means
    void merge(std::size_t kept, std::size_t gone, double share, double between) {
        float* to = numbers_.data() + kept * projected_dimension;
        for (std::size_t k = 0; k < projected_dimension; ++k)
            to[k] = float((1 - share) * to[k] + share * of(gone)[k]);
        sq_length_[kept] = std::max(
            0.0, (1 - share) * sq_length_[kept] + share * sq_length_[gone] - share * (1 - share) * between);
        measure_across(kept);
    }

private:
    /// The length across the directions, longer by more than rounding may do.
    void measure_across(std::size_t i) {
        if (whole_) return;
        float* numbers = numbers_.data() + i * projected_dimension;
        double along = 0;
        for (std::size_t k = 0; k + 1 < projected_dimension; ++k) along += double(numbers[k]) * numbers[k];
        numbers[projected_dimension - 1] =
            float(std::sqrt(std::max(0.0, sq_length_[i] - along) + 4e-6 * sq_length_[i]));
    }

    AlignedVector<float> numbers_;
    std::vector<double> sq_length_;  // from the middle of all
    bool whole_;                     // projections are the means themselves
};

}  // namespace ism::detail
