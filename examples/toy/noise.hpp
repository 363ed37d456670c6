// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "toy/vec.hpp"

#include "ism/core/random.hpp"

namespace toy {

/// @brief 32 well mixed bits for a cell (x, y) of pattern `seed`.
[[nodiscard]] constexpr std::uint32_t hash_cell(int x, int y, std::uint32_t seed) {
    std::uint32_t h = seed * 0x9e3779b1u ^ std::uint32_t(x) * 0x85ebca77u ^ std::uint32_t(y) * 0xc2b2ae3du;
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    return h ^ (h >> 15);
}

/// @brief The same as a number in [0, 1).
[[nodiscard]] constexpr float hash_unit(int x, int y, std::uint32_t seed) {
    return float(hash_cell(x, y, seed) >> 8) * 0x1.0p-24f;
}

/// @brief A seed of its own for part `part` of pattern `seed`.
[[nodiscard]] constexpr std::uint64_t derived_seed(std::uint64_t seed, std::uint64_t part) {
    ism::Random mixer(seed * 0xd1342543de82ef95u + part);
    return mixer.bits();
}

/// @brief The largest whole number not above x.
[[nodiscard]] constexpr int floor_int(float x) {
    const int i = int(x);
    return float(i) > x ? i - 1 : i;
}

/// @brief Smooth noise with cells of size 1, values 0 … 1 (value noise).
[[nodiscard]] inline float value_noise(float x, float y, std::uint32_t seed) {
    const int ix = floor_int(x), iy = floor_int(y);
    float fx = x - float(ix), fy = y - float(iy);
    fx = fx * fx * (3 - 2 * fx), fy = fy * fy * (3 - 2 * fy);
    const float top = mix(hash_unit(ix, iy, seed), hash_unit(ix + 1, iy, seed), fx);
    const float bottom = mix(hash_unit(ix, iy + 1, seed), hash_unit(ix + 1, iy + 1, seed), fx);
    return mix(top, bottom, fy);
}

/// @brief Sum of `octaves` noises, each half as large and twice as fine as the one before, 0 … 1.
[[nodiscard]] inline float cloud_noise(float x, float y, std::uint32_t seed, int octaves) {
    float sum = 0, weight = 0.5f, total = 0;
    for (int i = 0; i < octaves; ++i) {
        sum += weight * value_noise(x, y, seed + std::uint32_t(i));
        total += weight;
        x = x * 2.03f + 3.1f, y = y * 2.03f + 7.7f, weight *= 0.5f;
    }
    return sum / total;
}

/// @brief A linear colour of hue (0 … 1 around the circle), saturation and value.
[[nodiscard]] inline Vec hsv(float hue, float saturation, float value) {
    const auto channel = [&](float shift) {
        const float k = std::fmod(hue + shift, 1.0f) * 6;
        const float t = std::clamp(std::abs(k - 3) - 1, 0.0f, 1.0f);
        return value * mix(1.0f, t, saturation);
    };
    const Vec shown{channel(1.0f), channel(2.0f / 3), channel(1.0f / 3)};
    return shown * shown;  // roughly from screen to linear light
}

/// @brief A random colour between two limits of hue, saturation and value.
[[nodiscard]] inline Vec random_hsv(ism::Random& random, Vec low, Vec high) {
    const Vec c{float(random.uniform(low.x, high.x)), float(random.uniform(low.y, high.y)),
                float(random.uniform(low.z, high.z))};
    return hsv(c.x, c.y, c.z);
}

}  // namespace toy
