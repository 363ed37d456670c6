// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "ism/feature/local_maxima.hpp"
#include "ism/feature/sift.hpp"

namespace ism {

/// @brief How dominant gradient directions are found.
struct OrientationOptions {
    float window = 1.5f;      ///< deviation of the Gaussian window, in units of the feature's scale
    float peak_ratio = 0.8f;  ///< a further direction counts from this share of the strongest on
    int max_peaks = 4;        ///< at most so many directions a feature
};

namespace detail {

/// The dominant directions at (x, y), strongest first, radians in (−π, π]. Never 0 itself, which means
/// upright.
[[nodiscard]] inline std::vector<float> dominant_directions(const GradientView& gradient, float x, float y,
                                                            float sigma, const OrientationOptions& options) {
    constexpr int bins = 36;
    constexpr float bin_width = 2 * std::numbers::pi_v<float> / bins;
    std::array<float, bins> histogram{};
    const float deviation = options.window * sigma, reach = 3 * deviation;
    const ImageView<const float> image = gradient.magnitude;
    const int x0 = int(std::max(0.0f, std::ceil(x - reach)));
    const int y0 = int(std::max(0.0f, std::ceil(y - reach)));
    const int x1 = int(std::min(float(image.width() - 1), std::floor(x + reach)));
    const int y1 = int(std::min(float(image.height() - 1), std::floor(y + reach)));
    if (x0 > x1 || y0 > y1) return {};
    const std::vector<float> weight_x = gaussian_weights(x0, x1 - x0 + 1, x, 1 / deviation);
    const std::vector<float> weight_y = gaussian_weights(y0, y1 - y0 + 1, y, 1 / deviation);
    for (int j = y0; j <= y1; ++j)
        for (int i = x0; i <= x1; ++i) {
            if ((float(i) - x) * (float(i) - x) + (float(j) - y) * (float(j) - y) > reach * reach) continue;
            const float bin = gradient.angle(i, j) / bin_width + bins;  // bin b is centred at b · bin_width
            const int below = int(bin);
            const float share = bin - float(below);
            const float value =
                gradient.magnitude(i, j) * weight_x[std::size_t(i - x0)] * weight_y[std::size_t(j - y0)];
            histogram[std::size_t(below % bins)] += (1 - share) * value;
            histogram[std::size_t((below + 1) % bins)] += share * value;
        }
    for (int round = 0; round < 6; ++round) {
        const std::array<float, bins> old = histogram;
        for (std::size_t b = 0; b < bins; ++b)
            histogram[b] = (old[(b + bins - 1) % bins] + old[b] + old[(b + 1) % bins]) / 3;
    }
    struct Peak {
        float height, angle;
    };
    std::vector<Peak> peaks;
    const float least = options.peak_ratio * *std::max_element(histogram.begin(), histogram.end());
    for (std::size_t b = 0; b < bins; ++b) {
        const float before = histogram[(b + bins - 1) % bins], after = histogram[(b + 1) % bins];
        const float height = histogram[b];
        if (!(height > before && height >= after && height >= least)) continue;
        float angle = (float(b) + parabola_top(before, height, after)) * bin_width;
        if (angle > std::numbers::pi_v<float>) angle -= 2 * std::numbers::pi_v<float>;
        peaks.push_back({height, angle == 0 ? 1e-6f : angle});
    }
    std::stable_sort(peaks.begin(), peaks.end(),
                     [](const Peak& a, const Peak& b) { return a.height > b.height; });
    std::vector<float> directions;
    for (const Peak& peak : peaks)
        if (int(directions.size()) < options.max_peaks) directions.push_back(peak.angle);
    return directions;
}

}  // namespace detail

/// @brief Gives each feature the dominant direction of the gradients around it (Lowe 2004, section 5); where
/// several are almost as strong the feature is repeated, one after the other, strongest first. A feature
/// without any gradient around it stays upright.
/// @throws Error where an option is out of range.
[[nodiscard]] inline std::vector<Feature> assign_orientations(const ScaleSpace& space,
                                                              std::span<const Feature> features,
                                                              unsigned threads,
                                                              const OrientationOptions& options = {}) {
    expect(options.window > 0, "orientation window (scales)", "a positive number", options.window);
    expect(options.peak_ratio > 0 && options.peak_ratio <= 1, "orientation peak_ratio", "above 0, up to 1",
           options.peak_ratio);
    expect(options.max_peaks >= 1, "orientation max_peaks", "1 or more", options.max_peaks);
    std::vector<std::vector<float>> directions(features.size());
    const std::vector<LevelIndex> levels = detail::gradient_levels(space, features, threads);
    detail::for_each_feature(features.size(), threads, [&](std::size_t i) {
        const auto [octave, level] = levels[i];
        const float pixels = 1 / space.step(octave);
        directions[i] =
            detail::dominant_directions(space.gradient(octave, level), features[i].x * pixels,
                                        features[i].y * pixels, features[i].scale * pixels, options);
    });
    std::vector<Feature> oriented;
    oriented.reserve(features.size() + features.size() / 4);
    for (std::size_t i = 0; i < features.size(); ++i) {
        if (directions[i].empty()) oriented.push_back(features[i]);
        for (const float angle : directions[i]) {
            oriented.push_back(features[i]);
            oriented.back().angle = angle;
        }
    }
    return oriented;
}

}  // namespace ism
