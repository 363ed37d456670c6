// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "ism/core/image.hpp"
#include "ism/core/parallel.hpp"

namespace ism {

/// @brief Half of a symmetric Gaussian kernel: the middle weight, then those to one side. Its sum over both
/// sides is 1 and its variance is sigma² (pixels²), although it is sampled and ends at 3 sigma: so
/// blurring step by step adds up as the continuous Gaussian does.
/// @throws Error where `sigma` is not a positive number.
[[nodiscard]] inline std::vector<float> gaussian_kernel(double sigma) {
    expect(std::isfinite(sigma) && sigma > 0, "Gaussian deviation (pixels)", "a positive number", sigma);
    const int radius = std::max(1, int(std::ceil(3 * sigma)));
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

namespace detail {

inline constexpr int unrolled_radius = 16;
inline constexpr int rows_per_task = 32;

/// One blurred row: first the columns into `column`, which has `radius` spare pixels at either end, then
/// the row. With Radius > 0 the tap loops have a fixed length, so that the compiler can turn them inside out.
template <int Radius>
void blur_row(const float* const* rows, const float* kernel, int dynamic_radius, int width,
              float* __restrict column, float* __restrict out) {
    const int radius = Radius > 0 ? Radius : dynamic_radius;
    const float* const* centre = rows + radius;
    float* __restrict inner = column + radius;
    if constexpr (Radius > 0) {
        for (int x = 0; x < width; ++x) {
            float sum = kernel[0] * centre[0][x];
            for (int t = 1; t <= Radius; ++t) sum += kernel[t] * (centre[-t][x] + centre[t][x]);
            inner[x] = sum;
        }
    } else {
        for (int x = 0; x < width; ++x) inner[x] = kernel[0] * centre[0][x];
        for (int t = 1; t <= radius; ++t) {
            const float *above = centre[-t], *below = centre[t];
            for (int x = 0; x < width; ++x) inner[x] += kernel[t] * (above[x] + below[x]);
        }
    }
    for (int t = 1; t <= radius; ++t) inner[-t] = inner[0], inner[width - 1 + t] = inner[width - 1];
    if constexpr (Radius > 0) {
        for (int x = 0; x < width; ++x) {
            float sum = kernel[0] * inner[x];
            for (int t = 1; t <= Radius; ++t) sum += kernel[t] * (inner[x - t] + inner[x + t]);
            out[x] = sum;
        }
    } else {
        for (int x = 0; x < width; ++x) out[x] = kernel[0] * inner[x];
        for (int t = 1; t <= radius; ++t)
            for (int x = 0; x < width; ++x) out[x] += kernel[t] * (inner[x - t] + inner[x + t]);
    }
}

using BlurRow = void (*)(const float* const*, const float*, int, int, float* __restrict, float* __restrict);

template <int... Radius>
[[nodiscard]] constexpr std::array<BlurRow, sizeof...(Radius)> blur_rows(
    std::integer_sequence<int, Radius...>) {
    return {&blur_row<Radius>...};
}

/// Entry r is for the radius r; entry 0 for every other one.
inline constexpr auto blur_row_of_radius = blur_rows(std::make_integer_sequence<int, unrolled_radius + 1>{});

}  // namespace detail

/// @brief Blurs `image` with a kernel from gaussian_kernel() into `out`, another image of the same size.
/// Outside the image its edge goes on.
inline void blur(ImageView<const float> image, const std::vector<float>& kernel, ImageView<float> out,
                 unsigned threads = 1) {
    expect(image.width() == out.width() && image.height() == out.height(), "blurred image size",
           size_text(image), size_text(out));
    const int radius = int(kernel.size()) - 1, width = image.width(), height = image.height();
    if (image.empty()) return;
    const detail::BlurRow blur_row =
        detail::blur_row_of_radius[std::size_t(radius <= detail::unrolled_radius ? radius : 0)];
    const int tasks = (height + detail::rows_per_task - 1) / detail::rows_per_task;
    parallel_for(std::size_t(tasks), threads, [&](std::size_t task) {
        std::vector<float> column(std::size_t(width) + 2 * std::size_t(radius));
        std::vector<const float*> rows(2 * std::size_t(radius) + 1);
        const int first = int(task) * detail::rows_per_task;
        for (int y = first; y < std::min(height, first + detail::rows_per_task); ++y) {
            for (int t = -radius; t <= radius; ++t)
                rows[std::size_t(t + radius)] = image.row(std::clamp(y + t, 0, height - 1)).data();
            blur_row(rows.data(), kernel.data(), radius, width, column.data(), out.row(y).data());
        }
    });
}

}  // namespace ism
