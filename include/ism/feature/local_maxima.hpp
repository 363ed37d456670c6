// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <vector>

#include "ism/core/image.hpp"
#include "ism/feature/feature.hpp"

namespace ism::detail {

/// Out of `value` and its eight neighbours: whether it is the largest. Of equal neighbours the first in
/// reading order counts as larger, so that a flat top of several pixels gives one maximum.
[[nodiscard]] inline bool is_maximum(ImageView<const float> image, int x, int y) {
    const float value = image(x, y);
    return value > image(x - 1, y - 1) && value > image(x, y - 1) && value > image(x + 1, y - 1) &&
           value > image(x - 1, y) && value >= image(x + 1, y) && value >= image(x - 1, y + 1) &&
           value >= image(x, y + 1) && value >= image(x + 1, y + 1);
}

/// Top of the parabola through three neighbouring values, relative to the middle one; within ±0.5 where that
/// is the largest.
[[nodiscard]] inline float parabola_top(float before, float middle, float after) {
    const float curvature = before - 2 * middle + after;
    return curvature < 0 ? std::clamp(0.5f * (before - after) / curvature, -0.5f, 0.5f) : 0.0f;
}

/// Where between the pixels the maximum near (x, y) lies: top of the quadratic through its neighbours.
struct SubPixel {
    float dx = 0, dy = 0, value = 0;
};
[[nodiscard]] inline SubPixel refine_maximum(ImageView<const float> image, int x, int y) {
    const float value = image(x, y);
    const float gx = 0.5f * (image(x + 1, y) - image(x - 1, y));
    const float gy = 0.5f * (image(x, y + 1) - image(x, y - 1));
    const float xx = image(x + 1, y) - 2 * value + image(x - 1, y);
    const float yy = image(x, y + 1) - 2 * value + image(x, y - 1);
    const float xy =
        0.25f * (image(x + 1, y + 1) - image(x - 1, y + 1) - image(x + 1, y - 1) + image(x - 1, y - 1));
    const float det = xx * yy - xy * xy;
    if (!(det > 1e-6f * xx * xx)) return {0, 0, value};
    const float dx = std::clamp((xy * gy - yy * gx) / det, -1.0f, 1.0f);
    const float dy = std::clamp((xy * gx - xx * gy) / det, -1.0f, 1.0f);
    return {dx, dy, value + 0.5f * (gx * dx + gy * dy)};
}

/// Puts the features of an octave in order (y, x, scale) and drops repetitions.
inline void sort_unique(std::vector<Feature>& features) {
    const auto key = [](const Feature& f) { return std::tie(f.y, f.x, f.scale, f.strength); };
    std::sort(features.begin(), features.end(),
              [&](const Feature& a, const Feature& b) { return key(a) < key(b); });
    features.erase(std::unique(features.begin(), features.end(),
                               [&](const Feature& a, const Feature& b) {
                                   return a.y == b.y && a.x == b.x && a.scale == b.scale;
                               }),
                   features.end());
}

/// Drops each feature that lies within `radius` scales of a stronger one which stays and whose scale differs
/// by less than `ratio`; the others stay in order.
[[nodiscard]] inline std::vector<Feature> without_duplicates(const std::vector<Feature>& features,
                                                             float radius, float ratio) {
    std::vector<std::size_t> by_y(features.size()), place(features.size()), by_strength;
    std::iota(by_y.begin(), by_y.end(), std::size_t{0});
    by_strength = by_y;
    std::sort(by_y.begin(), by_y.end(), [&](std::size_t a, std::size_t b) {
        return std::tie(features[a].y, a) < std::tie(features[b].y, b);
    });
    for (std::size_t i = 0; i < by_y.size(); ++i) place[by_y[i]] = i;
    std::sort(by_strength.begin(), by_strength.end(), [&](std::size_t a, std::size_t b) {
        return std::tie(features[b].strength, a) < std::tie(features[a].strength, b);
    });
    std::vector<char> dropped(features.size());
    for (const std::size_t i : by_strength) {
        if (dropped[i] != 0) continue;
        const Feature& strong = features[i];
        const float reach = radius * strong.scale;
        const auto drop_near = [&](std::size_t j) {
            const Feature& f = features[j];
            if (std::fabs(f.y - strong.y) > reach) return false;
            if (std::hypot(f.x - strong.x, f.y - strong.y) <= reach && f.scale < strong.scale * ratio &&
                strong.scale < f.scale * ratio)
                dropped[j] = 1;
            return true;
        };
        for (std::size_t k = place[i] + 1; k < by_y.size() && drop_near(by_y[k]); ++k) continue;
        for (std::size_t k = place[i]; k > 0 && drop_near(by_y[k - 1]); --k) continue;
    }
    std::vector<Feature> kept;
    for (std::size_t i = 0; i < features.size(); ++i)
        if (dropped[i] == 0) kept.push_back(features[i]);
    return kept;
}

}  // namespace ism::detail
