// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include <Eigen/Core>

#include "ism/codebook/cluster_moments.hpp"
#include "ism/codebook/principal_directions.hpp"
#include "ism/codebook/sieve.hpp"
#include "ism/codebook/spatial_order.hpp"
#include "ism/core/aligned.hpp"
#include "ism/core/parallel.hpp"

namespace ism::detail {

/// The clusters of an agglomeration. A cluster is told by its size, its mean and its spread, the mean squared
/// distance of its points to the mean; the mean over all pairs |x − y|² = spread(X) + spread(Y) +
/// |mean(X) − mean(Y)|², which unlike a form with dot products loses no digits. A merged cluster takes the
/// place of one of the two.
class LiveClusters {
public:
    LiveClusters(const ClusterMoments& start, Team& team)
        : stride_((start.dimension + 7) / 8 * 8),
          means_(start.size() * stride_, 0.0f),
          heads_(start.size() * sieve_depth, 0.0f),
          spread_(start.size(), 0.0),
          half_square_(start.size()),
          size_(start.size(), 1),
          whole_(start.dimension <= sieve_depth) {
        const std::size_t count = start.size(), dimension = start.dimension;
        if (!start.sizes.empty()) size_.assign(start.sizes.begin(), start.sizes.end());
        // distances stay as they are and numbers become small around the middle
        std::vector<double> middle(dimension, 0.0);
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t k = 0; k < dimension; ++k)
                middle[k] += double(start.means[i * dimension + k]) / double(count);
        team.each(count, [&](std::size_t i, unsigned /*worker*/) {
            double square = 0;
            for (std::size_t k = 0; k < dimension; ++k) {
                const double value = start.means[i * dimension + k];
                square += value * value;
                mean(i)[k] = float(value - middle[k]);
            }
            if (!start.mean_sq_lengths.empty())
                spread_[i] = std::max(0.0, double(start.mean_sq_lengths[i]) - square);
        });
        project(team);
    }

    [[nodiscard]] std::size_t size() const { return size_.size(); }
    [[nodiscard]] std::uint32_t points_of(std::size_t i) const { return size_[i]; }
    [[nodiscard]] const float* head(std::size_t i) const { return heads_.data() + i * sieve_depth; }
    [[nodiscard]] float half_square(std::size_t i) const { return half_square_[i]; }
    [[nodiscard]] const SieveKernel& kernel() const { return kernel_; }

    /// All clusters, near ones together.
    [[nodiscard]] std::vector<std::uint32_t> spatial_order() const {
        std::vector<std::uint32_t> order(size());
        std::iota(order.begin(), order.end(), 0u);
        order_spatially(heads_, sieve_depth, sieve_rows * sieve_columns, order);
        return order;
    }

    /// The mean squared distance between the points of two clusters; the same for (i, j) and (j, i).
    [[nodiscard]] float sq_distance(std::size_t i, std::size_t j) const {
        return kernel_.sq_difference(mean(i), mean(j), stride_) + float(spread_[i] + spread_[j]);
    }

    /// Puts cluster `gone` into cluster `kept`.
    /// @return their squared distance, in double
    double merge(std::size_t kept, std::size_t gone) {
        const double n = size_[kept], m = size_[gone], a = n / (n + m), b = m / (n + m);
        float* to = mean(kept);
        const float* from = mean(gone);
        double between = 0, square = 0;
        for (std::size_t k = 0; k < stride_; ++k) {
            const double x = to[k], y = from[k];
            between += (x - y) * (x - y);
            to[k] = float(a * x + b * y);
            square += double(to[k]) * to[k];
        }
        float* head = heads_.data() + kept * sieve_depth;
        const float* other = heads_.data() + gone * sieve_depth;
        for (std::size_t k = 0; k < sieve_depth; ++k) head[k] = float(a * head[k] + b * other[k]);
        const double distance = spread_[kept] + spread_[gone] + between;
        spread_[kept] = a * spread_[kept] + b * spread_[gone] + a * b * between;
        size_[kept] += size_[gone];
        finish(kept, square);
        return distance;
    }

private:
    [[nodiscard]] float* mean(std::size_t i) { return means_.data() + i * stride_; }
    [[nodiscard]] const float* mean(std::size_t i) const { return means_.data() + i * stride_; }

    /// The coordinates of all means along a few directions of large spread.
    void project(Team& team) {
        using Map = Eigen::Map<const Eigen::MatrixXf, 0, Eigen::OuterStride<>>;
        const auto stride = Eigen::Index(stride_);
        Eigen::MatrixXf directions;
        if (!whole_) {
            const std::size_t sample = std::min<std::size_t>(size(), 1024);
            Eigen::MatrixXf points(stride, Eigen::Index(sample));
            for (std::size_t s = 0; s < sample; ++s)
                points.col(Eigen::Index(s)) =
                    Eigen::Map<const Eigen::VectorXf>(mean(s * size() / sample), stride);
            directions = principal_directions(points, Eigen::Index(sieve_depth) - 1);
        }
        constexpr std::size_t block = 256;
        team.each((size() + block - 1) / block, [&](std::size_t part, unsigned /*worker*/) {
            const std::size_t first = part * block, count = std::min(block, size() - first);
            const Map points(mean(first), stride, Eigen::Index(count), Eigen::OuterStride<>(stride));
            Eigen::Map<Eigen::MatrixXf> heads(heads_.data() + first * sieve_depth, Eigen::Index(sieve_depth),
                                              Eigen::Index(count));
            if (whole_)
                heads.topRows(stride) = points;
            else
                heads.topRows(directions.cols()).noalias() = directions.transpose() * points;
            for (std::size_t i = first; i < first + count; ++i)
                finish(i, Eigen::Map<const Eigen::VectorXf>(mean(i), stride).cast<double>().squaredNorm());
        });
    }

    /// The rest of what the sieve asks of cluster i, whose mean has this squared length: the length across
    /// the directions, with which a dot product is never more than theirs along the directions and the
    /// product of these lengths (Cauchy–Schwarz). Both numbers err to the safe side by more than rounding.
    void finish(std::size_t i, double square) {
        float* numbers = heads_.data() + i * sieve_depth;
        if (!whole_) {
            double along = 0;
            for (std::size_t k = 0; k + 1 < sieve_depth; ++k) along += double(numbers[k]) * numbers[k];
            numbers[sieve_depth - 1] = float(std::sqrt(std::max(0.0, square - along) + 4e-6 * square));
        }
        half_square_[i] = float(0.5 * (1 - 1e-5) * (square + spread_[i]));
    }

    std::size_t stride_;
    AlignedVector<float> means_, heads_;
    std::vector<double> spread_;
    std::vector<float> half_square_;
    std::vector<std::uint32_t> size_;
    bool whole_;  // the sieve sees all numbers
    SieveKernel kernel_ = SieveKernel::fastest();
};

}  // namespace ism::detail
