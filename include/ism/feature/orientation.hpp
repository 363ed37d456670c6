// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "ism/core/order.hpp"
#include "ism/feature/for_each_feature.hpp"
#include "ism/feature/gradient.hpp"
#include "ism/feature/local_maxima.hpp"
#include "ism/feature/range.hpp"
#include "ism/feature/scale_space.hpp"
#include "ism/feature/workspace.hpp"

namespace ism {

/// @brief How dominant gradient directions are found.
struct OrientationOptions {
    float window = 1.5f;      ///< deviation of the Gaussian window, in units of the feature's scale
    float peak_ratio = 0.8f;  ///< a further direction counts from this share of the strongest on
    int max_peaks = 4;        ///< at most this many directions a feature
};

/// @brief Validates `options`.
/// @throws Error where one is out of range.
inline void check(const OrientationOptions& options) {
    detail::expect_range("orientation window (scales)", options.window, 0.1f, 16.0f);
    detail::expect_range("orientation peak_ratio", options.peak_ratio, 0.01f, 1.0f);
    detail::expect_range("orientation max_peaks", options.max_peaks, 1, 18);
}

namespace detail {

inline constexpr std::size_t direction_bins = 36;
using DirectionHistogram = std::array<float, direction_bins>;

/// Gradients around (x, y) by direction, weighted by a Gaussian, bin b centred at b · 10°; then six times
/// the mean of three neighbours.
[[nodiscard]] inline DirectionHistogram direction_histogram(ImageView<const float> image, float x, float y,
                                                            float sigma, float window) {
    constexpr float per_radian = direction_bins / (2 * std::numbers::pi_v<float>);
    const float deviation = window * sigma, reach = 3 * deviation;
    const int y0 = int(std::min(float(image.height()), std::max(1.0f, std::ceil(y - reach))));
    const int y1 = int(std::max(0.0f, std::min(std::floor(y + reach), float(image.height() - 2))));
    // from −π to π, and two bins more for what comes after π
    std::array<float, direction_bins + 2> histogram{};
    GradientBatch batch;
    const auto share_out = [&] {
        batch.make_polar();
        GradientBatch::Numbers value, bin;
        const float factor = 0.5f / (deviation * deviation);
        for (std::size_t k = 0; k < batch.count; ++k) {
            // e^−t, t ≤ 4.5, as the fourth power of e^−t/4
            const float root =
                small_exp(0.25f * factor * (batch.dx[k] * batch.dx[k] + batch.dy[k] * batch.dy[k]));
            value[k] = batch.magnitude[k] * (root * root) * (root * root);
            bin[k] = batch.angle[k] * per_radian + direction_bins / 2;
        }
        for (std::size_t k = 0; k < batch.count; ++k) {
            const int below = std::clamp(int(bin[k]), 0, int(direction_bins));
            const float share = (bin[k] - float(below)) * value[k];
            histogram[std::size_t(below)] += value[k] - share;
            histogram[std::size_t(below) + 1] += share;
        }
        batch.count = 0;
    };
    for (int row = y0; row <= y1; ++row) {
        const float dy = float(row) - y, half = std::sqrt(std::max(0.0f, reach * reach - dy * dy));
        const int x1 = int(std::max(0.0f, std::min(std::floor(x + half), float(image.width() - 2))));
        const float x0 = std::min(float(image.width()), std::max(1.0f, std::ceil(x - half)));
        for (int first = int(x0); first <= x1;) {
            const std::size_t count =
                std::min(std::size_t(x1 - first + 1), GradientBatch::capacity - batch.count);
            batch.add_row(image, first, row, count, x, y);
            first += int(count);
            if (batch.count == GradientBatch::capacity) share_out();
        }
    }
    share_out();
    histogram[0] += histogram[direction_bins];
    histogram[1] += histogram[direction_bins + 1];
    DirectionHistogram result;
    for (std::size_t b = 0; b < direction_bins; ++b)
        result[b] = histogram[(b + direction_bins / 2) % direction_bins];
    for (int round = 0; round < 6; ++round) {
        const DirectionHistogram old = result;
        for (std::size_t b = 1; b + 1 < direction_bins; ++b)
            result[b] = (old[b - 1] + old[b] + old[b + 1]) / 3;
        result.front() = (old.back() + old[0] + old[1]) / 3;
        result.back() = (old[direction_bins - 2] + old.back() + old[0]) / 3;
    }
    return result;
}

/// The directions of the peaks of a histogram, strongest first, radians in (−π, π]. Never 0 itself, which
/// means upright.
struct Directions {
    std::array<float, direction_bins / 2> angle;
    std::size_t count = 0;
};
[[nodiscard]] inline Directions dominant_directions(const DirectionHistogram& histogram,
                                                    const OrientationOptions& options) {
    constexpr float bin_width = 2 * std::numbers::pi_v<float> / direction_bins;
    std::array<float, direction_bins / 2> angles;
    std::array<Ranked, direction_bins / 2> peaks;
    std::size_t count = 0;
    const float least = options.peak_ratio * *std::max_element(histogram.begin(), histogram.end());
    for (std::size_t b = 0; b < direction_bins; ++b) {
        const float before = histogram[(b + direction_bins - 1) % direction_bins];
        const float after = histogram[(b + 1) % direction_bins], height = histogram[b];
        if (!(height > before && height >= after && height >= least)) continue;
        float angle = (float(b) + parabola_top(before, height, after)) * bin_width;
        if (angle > std::numbers::pi_v<float>) angle -= 2 * std::numbers::pi_v<float>;
        angles[count] = angle == 0 ? 1e-6f : angle;
        peaks[count] = {joined(falling(height), rising(angles[count])), std::uint32_t(count)};
        ++count;
    }
    sort_ranked(peaks.data(), count);
    Directions directions;
    directions.count = std::min(count, std::size_t(options.max_peaks));
    for (std::size_t i = 0; i < directions.count; ++i) directions.angle[i] = angles[peaks[i].index];
    return directions;
}

}  // namespace detail

/// @brief Gives each feature the dominant direction of the gradients around it (Lowe 2004, section 5); where
/// several are almost as strong the feature is repeated, one after the other, strongest first. A feature
/// without any gradient around it stays upright.
/// @throws Error where an option is out of range.
[[nodiscard]] inline std::vector<Feature> assign_orientations(ScaleSpace& space,
                                                              const std::vector<Feature>& features,
                                                              Workspace& workspace,
                                                              const OrientationOptions& options = {}) {
    check(options);
    const auto most = std::size_t(options.max_peaks);
    const auto counts = workspace.numbers(Scratch::directions, features.size());
    const auto angles = workspace.numbers(Scratch::angles, features.size() * most);
    detail::for_each_feature(
        space, features, 3 * options.window, [](const Feature& f) { return f.scale; }, workspace,
        [&](std::size_t i) {
            const Feature& f = features[i];
            const auto [image, step] = space.sampling(f.scale);
            const detail::Directions directions = detail::dominant_directions(
                detail::direction_histogram(image, f.x / step, f.y / step, f.scale / step, options.window),
                options);
            counts[i] = std::uint32_t(directions.count);
            for (std::size_t k = 0; k < directions.count; ++k)
                angles[i * most + k] = std::bit_cast<std::uint32_t>(directions.angle[k]);
        });
    std::vector<Feature> oriented = workspace.empty_list();
    for (std::size_t i = 0; i < features.size(); ++i) {
        if (counts[i] == 0) oriented.push_back(features[i]);
        for (std::size_t k = 0; k < counts[i]; ++k) {
            oriented.push_back(features[i]);
            oriented.back().angle = std::bit_cast<float>(angles[i * most + k]);
        }
    }
    return oriented;
}

}  // namespace ism
