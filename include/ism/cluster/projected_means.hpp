// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

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
        : numbers_(start.size() * projected_dimension),
          sq_length_(start.size()),
          whole_(start.dimension <= projected_dimension) {
        const std::size_t count = start.size(), dimension = start.dimension;
        std::vector<double> middle(dimension, 0.0);
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t k = 0; k < dimension; ++k)
                middle[k] += double(start.means[i * dimension + k]) / double(count);
        const auto centre = [&](std::size_t i, float* centred) {
            for (std::size_t k = 0; k < dimension; ++k)
                centred[k] = start.means[i * dimension + k] - float(middle[k]);
        };

        const std::size_t sample = whole_ ? 0 : std::min<std::size_t>((count + 3) / 4, 128);
        std::vector<float> points(sample * dimension);
        for (std::size_t s = 0; s < sample; ++s) centre(s * count / sample, points.data() + s * dimension);
        const RowMatrix directions =
            principal_directions(points, dimension, whole_ ? 0 : projected_dimension - 1);

        constexpr std::size_t block = 256;
        pool.for_each((count + block - 1) / block, [&](std::size_t part, unsigned /*worker*/) {
            std::vector<float> centred(dimension);
            std::vector<double> along(directions.columns());
            for (std::size_t i = part * block; i < std::min(count, (part + 1) * block); ++i) {
                centre(i, centred.data());
                float* projected = numbers_.data() + i * projected_dimension;
                directions.weigh(centred.data(), 1, along);
                for (std::size_t c = 0; c < along.size(); ++c) projected[c] = float(along[c]);
                if (whole_) std::copy(centred.begin(), centred.end(), projected);
                double square = 0;
                for (const float value : centred) square += double(value) * value;
                sq_length_[i] = square;
                measure_across(i);
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
        order_spatially({numbers_.data(), numbers_.size()}, projected_dimension, tile_rows * tile_columns,
                        order);
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
