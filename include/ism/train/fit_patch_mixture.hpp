// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/random.hpp"
#include "ism/hog/fisher_vector.hpp"

namespace ism {

namespace detail {

/// What is added to the variances of Gaussians, that none shrinks to a point.
inline constexpr double least_variance = 1e-5;

/// Diagonalises a symmetric matrix, row after row, by rotations of two axes (Jacobi 1846).
/// @return the axes as rows, that of most variance first
[[nodiscard]] inline std::vector<double> eigenvectors(std::vector<double> matrix, std::size_t size) {
    std::vector<double> axes(size * size, 0);
    for (std::size_t i = 0; i < size; ++i) axes[i * size + i] = 1;
    double total = 0;
    for (const double m : matrix) total += m * m;
    for (int sweep = 0; sweep < 30; ++sweep) {
        double off = 0;
        for (std::size_t p = 0; p < size; ++p)
            for (std::size_t q = p + 1; q < size; ++q) off += matrix[p * size + q] * matrix[p * size + q];
        if (!(off > 1e-20 * total)) break;
        for (std::size_t p = 0; p < size; ++p)
            for (std::size_t q = p + 1; q < size; ++q) {
                const double apq = matrix[p * size + q];
                if (apq == 0) continue;
                const double theta = (matrix[q * size + q] - matrix[p * size + p]) / (2 * apq);
                const double t = std::copysign(1 / (std::abs(theta) + std::sqrt(theta * theta + 1)), theta);
                const double c = 1 / std::sqrt(t * t + 1), s = t * c;
                const auto rotate = [&](double& a, double& b) {
                    const double before = a;
                    a = c * before - s * b, b = s * before + c * b;
                };
                for (std::size_t k = 0; k < size; ++k) rotate(matrix[p * size + k], matrix[q * size + k]);
                for (std::size_t k = 0; k < size; ++k) rotate(matrix[k * size + p], matrix[k * size + q]);
                for (std::size_t k = 0; k < size; ++k) rotate(axes[p * size + k], axes[q * size + k]);
            }
    }
    std::vector<std::size_t> order(size);
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return matrix[a * size + a] > matrix[b * size + b];
    });
    std::vector<double> sorted;
    for (const std::size_t i : order)
        sorted.insert(sorted.end(), axes.begin() + std::ptrdiff_t(i * size),
                      axes.begin() + std::ptrdiff_t((i + 1) * size));
    return sorted;
}

/// The mean of patches and their first principal axes.
[[nodiscard]] inline PatchMixture patch_axes_of(std::span<const float> patches) {
    const std::size_t count = patches.size() / patch_numbers;
    PatchMixture result;
    std::vector<double> mean(patch_numbers, 0), covariance(patch_numbers * patch_numbers, 0);
    for (std::size_t i = 0; i < patches.size(); ++i) mean[i % patch_numbers] += patches[i] / double(count);
    std::vector<double> apart(patch_numbers);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < patch_numbers; ++k) apart[k] = patches[i * patch_numbers + k] - mean[k];
        for (std::size_t k = 0; k < patch_numbers; ++k)
            for (std::size_t l = 0; l < patch_numbers; ++l)
                covariance[k * patch_numbers + l] += apart[k] * apart[l];
    }
    const std::vector<double> axes = eigenvectors(std::move(covariance), patch_numbers);
    result.mean.assign(mean.begin(), mean.end());
    for (std::size_t k = 0; k < patch_numbers; ++k)
        for (std::size_t d = 0; d < patch_axes; ++d)
            result.axes.push_back(float(axes[d * patch_numbers + k]));
    return result;
}

}  // namespace detail

/// @brief Fits a mixture of Gaussians to patches: their principal axes, then expectation maximisation
/// (Dempster, Laird and Rubin 1977) with variances along the axes alone.
/// @param patches  one after another, patch_numbers each
/// @throws Error for no patch.
[[nodiscard]] inline PatchMixture fit_patch_mixture(std::span<const float> patches) {
    const std::size_t count = patches.size() / patch_numbers;
    expect(count > 0, "patches to fit a mixture to", "1 or more", 0);
    constexpr std::size_t gaussians = PatchMixture::gaussians;
    PatchMixture mixture = detail::patch_axes_of(patches);
    std::vector<Patch> points(count);
    std::array<double, patch_axes> variance{};
    for (std::size_t i = 0; i < count; ++i) {
        points[i] = reduce_patch(mixture, patches.subspan(i * patch_numbers, patch_numbers), 2, 0, 0);
        for (std::size_t d = 0; d < patch_axes; ++d)
            variance[d] += double(points[i][d]) * points[i][d] / double(count);
    }
    Random random(1);
    mixture.weights.assign(gaussians, 1.0f / gaussians);
    for (std::size_t g = 0; g < gaussians; ++g) {
        const Patch& start = points[random.index(count)];
        mixture.means.insert(mixture.means.end(), start.begin(), start.end());
        for (const double v : variance)
            mixture.spreads.push_back(float(std::sqrt(v + detail::least_variance)));
    }
    for (int round = 0; round < 30; ++round) {
        const PatchPlacer place(mixture);
        std::vector<double> weight(gaussians, 0), sum(gaussians * patch_axes, 0), sq_sum(sum);
        for (const Patch& point : points) {
            const PatchPlace at = place(point);
            for (std::size_t g = 0; g < gaussians; ++g) {
                if (!(at.share[g] > 0)) continue;
                weight[g] += at.share[g];
                for (std::size_t d = 0; d < patch_axes; ++d) {
                    sum[g * patch_axes + d] += double(at.share[g]) * at.apart[g][d];
                    sq_sum[g * patch_axes + d] += double(at.share[g]) * at.apart[g][d] * at.apart[g][d];
                }
            }
        }
        for (std::size_t g = 0; g < gaussians; ++g) {
            mixture.weights[g] = float((weight[g] + 1) / double(count + gaussians));
            for (std::size_t k = g * patch_axes; k < (g + 1) * patch_axes; ++k) {
                // as before where no patch is near
                const double moved = sum[k] / (weight[g] + 1), spread = mixture.spreads[k];
                const double sq = (sq_sum[k] + 1) / (weight[g] + 1) - moved * moved;
                mixture.means[k] += float(moved * spread);
                mixture.spreads[k] =
                    float(std::sqrt(std::max(0.0, sq) * spread * spread + detail::least_variance));
            }
        }
    }
    return mixture;
}

}  // namespace ism
