// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ism/core/image.hpp"
#include "ism/core/parallel.hpp"

namespace ism {

/// @brief The gradient of an image: its length (brightness a pixel) and its direction (radians from x towards
/// y, −π … π).
struct GradientView {
    ImageView<const float> magnitude, angle;
};

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

/// Central differences; at the edge the image goes on with its last value.
inline void polar_gradient(ImageView<const float> image, ImageView<float> magnitude, ImageView<float> angle,
                           unsigned threads) {
    const int width = image.width(), height = image.height();
    parallel_for(std::size_t(height), height < 128 ? 1 : threads, [&](std::size_t row) {
        const int y = int(row);
        const float* above = image.row(std::max(y - 1, 0)).data();
        const float* here = image.row(y).data();
        const float* below = image.row(std::min(y + 1, height - 1)).data();
        float* __restrict length = magnitude.row(y).data();
        float* __restrict direction = angle.row(y).data();
        const auto at = [&](int x, int left, int right) {
            to_polar(0.5f * (here[right] - here[left]), 0.5f * (below[x] - above[x]), length[x],
                     direction[x]);
        };
        at(0, 0, std::min(1, width - 1));
        for (int x = 1; x < width - 1; ++x) {
            float m, a;
            to_polar(0.5f * (here[x + 1] - here[x - 1]), 0.5f * (below[x] - above[x]), m, a);
            length[x] = m, direction[x] = a;
        }
        at(width - 1, std::max(0, width - 2), width - 1);
    });
}

}  // namespace detail

}  // namespace ism
