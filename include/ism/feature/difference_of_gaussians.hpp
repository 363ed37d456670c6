// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "ism/feature/range.hpp"
#include "ism/feature/row_detector.hpp"

namespace ism {

/// @brief Blobs: extrema over place and scale of the difference of neighbouring Gaussian levels (Lowe 2004,
/// sections 3 and 4), with quadratic refinement of place and scale. The scale of a feature is the deviation
/// of the less blurred of the two levels; a Gaussian blob of deviation t is found at t / √(2^(1/S)).
/// strength = S · |D| at the extremum.
struct DifferenceOfGaussians {
    static constexpr std::string_view name = "dog";

    float contrast_threshold = 0.04f;  ///< least S · |D|, brightness 0 … 1
    float edge_ratio = 10;             ///< at most this ratio of the principal curvatures, ≥ 1
    int border = 5;                    ///< pixels of the octave without features along the edge, ≥ 1

    /// @brief Calls visit(name, value) for each option, for files.
    template <class Self, class Visit>
    static void each_parameter(Self& self, Visit&& visit) {
        visit("contrast_threshold", self.contrast_threshold);
        visit("edge_ratio", self.edge_ratio);
        visit("border", self.border);
    }

    /// @brief Validates the options.
    /// @throws Error where one is out of range.
    friend void check(const DifferenceOfGaussians& options) {
        detail::expect_range("contrast_threshold", options.contrast_threshold, 0.0f, detail::max_threshold);
        detail::expect_range("edge_ratio", options.edge_ratio, 1.0f, 1e9f);
        detail::expect_range("border (pixels)", options.border, 1, detail::max_border);
    }

    /// @throws Error where an option is out of range.
    [[nodiscard]] std::vector<Feature> detect(const ScaleSpace& space, Workspace& workspace) const {
        return search_all_rows(*this, space, workspace);
    }

    /// @brief See RowDetector.
    [[nodiscard]] SearchReach prepare(const ScaleSpace& /*space*/, const Workspace& /*workspace*/) const {
        check(*this);
        return {.rows = search_reach};
    }
    /// @brief See RowDetector.
    void search(const ScaleSpace& space, int octave, int first, int end, Workspace& workspace,
                unsigned worker, std::vector<Feature>& found) const {
        const ImageView<const float> level = space.level(octave, 0);
        first = std::max(first, border), end = std::min(end, level.height() - border);
        if (first >= end || level.width() <= 2 * border) return;
        const std::size_t size =
            3 * std::size_t(space.levels() - 1) * std::size_t(whole_lines(level.width()));
        search_rows(space, octave, first, end, workspace.rows(worker, size), found);
    }

    /// @brief See RowDetector.
    void finish(std::vector<Feature>& /*features*/, const Workspace& /*workspace*/) const {}

private:
    static constexpr int marks_at_once = 64;
    static constexpr int search_reach = 6;  // rows that the refinement may move to, and their neighbours

    /// The differences d(layer) = level(layer + 1) − level(layer) of three rows, which roll over the octave.
    struct Window {
        float* values;
        std::size_t width;
        [[nodiscard]] float* row(int layer, int y) const {
            return values + (std::size_t(layer) * 3 + std::size_t(y % 3)) * width;
        }
    };

    /// The same at one pixel, without storing it.
    struct Difference {
        const ScaleSpace& space;
        int octave;
        [[nodiscard]] float operator()(int x, int y, int layer) const {
            return space.level(octave, layer + 1)(x, y) - space.level(octave, layer)(x, y);
        }
    };

    void search_rows(const ScaleSpace& space, int octave, int first, int end, std::span<float> memory,
                     std::vector<Feature>& found) const {
        const int layers = space.levels() - 1, width = space.level(octave, 0).width();
        const Window window{memory.data(), std::size_t(whole_lines(width))};
        const auto load = [&](int y) {
            for (int layer = 0; layer < layers; ++layer) {
                const float* fine = space.level(octave, layer).row(y).data();
                const float* coarse = space.level(octave, layer + 1).row(y).data();
                float* __restrict to = window.row(layer, y);
                for (int x = 0; x < width; ++x) to[x] = coarse[x] - fine[x];
            }
        };
        const float least = 0.8f * contrast_threshold / float(space.levels_per_octave());
        const Difference difference{space, octave};
        load(first - 1), load(first);
        for (int y = first; y < end; ++y) {
            load(y + 1);
            for (int layer = 1; layer + 1 < layers; ++layer) {
                for (int x = border; x < width - border; x += marks_at_once) {
                    const int count = std::min(marks_at_once, width - border - x);
                    std::array<std::int32_t, marks_at_once> marked;
                    if (!mark(window, layer, x, y, count, least, marked)) continue;
                    for (int i = 0; i < count; ++i)
                        if (marked[std::size_t(i)] != 0 && is_extremum(window, x + i, y, layer))
                            if (const auto feature = refine(difference, x + i, y, layer))
                                found.push_back(*feature);
                }
            }
        }
    }

    /// Marks the strong pixels, of `count` from (x, y) on, that no neighbour to the left, right, above,
    /// below, before or after exceeds: few enough to look at one by one. False where there is none.
    static bool mark(const Window& window, int layer, int x, int y, int count, float least,
                     std::array<std::int32_t, marks_at_once>& marked) {
        const float *here = window.row(layer, y) + x, *above = window.row(layer, y - 1) + x,
                    *below = window.row(layer, y + 1) + x, *finer = window.row(layer - 1, y) + x,
                    *coarser = window.row(layer + 1, y) + x;
        std::int32_t any = 0;
        for (int i = 0; i < count; ++i) {
            const float v = here[i];
            const int high = int(v > least) & int(v >= here[i - 1]) & int(v >= here[i + 1]) &
                             int(v >= above[i]) & int(v >= below[i]) & int(v >= finer[i]) &
                             int(v >= coarser[i]);
            const int low = int(v < -least) & int(v <= here[i - 1]) & int(v <= here[i + 1]) &
                            int(v <= above[i]) & int(v <= below[i]) & int(v <= finer[i]) &
                            int(v <= coarser[i]);
            marked[std::size_t(i)] = high | low;
            any |= high | low;
        }
        return any != 0;
    }

    /// Whether a pixel exceeds all its 26 neighbours; those after it in (layer, y, x) order may be equal, so
    /// that a flat top gives one extremum.
    [[nodiscard]] static bool is_extremum(const Window& window, int x, int y, int layer) {
        const float value = window.row(layer, y)[x], sign = value > 0 ? 1.0f : -1.0f;
        for (int k = -1; k <= 1; ++k)
            for (int j = -1; j <= 1; ++j) {
                const float* row = window.row(layer + k, y + j) + x;
                for (int i = -1; i <= 1; ++i) {
                    const bool before = k < 0 || (k == 0 && (j < 0 || (j == 0 && i < 0)));
                    const float margin = sign * (value - row[i]);
                    if (before ? !(margin > 0) : !(margin >= 0)) return false;
                }
            }
        return true;
    }

    /// Moves to the extremum of the quadratic through the neighbours; nothing where it runs away, is weak or
    /// lies on an edge.
    [[nodiscard]] std::optional<Feature> refine(const Difference& d, int x, int y, int layer) const {
        const int searched_row = y;
        const ImageView<const float> level = d.space.level(d.octave, 0);
        const int layers_an_octave = d.space.levels_per_octave();
        for (int round = 0; round < 5; ++round) {
            const float value = d(x, y, layer);
            const float gx = 0.5f * (d(x + 1, y, layer) - d(x - 1, y, layer));
            const float gy = 0.5f * (d(x, y + 1, layer) - d(x, y - 1, layer));
            const float gs = 0.5f * (d(x, y, layer + 1) - d(x, y, layer - 1));
            const float xx = d(x + 1, y, layer) - 2 * value + d(x - 1, y, layer);
            const float yy = d(x, y + 1, layer) - 2 * value + d(x, y - 1, layer);
            const float ss = d(x, y, layer + 1) - 2 * value + d(x, y, layer - 1);
            const float xy = cross(d(x + 1, y + 1, layer), d(x - 1, y + 1, layer), d(x + 1, y - 1, layer),
                                   d(x - 1, y - 1, layer));
            const float xs = cross(d(x + 1, y, layer + 1), d(x - 1, y, layer + 1), d(x + 1, y, layer - 1),
                                   d(x - 1, y, layer - 1));
            const float ys = cross(d(x, y + 1, layer + 1), d(x, y - 1, layer + 1), d(x, y + 1, layer - 1),
                                   d(x, y - 1, layer - 1));
            // cofactors of the symmetric Hessian
            const float cxx = yy * ss - ys * ys, cxy = xs * ys - xy * ss, cxs = xy * ys - xs * yy;
            const float cyy = xx * ss - xs * xs, cys = xy * xs - xx * ys, css = xx * yy - xy * xy;
            const float det = xx * cxx + xy * cxy + xs * cxs;
            if (det == 0) return std::nullopt;
            const float dx = -(cxx * gx + cxy * gy + cxs * gs) / det;
            const float dy = -(cxy * gx + cyy * gy + cys * gs) / det;
            const float ds = -(cxs * gx + cys * gy + css * gs) / det;
            if (!(std::fabs(dx) < 1e3f && std::fabs(dy) < 1e3f && std::fabs(ds) < 1e3f)) return std::nullopt;
            const std::array<int, 3> move{int(std::lround(dx)), int(std::lround(dy)), int(std::lround(ds))};
            if (move == std::array{0, 0, 0} ||
                (round == 4 && std::max({std::fabs(dx), std::fabs(dy), std::fabs(ds)}) < 0.6f)) {
                const float strength =
                    std::fabs(value + 0.5f * (gx * dx + gy * dy + gs * ds)) * float(layers_an_octave);
                const float trace = xx + yy, limit = (edge_ratio + 1) * (edge_ratio + 1) / edge_ratio;
                if (strength < contrast_threshold || !(css > 0) || trace * trace > limit * css)
                    return std::nullopt;
                const float step = d.space.step(d.octave);
                return Feature{.x = (float(x) + dx) * step,
                               .y = (float(y) + dy) * step,
                               .scale = d.space.sigma(d.octave, float(layer) + ds),
                               .strength = strength};
            }
            x += move[0], y += move[1], layer += move[2];
            if (x < border || y < border || x >= level.width() - border || y >= level.height() - border ||
                layer < 1 || layer > layers_an_octave || std::abs(y - searched_row) >= search_reach)
                return std::nullopt;
        }
        return std::nullopt;
    }

    [[nodiscard]] static float cross(float pp, float mp, float pm, float mm) {
        return 0.25f * (pp - mp - pm + mm);
    }
};

}  // namespace ism
