// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "ism/core/error.hpp"

namespace ism {

/// @brief Pixels that gaussian_kernel() reaches to one side; 0 for the deviation 0, which needs no kernel.
[[nodiscard]] inline int kernel_radius(double sigma) {
    return sigma > 0 ? std::max(1, int(std::ceil(3 * sigma))) : 0;
}

/// @brief Half of a symmetric Gaussian kernel: the middle weight, then those to one side. Its sum over both
/// sides is 1 and its variance is sigma² (pixels²), although it is sampled and ends at 3 sigma: so
/// blurring step by step adds up as the continuous Gaussian does.
/// @throws Error where `sigma` is not a positive number.
[[nodiscard]] inline std::vector<float> gaussian_kernel(double sigma) {
    expect(std::isfinite(sigma) && sigma > 0, "Gaussian deviation (pixels)", "a positive number", sigma);
    const int radius = kernel_radius(sigma);
    std::vector<double> half(std::size_t(radius) + 1);
    const auto variance_of = [&](double width) {
        double sum = half[0] = 1, moment = 0;
        for (int i = 1; i <= radius; ++i) {
            half[std::size_t(i)] = std::exp(-i * i / (2 * width * width));
            sum += 2 * half[std::size_t(i)];
            moment += 2 * i * i * half[std::size_t(i)];
        }
        for (double& weight : half) weight /= sum;
        return moment / sum;
    };
    double low = 0.01 * sigma, high = 4 * sigma + 1;
    for (int step = 0; step < 60; ++step) {
        const double middle = (low + high) / 2;
        (variance_of(middle) < sigma * sigma ? low : high) = middle;
    }
    return {half.begin(), half.end()};
}

}  // namespace ism
