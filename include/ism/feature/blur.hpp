// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/aligned.hpp"
#include "ism/core/callable.hpp"
#include "ism/core/image.hpp"
#include "ism/feature/workspace.hpp"

namespace ism {

namespace detail {

inline constexpr int unrolled_radius = 11;  // no detector's default options blur with a larger one

/// Two rows of blurred columns, one below the other. `rows` are the 2 · radius + 2 rows around them. With
/// Radius > 0 the tap loops have a fixed length, so that the compiler can unroll and vectorise them.
template <int Radius>
void blur_columns(const float* const* rows, const float* kernel, int dynamic_radius, int width,
                  float* __restrict upper, float* __restrict lower) {
    if constexpr (Radius > 0) {
        for (int x = 0; x < width; ++x) {
            float up = kernel[0] * rows[Radius][x], down = kernel[0] * rows[Radius + 1][x];
            for (int t = 1; t <= Radius; ++t) {
                up += kernel[t] * (rows[Radius - t][x] + rows[Radius + t][x]);
                down += kernel[t] * (rows[Radius + 1 - t][x] + rows[Radius + 1 + t][x]);
            }
            upper[x] = up, lower[x] = down;
        }
    } else {
        const float* const* middle = rows + dynamic_radius;
        for (int x = 0; x < width; ++x)
            upper[x] = kernel[0] * middle[0][x], lower[x] = kernel[0] * middle[1][x];
        for (int t = 1; t <= dynamic_radius; ++t)
            for (int x = 0; x < width; ++x) {
                upper[x] += kernel[t] * (middle[-t][x] + middle[t][x]);
                lower[x] += kernel[t] * (middle[1 - t][x] + middle[1 + t][x]);
            }
    }
}

/// One blurred row of a row that has `radius` spare pixels at either end.
template <int Radius>
void blur_along(float* __restrict row, const float* kernel, int dynamic_radius, int width,
                float* __restrict out) {
    const int radius = Radius > 0 ? Radius : dynamic_radius;
    for (int t = 1; t <= radius; ++t) row[-t] = row[0], row[width - 1 + t] = row[width - 1];
    if constexpr (Radius > 0) {
        for (int x = 0; x < width; ++x) {
            float sum = kernel[0] * row[x];
            for (int t = 1; t <= Radius; ++t) sum += kernel[t] * (row[x - t] + row[x + t]);
            out[x] = sum;
        }
    } else {
        for (int x = 0; x < width; ++x) out[x] = kernel[0] * row[x];
        for (int t = 1; t <= radius; ++t)
            for (int x = 0; x < width; ++x) out[x] += kernel[t] * (row[x - t] + row[x + t]);
    }
}

/// The blur functions for one radius.
struct BlurFunctions {
    void (*columns)(const float* const*, const float*, int, int, float* __restrict, float* __restrict);
    void (*along)(float* __restrict, const float*, int, int, float* __restrict);
};

template <int... Radius>
[[nodiscard]] constexpr std::array<BlurFunctions, sizeof...(Radius)> blur_functions(
    std::integer_sequence<int, Radius...>) {
    return {BlurFunctions{&blur_columns<Radius>, &blur_along<Radius>}...};
}

/// Entry r is for the radius r; entry 0 for every other one.
inline constexpr auto blur_of_radius = blur_functions(std::make_integer_sequence<int, unrolled_radius + 1>{});

inline constexpr int blur_rows_at_once = 16;

/// Scratch floats needed by blur_band().
[[nodiscard]] inline std::size_t blur_scratch(int width, int radius) {
    return std::size_t(blur_rows_at_once) * std::size_t(whole_lines(radius) + whole_lines(width + radius));
}

/// The blurred rows first … end − 1: row y is written to out_row(y); source_row(y) gives row y of the image,
/// which has `height` rows. Columns go in strips so narrow that what a few rows need of them stays in the
/// nearest cache.
template <Callable<int> Source, Callable<int> Out>
void blur_band(const Source& source_row, int width, int height, std::span<const float> kernel, int first,
               int end, float* scratch, const Out& out_row) {
    constexpr int strip = 128;
    const int radius = int(kernel.size()) - 1, margin = whole_lines(radius);
    const int pitch = margin + whole_lines(width + radius);
    const bool unrolled = radius <= unrolled_radius;
    const BlurFunctions& blur = blur_of_radius[std::size_t(unrolled ? radius : 0)];
    std::array<const float*, 2 * unrolled_radius + blur_rows_at_once + 1> few;
    std::vector<const float*> many(unrolled ? 0 : 2 * std::size_t(radius) + blur_rows_at_once + 1);
    const float** sources = unrolled ? few.data() : many.data();
    for (int y = first; y < end; y += blur_rows_at_once) {
        const int count = std::min(blur_rows_at_once, end - y);
        // an odd last row is paired with a repeated one, whose result is discarded
        for (int i = 0; i < count + 2 * radius; ++i)
            sources[i] = source_row(std::clamp(y - radius + i, 0, height - 1));
        sources[count + 2 * radius] = sources[count + 2 * radius - 1];
        for (int x = 0; x < width; x += strip) {
            for (int i = 0; i < count; i += 2) {
                float* upper = scratch + std::ptrdiff_t(i) * pitch + margin + x;
                blur.columns(sources + i, kernel.data(), radius, std::min(strip, width - x), upper,
                             upper + pitch);
            }
            for (int i = 0; i < count + 2 * radius + 1; ++i) sources[i] += strip;
        }
        for (int i = 0; i < count; ++i)
            blur.along(scratch + std::ptrdiff_t(i) * pitch + margin, kernel.data(), radius, width,
                       out_row(y + i));
    }
}

}  // namespace detail

/// @brief Blurs `image` with a kernel from gaussian_kernel() into `out`, another image of the same size.
/// Outside the image the edge pixels are repeated.
inline void blur(ImageView<const float> image, std::span<const float> kernel, ImageView<float> out,
                 Workspace& workspace) {
    constexpr int rows_per_task = 32;
    expect(image.width() == out.width() && image.height() == out.height(), "blurred image size",
           size_text(image), size_text(out));
    if (image.empty()) return;
    const int radius = int(kernel.size()) - 1, width = image.width(), height = image.height();
    const int tasks = (height + rows_per_task - 1) / rows_per_task;
    workspace.pool().for_each(std::size_t(tasks), [&](std::size_t task, unsigned worker) {
        const int first = int(task) * rows_per_task;
        detail::blur_band([&](int y) { return image.row(y).data(); }, width, height, kernel, first,
                          std::min(height, first + rows_per_task),
                          workspace.rows(worker, detail::blur_scratch(width, radius)).data(),
                          [&](int y) { return out.row(y).data(); });
    });
}

}  // namespace ism
