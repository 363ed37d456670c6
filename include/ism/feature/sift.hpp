// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <numbers>
#include <span>
#include <string_view>
#include <vector>

#include "ism/core/parallel.hpp"
#include "ism/feature/descriptor.hpp"

namespace ism {

namespace detail {

inline constexpr int sift_cells = 4;   // along a side
inline constexpr int sift_angles = 8;  // in a cell
inline constexpr float sift_cell = 3;  // side of a cell in units of the feature's scale
inline constexpr std::size_t sift_size = sift_cells * sift_cells * sift_angles;
inline constexpr std::size_t features_per_task = 64;

/// Calls `body(i)` for each feature, many to a task.
template <std::invocable<std::size_t> Body>
void for_each_feature(std::size_t count, unsigned threads, const Body& body) {
    parallel_for((count + features_per_task - 1) / features_per_task, threads, [&](std::size_t task) {
        const std::size_t first = task * features_per_task;
        for (std::size_t i = first; i < std::min(count, first + features_per_task); ++i) body(i);
    });
}

/// The level nearest to each feature, with the gradients of all of them ready.
[[nodiscard]] inline std::vector<LevelIndex> gradient_levels(const ScaleSpace& space,
                                                             std::span<const Feature> features,
                                                             unsigned threads) {
    std::vector<LevelIndex> levels(features.size());
    std::vector<char> ready(std::size_t(space.octaves()) * std::size_t(space.levels()));
    for (std::size_t i = 0; i < features.size(); ++i) {
        levels[i] = space.nearest_level(features[i].scale);
        char& is_ready =
            ready[std::size_t(levels[i].octave) * std::size_t(space.levels()) + std::size_t(levels[i].level)];
        if (is_ready == 0) (void)space.gradient(levels[i].octave, levels[i].level, threads);
        is_ready = 1;
    }
    return levels;
}

/// exp(−t²/2) for the distances t = (first + i − centre) · factor.
[[nodiscard]] inline std::vector<float> gaussian_weights(int first, int count, float centre, float factor) {
    std::vector<float> weights(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        const float t = (float(first + i) - centre) * factor;
        weights[std::size_t(i)] = std::exp(-0.5f * t * t);
    }
    return weights;
}

/// The histogram of gradient directions in 4×4 cells, each gradient shared between the neighbouring cells and
/// directions and weighted by a Gaussian of half the window's side (Lowe 2004, section 6.1), not yet
/// normalised.
inline void sift_histogram(const GradientView& gradient, float x, float y, float sigma, float angle,
                           std::span<float, sift_size> out) {
    constexpr int padded = sift_cells + 2, bins = sift_angles + 1;
    std::array<float, padded * padded * bins> histogram{};
    const float cosine = std::cos(angle) / (sift_cell * sigma), sine = std::sin(angle) / (sift_cell * sigma);
    // half a side of the upright square around the turned window and half a cell more
    const float reach = 0.5f * (sift_cells + 1) * sift_cell * sigma *
                        (std::fabs(std::cos(angle)) + std::fabs(std::sin(angle)));
    const ImageView<const float> image = gradient.magnitude;
    const int x0 = int(std::max(0.0f, std::ceil(x - reach)));
    const int y0 = int(std::max(0.0f, std::ceil(y - reach)));
    const int x1 = int(std::min(float(image.width() - 1), std::floor(x + reach)));
    const int y1 = int(std::min(float(image.height() - 1), std::floor(y + reach)));
    std::fill(out.begin(), out.end(), 0.0f);
    if (x0 > x1 || y0 > y1) return;
    const std::vector<float> weight_x =
        gaussian_weights(x0, x1 - x0 + 1, x, 2 / (sift_cell * sift_cells * sigma));

    constexpr float bin_width = 2 * std::numbers::pi_v<float> / sift_angles;
    const float turn = angle / bin_width;
    for (int j = y0; j <= y1; ++j) {
        const float dy = float(j) - y, ty = dy * 2 / (sift_cell * sift_cells * sigma);
        const float weight_y = std::exp(-0.5f * ty * ty);
        const float* magnitude = gradient.magnitude.row(j).data();
        const float* direction = gradient.angle.row(j).data();
        for (int i = x0; i <= x1; ++i) {
            const float dx = float(i) - x;
            // cells from −1 (half a cell before the first) to 4; +1 for the padding
            const float u = cosine * dx + sine * dy + (sift_cells + 1) * 0.5f;
            const float v = cosine * dy - sine * dx + (sift_cells + 1) * 0.5f;
            if (!(u > 0 && v > 0 && u < sift_cells + 1 && v < sift_cells + 1)) continue;
            float bin = direction[i] * (1 / bin_width) - turn;
            bin += bin < 0 ? float(sift_angles) : 0.0f;
            bin += bin < 0 ? float(sift_angles) : 0.0f;
            bin -= bin >= sift_angles ? float(sift_angles) : 0.0f;
            const int iu = int(u), iv = int(v), ib = std::min(int(bin), sift_angles - 1);
            const float au = u - float(iu), av = v - float(iv), ab = bin - float(ib);
            const float value = magnitude[i] * weight_x[std::size_t(i - x0)] * weight_y;
            float* cell = histogram.data() + (iv * padded + iu) * bins + ib;
            const float low = value * (1 - av), high = value * av;
            const float ll = low * (1 - au), lh = low * au, hl = high * (1 - au), hh = high * au;
            cell[0] += ll * (1 - ab), cell[1] += ll * ab;
            cell[bins] += lh * (1 - ab), cell[bins + 1] += lh * ab;
            cell += padded * bins;
            cell[0] += hl * (1 - ab), cell[1] += hl * ab;
            cell[bins] += hh * (1 - ab), cell[bins + 1] += hh * ab;
        }
    }
    for (int v = 0; v < sift_cells; ++v)
        for (int u = 0; u < sift_cells; ++u) {
            float* cell = histogram.data() + ((v + 1) * padded + u + 1) * bins;
            cell[0] += cell[sift_angles];
            std::copy_n(cell, sift_angles, out.data() + (v * sift_cells + u) * sift_angles);
        }
}

/// To unit length, no number above 0.2, to unit length again; all 0 stays so.
inline void normalise_sift(std::span<float, sift_size> row) {
    for (const bool clip : {true, false}) {
        float sum = 0;
        for (const float value : row) sum += value * value;
        if (!(sum > 1e-12f)) return std::fill(row.begin(), row.end(), 0.0f);
        const float factor = 1 / std::sqrt(sum);
        for (float& value : row) value = clip ? std::min(value * factor, 0.2f) : value * factor;
    }
}

}  // namespace detail

/// @brief SIFT: histograms of 8 gradient directions in 4×4 cells of 3 scales a side, of unit length (Lowe
/// 2004, section 6). Number (row · 4 + column) · 8 + direction; rows run along y, directions from x towards
/// y, both turned by Feature::angle (upright where that is 0). A window without any gradient gives zeros.
struct Sift {
    using Scalar = float;
    static constexpr std::size_t dimension = detail::sift_size;
    static constexpr std::string_view name = "sift";
    static constexpr float support_radius = detail::sift_cell * detail::sift_cells / 2;
    static constexpr double sq_length = 1;

    [[nodiscard]] Descriptors<float, dimension> describe(const ScaleSpace& space,
                                                         std::span<const Feature> features,
                                                         unsigned threads) const {
        Descriptors<float, dimension> rows(features.size());
        const std::vector<LevelIndex> levels = detail::gradient_levels(space, features, threads);
        detail::for_each_feature(features.size(), threads, [&](std::size_t i) {
            const auto [octave, level] = levels[i];
            const Feature& f = features[i];
            const float pixels = 1 / space.step(octave);
            detail::sift_histogram(space.gradient(octave, level), f.x * pixels, f.y * pixels,
                                   f.scale * pixels, f.angle, rows.row(i));
            detail::normalise_sift(rows.row(i));
        });
        return rows;
    }
};

/// @brief RootSIFT: the square roots of SIFT divided by its sum, of unit length; Euclidean distance between
/// them is Hellinger's between SIFTs (Arandjelović & Zisserman 2012).
struct RootSift {
    using Scalar = float;
    static constexpr std::size_t dimension = Sift::dimension;
    static constexpr std::string_view name = "root-sift";
    static constexpr float support_radius = Sift::support_radius;
    static constexpr double sq_length = 1;

    [[nodiscard]] Descriptors<float, dimension> describe(const ScaleSpace& space,
                                                         std::span<const Feature> features,
                                                         unsigned threads) const {
        Descriptors<float, dimension> rows = Sift{}.describe(space, features, threads);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            float sum = 0;
            for (const float value : rows.row(i)) sum += value;
            if (!(sum > 0)) continue;
            for (float& value : rows.row(i)) value = std::sqrt(value / sum);
        }
        return rows;
    }
};

}  // namespace ism
