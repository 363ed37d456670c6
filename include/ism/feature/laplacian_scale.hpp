// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "ism/core/parallel.hpp"
#include "ism/feature/feature.hpp"
#include "ism/feature/local_maxima.hpp"
#include "ism/feature/scale_space.hpp"

namespace ism::detail {

/// Normalised Laplacian σ²·(Lxx + Lyy) at (x, y), pixels of the octave, half a level above `layer`: as the
/// heat equation has it, the difference of the two levels over the logarithm of their ratio. Between the
/// pixels a quadratic. Layers beyond the octave are taken from the neighbouring one; NaN where there is none.
[[nodiscard]] inline float laplacian(const ScaleSpace& space, int octave, int layer, float x, float y) {
    const int levels_an_octave = space.levels_per_octave();
    if (layer < 0) octave -= 1, layer += levels_an_octave, x *= 2, y *= 2;
    if (layer + 1 >= space.levels()) octave += 1, layer -= levels_an_octave, x /= 2, y /= 2;
    if (octave < 0 || octave >= space.octaves()) return std::numeric_limits<float>::quiet_NaN();
    const ImageView<const float> fine = space.level(octave, layer), coarse = space.level(octave, layer + 1);
    const int cx = std::clamp(int(std::lround(x)), 1, fine.width() - 2);
    const int cy = std::clamp(int(std::lround(y)), 1, fine.height() - 2);
    const auto at = [&](int i, int j) { return coarse(cx + i, cy + j) - fine(cx + i, cy + j); };
    const float dx = x - float(cx), dy = y - float(cy), middle = at(0, 0);
    const float value = middle + 0.5f * (dx * (at(1, 0) - at(-1, 0)) + dy * (at(0, 1) - at(0, -1))) +
                        0.5f * (dx * dx * (at(1, 0) - 2 * middle + at(-1, 0)) +
                                dy * dy * (at(0, 1) - 2 * middle + at(0, -1))) +
                        0.25f * dx * dy * (at(1, 1) - at(-1, 1) - at(1, -1) + at(-1, -1));
    return value * float(levels_an_octave) / std::numbers::ln2_v<float>;
}

/// The level, refined by a parabola, at which the Laplacian at (x, y) has an extremum over scale, within
/// `tolerance` levels of `level`; nothing where there is none.
[[nodiscard]] inline std::optional<float> characteristic_level(const ScaleSpace& space, int octave,
                                                               float level, float tolerance, float x, float y,
                                                               float least) {
    const int first = int(std::ceil(level - tolerance)) - 1, last = int(std::floor(level + tolerance));
    std::optional<float> best;
    float before = laplacian(space, octave, first - 1, x, y), middle = laplacian(space, octave, first, x, y);
    for (int layer = first; layer <= last; ++layer) {
        const float after = laplacian(space, octave, layer + 1, x, y);
        const float sign = middle < 0 ? -1.0f : 1.0f, peak = sign * middle;
        if (peak >= least && peak > sign * before && peak >= sign * after) {
            const float at = float(layer) + 0.5f + parabola_top(sign * before, peak, sign * after);
            const float off = std::fabs(at - level);
            if (off <= tolerance && (!best || off < std::fabs(*best - level))) best = at;
        }
        before = middle, middle = after;
    }
    return best;
}

/// What Harris- and Hessian-Laplace share: which levels give the response, where its scale is looked for.
struct ScaleSelection {
    int first_level = 0;          ///< of the S levels of each octave whose response is searched
    float scale_offset = 0;       ///< the Laplacian is looked at so many levels further
    float scale_tolerance = 0.5;  ///< its extremum lies at most so many octaves from there
    float threshold = 0;          ///< least response
    float least_laplacian = 0;    ///< least |normalised Laplacian|
    int border = 5;               ///< pixels of the octave without features along the edge
};

inline constexpr int band_rows = 64;

/// Maxima in the plane of a response whose scale is characteristic. `respond(octave, level, first, end,
/// out)` writes the response of the rows first … end − 1 of a level into the rows of `out`.
template <std::invocable<int, int, int, int, ImageView<float>> Respond>
[[nodiscard]] std::vector<Feature> scale_selected_maxima(const ScaleSpace& space,
                                                         const ScaleSelection& selection, unsigned threads,
                                                         const Respond& respond) {
    const float tolerance = selection.scale_tolerance * float(space.levels_per_octave());
    std::vector<Feature> all;
    for (int octave = 0; octave < space.octaves(); ++octave) {
        const int width = space.level(octave, 0).width(), height = space.level(octave, 0).height();
        const int border = std::max(2, selection.border);
        const int rows = height - 2 * border;
        if (rows <= 0 || width <= 2 * border) continue;
        const std::size_t bands = std::size_t((rows + band_rows - 1) / band_rows);
        std::vector<std::vector<Feature>> found(bands * std::size_t(space.levels_per_octave()));
        parallel_for(found.size(), threads, [&](std::size_t task) {
            const int level = selection.first_level + int(task / bands);
            const int first = border + int(task % bands) * band_rows;
            const int end = std::min(first + band_rows, border + rows);
            Image<float> values(width, end - first + 2);
            respond(octave, level, first - 1, end + 1, values.view());
            const ImageView<const float> response = values.view();
            for (int j = 1; j <= end - first; ++j)
                for (int x = border; x < width - border; ++x) {
                    if (!(response(x, j) > selection.threshold) || !is_maximum(response, x, j)) continue;
                    const SubPixel top = refine_maximum(response, x, j);
                    const float px = float(x) + top.dx, py = float(first - 1 + j) + top.dy;
                    const auto at = characteristic_level(space, octave, float(level) + selection.scale_offset,
                                                         tolerance, px, py, selection.least_laplacian);
                    if (!at) continue;
                    const float step = space.step(octave);
                    found[task].push_back({.x = px * step,
                                           .y = py * step,
                                           .scale = space.sigma(octave, *at),
                                           .strength = top.value});
                }
        });
        std::vector<Feature> features;
        for (const auto& part : found) features.insert(features.end(), part.begin(), part.end());
        sort_unique(features);
        all.insert(all.end(), features.begin(), features.end());
    }
    return without_duplicates(all, 0.5f, std::exp2(0.5f));
}

}  // namespace ism::detail
