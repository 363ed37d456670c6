// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "ism/core/camera.hpp"
#include "ism/core/image.hpp"
#include "ism/core/order.hpp"
#include "ism/feature/feature.hpp"

namespace ism {

/// @brief The share of a window's pixels that must have a reading for the window to have a depth.
inline constexpr double min_depth_share = 0.25;

/// @brief Depth at a place: the median of the readings of the pixels whose centres are within `radius` pixels
/// of (x, y), always the pixel nearest to it included; of two middle readings the nearer, so that it is a
/// reading and not a mean of object and background. no_depth where fewer than min_depth_share of these
/// pixels, those outside the image not counted, have one, or (x, y) is outside the image.
[[nodiscard]] inline float depth_at(ImageView<const float> depth_m, float x, float y, float radius) {
    if (!(x > -0.5f && y > -0.5f && x < float(depth_m.width()) - 0.5f && y < float(depth_m.height()) - 0.5f))
        return no_depth;
    const float reach = std::isfinite(radius) ? std::max(0.0f, radius) : 0.0f;
    const int nearest_x = std::min(int(x + 0.5f), depth_m.width() - 1);
    const int nearest_y = std::min(int(y + 0.5f), depth_m.height() - 1);
    const int x0 = int(std::max(0.0f, std::floor(x - reach))),
              y0 = int(std::max(0.0f, std::floor(y - reach)));
    const int x1 = int(std::min(float(depth_m.width() - 1), x + reach + 1));
    const int y1 = int(std::min(float(depth_m.height() - 1), y + reach + 1));
    std::size_t pixels = 0;
    std::vector<float> readings;
    for (int j = y0; j <= y1; ++j)
        for (int i = x0; i <= x1; ++i) {
            const float dx = float(i) - x, dy = float(j) - y;
            if (dx * dx + dy * dy > reach * reach && !(i == nearest_x && j == nearest_y)) continue;
            ++pixels;
            if (is_depth(depth_m(i, j))) readings.push_back(depth_m(i, j));
        }
    if (readings.empty() || double(readings.size()) < min_depth_share * double(pixels)) return no_depth;
    return detail::nth_smallest(readings, (readings.size() - 1) / 2);
}

/// @brief Gives each feature the depth_at() its place within a radius of one scale, at least 1 and at most 8
/// pixels. A feature whose neighbourhood has too few readings gets NaN: it casts no vote in a space with
/// depth. `depth_m` is registered to the image the features came from and has its size.
/// @throws Error where the depth image is empty.
[[nodiscard]] inline std::vector<Feature> with_depth(std::vector<Feature> features,
                                                     ImageView<const float> depth_m) {
    expect(!depth_m.empty(), "depth image size", "at least 1x1", size_text(depth_m));
    for (Feature& f : features) f.depth_m = depth_at(depth_m, f.x, f.y, std::clamp(f.scale, 1.0f, 8.0f));
    return features;
}

}  // namespace ism
