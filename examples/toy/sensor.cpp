// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "toy/sensor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "toy/noise.hpp"

namespace toy {

ism::RawDepth sense_depth(const Rendering& scene, const ism::Camera& camera, const DepthSensor& sensor,
                          std::uint32_t seed) {
    const int width = scene.depth_m.width(), height = scene.depth_m.height();
    ism::RawDepth out(width, height);
    const float shift = float(camera.fx * sensor.baseline_m), to_steps = float(1 / sensor.step_per_m);
    for (int y = 0; y < height; ++y) {
        float reached = std::numeric_limits<float>::max();
        for (int x = width - 1; x >= 0; --x) {
            // Edges are found a little off, the same way for a few pixels.
            const int jump = int(value_noise(float(x) * 0.4f, float(y) * 0.4f, seed) * 3.99f) - 1;
            const int from = std::clamp(x + (jump == 2 ? 0 : jump), 0, width - 1);
            const float z = scene.depth_m(from, y), column = float(x) - shift / z;
            const bool hidden = column > reached + 0.5f;
            reached = std::min(reached, column);
            const float echo = scene.echo(from, y) *
                               (0.75f + 0.5f * value_noise(float(x) * 0.35f, float(y) * 0.35f, seed + 1u));
            if (hidden || echo < float(sensor.weakest_echo) || z < float(sensor.near_m) ||
                z > float(sensor.far_m))
                continue;
            // Noise as the sum of smooth and pixel noise with deviation noise_steps together.
            const float smooth = value_noise(float(x) * 0.5f, float(y) * 0.5f, seed + 2u) - 0.5f;
            const std::uint32_t h = hash_cell(x, y, seed + 3u);
            const float fine = float((h & 1023u) + ((h >> 10) & 1023u) + ((h >> 20) & 1023u)) / 1023 - 1.5f;
            const float noise = float(sensor.noise_steps) * (3.2f * smooth + 1.4f * fine);
            const float steps = std::round(to_steps / z + noise);
            out(x, y) = std::uint16_t(to_steps / steps * 1000 + 0.5f);
        }
    }
    return out;
}

ism::RgbImage sense_colour(const Rendering& scene, float exposure, const ColourSensor& sensor,
                           std::uint32_t seed) {
    const int width = scene.light.width(), height = scene.light.height();
    static constexpr int steps = 4096;
    std::vector<float> screen(steps + 1);
    for (int i = 0; i <= steps; ++i) {
        const float x = float(i) / steps * 2, soft = x / (1 + 0.18f * x) * 1.18f;  // bright things roll off
        screen[std::size_t(i)] = 255 * std::pow(std::min(soft, 1.0f), 1 / 2.2f);
    }
    ism::RgbImage out(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto at = [&](int i, int j) {
                return scene.light(std::clamp(i, 0, width - 1), std::clamp(j, 0, height - 1));
            };
            const Vec around = at(x - 1, y) + at(x + 1, y) + at(x, y - 1) + at(x, y + 1);
            Vec c = mix(at(x, y), around * 0.25f, sensor.blur);
            const float dx = float(2 * x - width) / float(width), dy = float(2 * y - height) / float(height);
            c = c * (exposure * (1 - sensor.vignette * 0.5f * (dx * dx + dy * dy)));
            const auto channel = [&](float value, std::uint32_t part) {
                const float level = screen[std::size_t(std::clamp(value * 0.5f, 0.0f, 1.0f) * steps)];
                const std::uint32_t h = hash_cell(x, y, seed + part);
                const float noise =
                    (float((h & 1023u) + ((h >> 10) & 1023u) + ((h >> 20) & 1023u)) / 1023 - 1.5f) * 2;
                return std::uint8_t(std::clamp(level + noise * sensor.noise + 0.5f, 0.0f, 255.0f));
            };
            out(x, y) = {channel(c.x, 1), channel(c.y, 2), channel(c.z, 3)};
        }
    return out;
}

}  // namespace toy
