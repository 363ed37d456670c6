// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include "ism/core/image.hpp"

namespace ism::detail {

/// Numbers that double_rows() works with.
[[nodiscard]] inline std::size_t double_scratch(int width) {
    return std::size_t(width) + 3;
}

/// Rows first … end − 1 of an image at twice its size. Pixel 2x is pixel x of the image. Those between come
/// from four neighbours by the weights (−1, 9, 9, −1)/16, whose variance is 0: unlike means they add no blur.
inline void double_rows(ImageView<const float> image, int first, int end, float* scratch,
                        ImageView<float> out) {
    const int width = image.width(), last = image.height() - 1;
    const auto between = [](float a, float b, float c, float d) {
        return 0.5625f * (b + c) - 0.0625f * (a + d);
    };
    const auto source = [&](int y) { return image.row(std::clamp(y, 0, last)).data(); };
    float* __restrict row = scratch + 1;
    for (int y = first; y < end; ++y) {
        const float *a = source(y / 2 - 1), *b = source(y / 2), *c = source(y / 2 + 1),
                    *d = source(y / 2 + 2);
        if (y % 2 == 0)
            std::copy_n(b, width, row);
        else
            for (int x = 0; x < width; ++x) row[x] = between(a[x], b[x], c[x], d[x]);
        row[-1] = row[0], row[width] = row[width + 1] = row[width - 1];
        float* __restrict to = out.row(y).data();
        for (int x = 0; x < width - 1; ++x) {
            to[2 * x] = row[x];
            to[2 * x + 1] = between(row[x - 1], row[x], row[x + 1], row[x + 2]);
        }
        to[2 * width - 2] = row[width - 1];
    }
}

}  // namespace ism::detail
