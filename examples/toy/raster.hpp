// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "ism/core/image.hpp"

namespace toy {

/// @brief A corner on the raster: place in samples (sample centres at whole numbers) and nearness; of two
/// surfaces on one sample the one with the larger nearness is seen.
struct RasterPoint {
    float x = 0, y = 0, nearness = 0;
};

/// @brief Calls hit(x, y, nearness) for each sample of a width × height raster inside the triangle.
/// Nearness must be linear over the raster: 1 / depth for a pinhole camera, depth for parallel light.
template <class Hit>
requires requires(Hit hit) {
    hit(0, 0, 0.0f);
}
void for_each_sample(const std::array<RasterPoint, 3>& corners, int width, int height, Hit&& hit) {
    const auto& [a, b, c] = corners;
    const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area == 0 || !std::isfinite(area)) return;
    const int left = int(std::max(0.0f, std::ceil(std::min({a.x, b.x, c.x}))));
    const int right = int(std::min(float(width - 1), std::floor(std::max({a.x, b.x, c.x}))));
    const int top = int(std::max(0.0f, std::ceil(std::min({a.y, b.y, c.y}))));
    const int bottom = int(std::min(float(height - 1), std::floor(std::max({a.y, b.y, c.y}))));
    const float inverse = 1 / area, inside = -1e-5f;  // a hair over the edge, so that neighbours leave no gap
    for (int y = top; y <= bottom; ++y)
        for (int x = left; x <= right; ++x) {
            const float px = float(x), py = float(y);
            const float wb = ((px - a.x) * (c.y - a.y) - (py - a.y) * (c.x - a.x)) * inverse;
            const float wc = ((b.x - a.x) * (py - a.y) - (b.y - a.y) * (px - a.x)) * inverse;
            const float wa = 1 - wb - wc;
            if (wa >= inside && wb >= inside && wc >= inside)
                hit(x, y, wa * a.nearness + wb * b.nearness + wc * c.nearness);
        }
}

/// @brief What is seen at each sample: its nearness and the number of the triangle, −1 where there is none.
struct RasterTarget {
    RasterTarget(int width, int height, float background = 0)
        : nearness(width, height, background), triangle(width, height, -1) {}

    /// @brief Draws a triangle where it is nearer than what is there.
    void draw(const std::array<RasterPoint, 3>& corners, std::int32_t number) {
        for_each_sample(corners, nearness.width(), nearness.height(), [&](int x, int y, float value) {
            float& old = nearness(x, y);
            if (value > old) old = value, triangle(x, y) = number;
        });
    }

    ism::Image<float> nearness;
    ism::Image<std::int32_t> triangle;
};

}  // namespace toy
