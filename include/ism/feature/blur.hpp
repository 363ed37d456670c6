// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include "ism/core/aligned.hpp"
#include "ism/core/callable.hpp"
#include "ism/core/image.hpp"
#include "ism/core/vector.hpp"
#include "ism/feature/workspace.hpp"

namespace ism {

namespace detail {

/// Columns that are blurred side by side; what is written does not depend on how many they are.
#if defined(__GNUC__)
using BlurLanes = Vector<float, native_lanes>;
#else
using BlurLanes = float;
#endif
inline constexpr int blur_lanes = sizeof(BlurLanes) / sizeof(float);

/// Two rows of blurred columns, one below the other. `rows` are the 2 · radius + 2 rows around them.
inline void blur_columns(const float* const* rows, const float* kernel, int radius, int width, float* upper,
                         float* lower) {
    constexpr int parts = 2, block = parts * blur_lanes;
    const float* const* const middle = rows + radius;
    int x = 0;
    while (x < width && width >= block) {
        x = std::min(x, width - block);  // the last block does some columns again
        BlurLanes up[parts], down[parts], above[parts], below[parts];
#pragma GCC unroll 8
        for (int p = 0; p < parts; ++p) {
            std::memcpy(&above[p], middle[0] + x + p * blur_lanes, sizeof(BlurLanes));
            std::memcpy(&below[p], middle[1] + x + p * blur_lanes, sizeof(BlurLanes));
            up[p] = kernel[0] * above[p], down[p] = kernel[0] * below[p];
        }
        for (int t = 1; t <= radius; ++t) {  // what is t below one row is t − 1 below the other
            const float *const top = middle[-t] + x, *const bottom = middle[1 + t] + x;
            const float weight = kernel[t];
#pragma GCC unroll 8
            for (int p = 0; p < parts; ++p) {
                BlurLanes high, low;
                std::memcpy(&high, top + p * blur_lanes, sizeof(BlurLanes));
                std::memcpy(&low, bottom + p * blur_lanes, sizeof(BlurLanes));
                up[p] += weight * (high + below[p]);
                down[p] += weight * (above[p] + low);
                above[p] = high, below[p] = low;
            }
        }
#pragma GCC unroll 8
        for (int p = 0; p < parts; ++p) {
            std::memcpy(upper + x + p * blur_lanes, &up[p], sizeof(BlurLanes));
            std::memcpy(lower + x + p * blur_lanes, &down[p], sizeof(BlurLanes));
        }
        x += block;
    }
    for (; x < width; ++x) {
        float up = kernel[0] * middle[0][x], down = kernel[0] * middle[1][x];
        for (int t = 1; t <= radius; ++t) {
            up += kernel[t] * (middle[-t][x] + middle[t][x]);
            down += kernel[t] * (middle[1 - t][x] + middle[1 + t][x]);
        }
        upper[x] = up, lower[x] = down;
    }
}

/// One blurred row of a row that has `radius` spare pixels at either end.
inline void blur_along(float* row, const float* kernel, int radius, int width, float* out) {
    constexpr int parts = 4, block = parts * blur_lanes;
    for (int t = 1; t <= radius; ++t) row[-t] = row[0], row[width - 1 + t] = row[width - 1];
    int x = 0;
    while (x < width && width >= block) {
        x = std::min(x, width - block);
        BlurLanes sums[parts];
#pragma GCC unroll 8
        for (int p = 0; p < parts; ++p) {
            BlurLanes middle;
            std::memcpy(&middle, row + x + p * blur_lanes, sizeof(BlurLanes));
            sums[p] = kernel[0] * middle;
        }
        for (int t = 1; t <= radius; ++t) {
            const float weight = kernel[t];
#pragma GCC unroll 8
            for (int p = 0; p < parts; ++p) {
                BlurLanes left, right;
                std::memcpy(&left, row + x + p * blur_lanes - t, sizeof(BlurLanes));
                std::memcpy(&right, row + x + p * blur_lanes + t, sizeof(BlurLanes));
                sums[p] += weight * (left + right);
            }
        }
#pragma GCC unroll 8
        for (int p = 0; p < parts; ++p) std::memcpy(out + x + p * blur_lanes, &sums[p], sizeof(BlurLanes));
        x += block;
    }
    for (; x < width; ++x) {
        float sum = kernel[0] * row[x];
        for (int t = 1; t <= radius; ++t) sum += kernel[t] * (row[x - t] + row[x + t]);
        out[x] = sum;
    }
}

inline constexpr int blur_rows_at_once = 16;

/// Scratch floats needed by blur_band().
[[nodiscard]] inline std::size_t blur_scratch(int width, int radius) {
    return std::size_t(blur_rows_at_once) * std::size_t(whole_lines(radius) + whole_lines(width + radius));
}

/// A few blurred rows. Columns go in strips so narrow that what the rows need of them stays in the nearest
/// cache.
/// @param sources  count + 2 · radius + 1 rows around them; they are moved along
/// @param outs     `count` rows, at most blur_rows_at_once
inline void blur_rows(const float** sources, int count, int width, std::span<const float> kernel,
                      float* scratch, float* const* outs) {
    constexpr int strip = 128;
    const int radius = int(kernel.size()) - 1, margin = whole_lines(radius);
    const int pitch = margin + whole_lines(width + radius);
    for (int x = 0; x < width; x += strip) {
        for (int i = 0; i < count; i += 2) {
            float* upper = scratch + std::ptrdiff_t(i) * pitch + margin + x;
            blur_columns(sources + i, kernel.data(), radius, std::min(strip, width - x), upper,
                         upper + pitch);
        }
        for (int i = 0; i < count + 2 * radius + 1; ++i) sources[i] += strip;
    }
    for (int i = 0; i < count; ++i)
        blur_along(scratch + std::ptrdiff_t(i) * pitch + margin, kernel.data(), radius, width, outs[i]);
}

/// The blurred rows first … end − 1: row y is written to out_row(y); source_row(y) gives row y of the image,
/// which has `height` rows.
template <Callable<int> Source, Callable<int> Out>
void blur_band(const Source& source_row, int width, int height, std::span<const float> kernel, int first,
               int end, float* scratch, const Out& out_row) {
    constexpr int usual_radius = 11;  // no detector's default options blur with a larger one
    const int radius = int(kernel.size()) - 1;
    std::array<const float*, 2 * usual_radius + blur_rows_at_once + 1> few;
    std::vector<const float*> many(radius > usual_radius ? 2 * std::size_t(radius) + blur_rows_at_once + 1
                                                         : 0);
    const float** const sources = radius > usual_radius ? many.data() : few.data();
    std::array<float*, blur_rows_at_once> outs;
    for (int y = first; y < end; y += blur_rows_at_once) {
        const int count = std::min(blur_rows_at_once, end - y);
        // an odd last row is paired with a repeated one, whose result is discarded
        for (int i = 0; i < count + 2 * radius; ++i)
            sources[i] = source_row(std::clamp(y - radius + i, 0, height - 1));
        sources[count + 2 * radius] = sources[count + 2 * radius - 1];
        for (int i = 0; i < count; ++i) outs[std::size_t(i)] = out_row(y + i);
        blur_rows(sources, count, width, kernel, scratch, outs.data());
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
