// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "ism/config.hpp"
#include "ism/core/random.hpp"

namespace ism::detail {

/// Numbers in rows of one length.
class RowMatrix {
public:
    RowMatrix(std::size_t rows, std::size_t columns)
        : rows_(rows),
          columns_(columns),
          stride_((columns + lanes - 1) / lanes * lanes),
          numbers_(rows * stride_) {}

    [[nodiscard]] std::size_t rows() const { return rows_; }
    [[nodiscard]] std::size_t columns() const { return columns_; }
    [[nodiscard]] std::span<double> row(std::size_t k) { return {numbers_.data() + k * stride_, columns_}; }
    [[nodiscard]] std::span<const double> row(std::size_t k) const {
        return {numbers_.data() + k * stride_, columns_};
    }

    /// out = Σ weights[k · step] · row k, some columns after others, so that their sums stay in registers.
    template <std::floating_point T>
    void weigh(const T* weights, std::size_t step, std::span<double> out) const {
        for (std::size_t first = 0; first < columns_; first += lanes) {
            std::array<double, lanes> sums{};
            const double* numbers = numbers_.data() + first;
            for (std::size_t k = 0; k < rows_; ++k, numbers += stride_)
                for (std::size_t c = 0; c < lanes; ++c) sums[c] += double(weights[k * step]) * numbers[c];
            std::copy_n(sums.begin(), std::min(lanes, columns_ - first), out.data() + first);
        }
    }

private:
    static constexpr std::size_t lanes = 16;
    std::size_t rows_, columns_, stride_;
    std::vector<double> numbers_;
};

/// Makes columns orthonormal, one after another (Gram–Schmidt, twice against rounding): each is taken out of
/// all that follow. One that depends on those before becomes 0, which keeps every use as a projection right.
inline void make_orthonormal(RowMatrix& columns) {
    const std::size_t count = columns.columns();
    std::vector<double> before(count), along(count);
    const auto add = [](double factor, std::span<const double> row, std::span<double> to) {
        for (std::size_t c = 0; c < to.size(); ++c) to[c] += factor * row[c];
    };
    const auto length = [&](std::size_t c) {
        double sum = 0;
        for (std::size_t k = 0; k < columns.rows(); ++k) sum += columns.row(k)[c] * columns.row(k)[c];
        return std::sqrt(sum);
    };
    for (int pass = 0; pass < 2; ++pass) {
        for (std::size_t c = 0; c < count; ++c) before[c] = length(c);
        for (std::size_t c = 0; c < count; ++c) {
            const double left = length(c), factor = left > 1e-6 * before[c] ? 1 / left : 0;
            const std::span<double> others = std::span(along).subspan(c + 1);
            std::fill(others.begin(), others.end(), 0.0);
            for (std::size_t k = 0; k < columns.rows(); ++k) {
                columns.row(k)[c] *= factor;
                add(columns.row(k)[c], columns.row(k).subspan(c + 1), others);
            }
            for (std::size_t k = 0; k < columns.rows(); ++k)
                add(-columns.row(k)[c], others, columns.row(k).subspan(c + 1));
        }
    }
}

/// Σ x xᵀ over points, one after another.
[[nodiscard]] inline RowMatrix scatter_matrix(std::span<const float> points, std::size_t dimension) {
    RowMatrix rows(points.size() / dimension, dimension), scatter(dimension, dimension);
    for (std::size_t i = 0; i < rows.rows(); ++i)
        std::copy_n(points.data() + i * dimension, dimension, rows.row(i).data());
    for (std::size_t k = 0; k < dimension; ++k) rows.weigh(points.data() + k, dimension, scatter.row(k));
    return scatter;
}

/// `count` orthonormal directions near those along which the points (one after another, centred) spread most,
/// as columns: three steps of subspace iteration from a random start. How near does not matter to bounds that
/// hold for any directions.
[[nodiscard]] inline RowMatrix principal_directions(std::span<const float> points, std::size_t dimension,
                                                    std::size_t count) {
    Random random(1);
    RowMatrix directions(dimension, count), next(dimension, count);
    for (std::size_t c = 0; c < count; ++c)
        for (std::size_t k = 0; k < dimension; ++k) directions.row(k)[c] = random.uniform(-1, 1);
    const RowMatrix scatter = scatter_matrix(points, dimension);
    for (int round = 0; round < 3; ++round) {
        for (std::size_t k = 0; k < dimension; ++k) directions.weigh(scatter.row(k).data(), 1, next.row(k));
        std::swap(directions, next);
    }
    make_orthonormal(directions);
    return directions;
}

}  // namespace ism::detail
