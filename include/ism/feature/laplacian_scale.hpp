// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "ism/core/callable.hpp"
#include "ism/feature/feature.hpp"
#include "ism/feature/local_maxima.hpp"
#include "ism/feature/range.hpp"
#include "ism/feature/row_detector.hpp"
#include "ism/feature/scale_space.hpp"
#include "ism/feature/workspace.hpp"

namespace ism::detail {

/// Normalised Laplacian σ²·(Lxx + Lyy) at (x, y), pixels of the octave, half a level above `layer`: as the
/// heat equation has it, the difference of the two levels over the logarithm of their ratio. Between the
/// pixels a quadratic. Layers beyond the octave are taken from the one that has them; NaN where there is
/// none.
[[nodiscard]] inline float laplacian(const ScaleSpace& space, int octave, int layer, float x, float y) {
    const int levels_an_octave = space.levels_per_octave();
    for (; layer < 0; --octave) layer += levels_an_octave, x *= 2, y *= 2;
    for (; layer + 1 >= space.levels(); ++octave) layer -= levels_an_octave, x /= 2, y /= 2;
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
    float scale_offset = 0;       ///< levels from the one searched to where the Laplacian is evaluated
    float scale_tolerance = 0.5;  ///< octaves from there to its extremum, at most
    float threshold = 0;          ///< least response
    float least_laplacian = 0;    ///< least |normalised Laplacian|
    int border = 5;               ///< pixels of the octave without features along the edge
};

/// Appends the maxima of a response, whose row 1 is row `first` of the level, that have a scale.
inline void keep_maxima(const ScaleSpace& space, const ScaleSelection& selection, int octave, int level,
                        int first, ImageView<const float> response, std::vector<Feature>& found) {
    const float tolerance = selection.scale_tolerance * float(space.levels_per_octave());
    const float step = space.step(octave);
    const int border = std::max(2, selection.border);
    for (int j = 1; j + 1 < response.height(); ++j)
        for (int x = border; x < response.width() - border; ++x) {
            if (!(response(x, j) > selection.threshold) || !is_maximum(response, x, j)) continue;
            const SubPixel top = refine_maximum(response, x, j);
            const float px = float(x) + top.dx, py = float(first - 1 + j) + top.dy;
            const auto at = characteristic_level(space, octave, float(level) + selection.scale_offset,
                                                 tolerance, px, py, selection.least_laplacian);
            if (!at) continue;
            const Feature feature{
                .x = px * step, .y = py * step, .scale = space.sigma(octave, *at), .strength = top.value};
            found.push_back(feature);
        }
}

/// Validates what the options of Harris- and Hessian-Laplace have in common.
inline void check_scale_selection(float least_laplacian, float scale_tolerance, int border) {
    expect_range("least_laplacian", least_laplacian, 0.0f, max_threshold);
    expect_range("scale_tolerance (octaves)", scale_tolerance, 0.01f, 1.0f);
    expect_range("border (pixels)", border, 0, max_border);
}

/// The reach of search_scale_selected(), without that of the response itself.
[[nodiscard]] inline SearchReach scale_selection_reach(const ScaleSpace& space,
                                                       const ScaleSelection& selection) {
    const int levels = space.levels_per_octave();
    const float tolerance = selection.scale_tolerance * float(levels);
    const float finest = float(selection.first_level) + selection.scale_offset;
    SearchReach reach{.rows = 8};  // a pixel and a half here is six pixels two octaves finer
    int lowest = int(std::ceil(finest - tolerance)) - 2;
    int highest = int(std::floor(finest + float(levels - 1) + tolerance)) + 1, up = 0;
    for (; lowest < 0; ++reach.octaves) lowest += levels;
    for (; highest + 1 >= space.levels(); ++up) highest -= levels;
    reach.octaves = std::max(reach.octaves, up);
    return reach;
}

/// Appends the maxima in the plane of a response whose scale is characteristic, of the rows first … end − 1
/// of an octave. `respond(level, first, end, out, memory)` writes the response of rows of a level into the
/// rows of `out`; `memory_for(level, rows)` gives the scratch floats it needs.
template <class MemoryFor, class Respond>
requires Callable<MemoryFor, int, int> && Callable<Respond, int, int, int, ImageView<float>, std::span<float>>
void search_scale_selected(const ScaleSpace& space, const ScaleSelection& selection, int octave, int first,
                           int end, Workspace& workspace, unsigned worker, std::vector<Feature>& found,
                           const MemoryFor& memory_for, const Respond& respond) {
    const int border = std::max(2, selection.border), width = space.level(octave, 0).width();
    first = std::max(first, border), end = std::min(end, space.level_height(octave) - border);
    if (first >= end || width <= 2 * border) return;
    const int rows = end - first + 2;
    const std::size_t size = std::size_t(width) * std::size_t(rows);
    for (int i = 0; i < space.levels_per_octave(); ++i) {
        const int level = selection.first_level + i;
        const auto memory = workspace.rows(worker, size + memory_for(level, rows));
        const ImageView<float> response(memory.data(), width, rows, width);
        respond(level, first - 1, end + 1, response, memory.subspan(size));
        keep_maxima(space, selection, octave, level, first, response, found);
    }
}

/// Leaves the strongest of features that are less than half a scale and half an octave apart.
inline void drop_scale_selected(std::vector<Feature>& features, Workspace& workspace) {
    drop_duplicates(features, 0.5f, std::exp2(0.5f), workspace);
}

}  // namespace ism::detail
