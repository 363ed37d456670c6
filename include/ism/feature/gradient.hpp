// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "ism/core/image.hpp"

namespace ism {

namespace detail {

/// Length and direction of (dx, dy) without branches or library calls, so that loops of it vectorise:
/// polynomials in t = (min/max)², exact to 2e-6 of the length and 6e-6 radians.
inline void to_polar(float dx, float dy, float& magnitude, float& angle) {
    const float ax = std::fabs(dx), ay = std::fabs(dy);
    const float large = ax > ay ? ax : ay, small = ax > ay ? ay : ax;
    const float ratio = small / (large + 1e-30f), t = ratio * ratio;
    const float root =
        1.0000016394f +
        t * (0.4998807541f +
             t * (-0.1235349196f + t * (0.0555406822f + t * (-0.0225568472f + t * 0.0048832065f))));
    const float arc =
        ratio * (0.9999948346f +
                 t * (-0.3329571103f +
                      t * (0.1953465900f + t * (-0.1204485852f + t * (0.0565899852f - t * 0.0131303821f)))));
    magnitude = large * root;
    const float steep = std::numbers::pi_v<float> / 2 - arc;
    const float octant = ay > ax ? steep : arc;
    const float left = std::numbers::pi_v<float> - octant;
    const float upper = dx < 0 ? left : octant;
    angle = std::copysign(upper, dy);
}

/// e^−t for 0 ≤ t ≤ 1.6 to 5e-6, without a library call.
[[nodiscard]] inline float small_exp(float t) {
    const float x = 0.8f - t;
    return 0.44932896f *
           (1 + x * (1 + x * (1 / 2.f + x * (1 / 6.f + x * (1 / 24.f +
                                                            x * (1 / 120.f + x * (1 / 720.f + x / 5040)))))));
}

/// A batch of gradients around a point, stored as a structure of arrays.
struct GradientBatch {
    static constexpr std::size_t capacity = 512;
    using Numbers = std::array<float, capacity>;

    std::size_t count = 0;
    alignas(64) Numbers dx, dy;     ///< from the place, pixels
    alignas(64) Numbers magnitude;  ///< brightness a pixel
    alignas(64) Numbers angle;      ///< radians from x towards y, −π … π

    /// Adds gradients, by central differences, at the pixels (first + k, row), k < more, which all have four
    /// neighbours; magnitude and angle hold its components until make_polar().
    void add_row(ImageView<const float> image, int first, int row, std::size_t more, float x, float y) {
        const float* __restrict here = image.row(row).data() + first;
        const float* __restrict above = here - image.stride();
        const float* __restrict below = here + image.stride();
        float* __restrict to_dx = dx.data() + count;
        float* __restrict to_dy = dy.data() + count;
        float* __restrict gx = magnitude.data() + count;
        float* __restrict gy = angle.data() + count;
        const float x0 = float(first) - x, y0 = float(row) - y;
        for (int k = 0; k < int(more); ++k) {
            gx[k] = 0.5f * (here[k + 1] - here[k - 1]), gy[k] = 0.5f * (below[k] - above[k]);
            to_dx[k] = x0 + float(k), to_dy[k] = y0;
        }
        count += more;
    }

    void make_polar() {
        for (std::size_t k = 0; k < count; ++k) {
            float length, direction;
            to_polar(magnitude[k], angle[k], length, direction);
            magnitude[k] = length, angle[k] = direction;
        }
    }
};

}  // namespace detail

}  // namespace ism
