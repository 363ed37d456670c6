// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "ism/config.hpp"
#include "ism/core/random.hpp"

namespace ism::detail {

/// Orthonormal directions: number k of direction c at k · count + c, so that a point is projected on all of
/// them at once.
class PrincipalAxes {
public:
    PrincipalAxes(std::size_t dimension, std::size_t count)
        : dimension_(dimension), count_(count), numbers_(dimension * count) {}

    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] double& operator()(std::size_t k, std::size_t c) { return numbers_[k * count_ + c]; }

    /// Number k of all directions.
    [[nodiscard]] double* row(std::size_t k) { return numbers_.data() + k * count_; }

    /// The coordinates of a point along the directions.
    void project(const float* point, std::span<double> along) const {
        std::fill(along.begin(), along.end(), 0.0);
        for (std::size_t k = 0; k < dimension_; ++k) add(point[k], numbers_.data() + k * count_, along);
    }

    /// along += factor · row
    static void add(double factor, const double* row, std::span<double> along) {
        for (std::size_t c = 0; c < along.size(); ++c) along[c] += factor * row[c];
    }

    /// Makes them orthonormal, one after another (Gram–Schmidt, twice against rounding): each is taken out of
    /// all that follow. A direction that depends on those before becomes 0, which keeps every use as a
    /// projection right.
    void orthonormalise() {
        std::vector<double> before(count_), along(count_);
        for (int pass = 0; pass < 2; ++pass) {
            for (std::size_t i = 0; i < count_; ++i) before[i] = length(i);
            for (std::size_t i = 0; i < count_; ++i) {
                const double left = length(i), factor = left > 1e-6 * before[i] ? 1 / left : 0;
                const std::span<double> others = std::span(along).subspan(i + 1);
                std::fill(others.begin(), others.end(), 0.0);
                for (std::size_t k = 0; k < dimension_; ++k) {
                    (*this)(k, i) *= factor;
                    add((*this)(k, i), row(k) + i + 1, others);
                }
                for (std::size_t k = 0; k < dimension_; ++k)
                    add(-(*this)(k, i), others.data(), {row(k) + i + 1, others.size()});
            }
        }
    }

private:
    [[nodiscard]] double length(std::size_t c) {
        double sum = 0;
        for (std::size_t k = 0; k < dimension_; ++k) sum += (*this)(k, c) * (*this)(k, c);
        return std::sqrt(sum);
    }

    std::size_t dimension_, count_;
    std::vector<double> numbers_;
};

/// `count` directions near those along which the points (one after another, centred) spread most: orthogonal
/// iteration from a random start. How near does not matter to bounds that hold for any directions.
[[nodiscard]] inline PrincipalAxes principal_directions(std::span<const float> points, std::size_t dimension,
                                                        std::size_t count) {
    Random random(1);
    PrincipalAxes directions(dimension, count);
    for (std::size_t c = 0; c < count; ++c)
        for (std::size_t k = 0; k < dimension; ++k) directions(k, c) = random.normal();
    directions.orthonormalise();
    std::vector<double> along(count);
    for (int round = 0; round < 3; ++round) {
        PrincipalAxes next(dimension, count);
        for (std::size_t first = 0; first < points.size(); first += dimension) {
            directions.project(points.data() + first, along);
            for (std::size_t k = 0; k < dimension; ++k)
                PrincipalAxes::add(points[first + k], along.data(), {next.row(k), count});
        }
        directions = next;
        directions.orthonormalise();
    }
    return directions;
}

}  // namespace ism::detail
