// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "ism/core/parallel.hpp"
#include "ism/feature/detector.hpp"
#include "ism/feature/local_maxima.hpp"

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

    /// @throws Error where an option is out of range.
    [[nodiscard]] std::vector<Feature> detect(const ScaleSpace& space, unsigned threads) const {
        expect(contrast_threshold >= 0, "contrast_threshold", "0 or more", contrast_threshold);
        expect(edge_ratio >= 1, "edge_ratio", "1 or more", edge_ratio);
        expect(border >= 1, "border (pixels)", "1 or more", border);
        std::vector<Feature> all;
        for (int octave = 0; octave < space.octaves(); ++octave) {
            const int rows = space.level(octave, 0).height() - 2 * border;
            if (rows <= 0) continue;
            const int tasks = (rows + rows_per_task - 1) / rows_per_task;
            std::vector<std::vector<Feature>> found(static_cast<std::size_t>(tasks));
            parallel_for(found.size(), threads, [&](std::size_t task) {
                const int first = border + int(task) * rows_per_task;
                search(space, octave, first, std::min(first + rows_per_task, border + rows), found[task]);
            });
            std::vector<Feature> features;
            for (const auto& part : found) features.insert(features.end(), part.begin(), part.end());
            detail::sort_unique(features);
            all.insert(all.end(), features.begin(), features.end());
        }
        return all;
    }

private:
    static constexpr int rows_per_task = 64;

    /// The difference d(layer) = level(layer + 1) − level(layer) at one pixel, without storing it.
    struct Difference {
        const ScaleSpace& space;
        int octave;
        [[nodiscard]] float operator()(int x, int y, int layer) const {
            return space.level(octave, layer + 1)(x, y) - space.level(octave, layer)(x, y);
        }
    };

    /// Three rows of each difference roll over the octave; with the largest and smallest of each pixel and
    /// its eight neighbours a whole row is searched at once.
    void search(const ScaleSpace& space, int octave, int first, int end, std::vector<Feature>& found) const {
        const int layers = space.levels() - 1, width = space.level(octave, 0).width();
        const std::size_t w = std::size_t(width);
        std::vector<float> rows(3 * std::size_t(layers) * w), high(std::size_t(layers) * w), low(high.size());
        std::vector<float> top(w), bottom(w);
        std::vector<unsigned char> hit(w);
        const auto row = [&](int layer, int y) {
            return rows.data() + (std::size_t(layer) * 3 + std::size_t(y % 3)) * w;
        };
        const auto load = [&](int y) {
            for (int layer = 0; layer < layers; ++layer) {
                const float* fine = space.level(octave, layer).row(y).data();
                const float* coarse = space.level(octave, layer + 1).row(y).data();
                float* __restrict to = row(layer, y);
                for (int x = 0; x < width; ++x) to[x] = coarse[x] - fine[x];
            }
        };
        const float least = 0.8f * contrast_threshold / float(space.levels_per_octave());
        const Difference difference{space, octave};
        load(first - 1), load(first);
        for (int y = first; y < end; ++y) {
            load(y + 1);
            for (int layer = 0; layer < layers; ++layer)
                neighbourhood(row(layer, y - 1), row(layer, y), row(layer, y + 1), width, top.data(),
                              bottom.data(), high.data() + std::size_t(layer) * w,
                              low.data() + std::size_t(layer) * w);
            for (int layer = 1; layer + 1 < layers; ++layer) {
                const std::size_t at = std::size_t(layer) * w;
                flag(row(layer, y), high.data() + at, low.data() + at, w, least, hit.data());
                for (int x = border; x < width - border; ++x)
                    if (hit[std::size_t(x)] != 0 && first_extremum(difference, x, y, layer))
                        if (const auto feature = refine(difference, x, y, layer)) found.push_back(*feature);
            }
        }
    }

    /// Largest and smallest value of each pixel and its eight neighbours.
    static void neighbourhood(const float* a, const float* b, const float* c, int width,
                              float* __restrict top, float* __restrict bottom, float* __restrict high,
                              float* __restrict low) {
        for (int x = 0; x < width; ++x) {
            const float up = a[x] > b[x] ? a[x] : b[x], down = a[x] < b[x] ? a[x] : b[x];
            top[x] = up > c[x] ? up : c[x];
            bottom[x] = down < c[x] ? down : c[x];
        }
        for (int x = 1; x < width - 1; ++x) {
            const float up = top[x - 1] > top[x] ? top[x - 1] : top[x];
            const float down = bottom[x - 1] < bottom[x] ? bottom[x - 1] : bottom[x];
            high[x] = up > top[x + 1] ? up : top[x + 1];
            low[x] = down < bottom[x + 1] ? down : bottom[x + 1];
        }
    }

    /// Marks the strong pixels that equal the extremum of their own layer and of both neighbouring ones,
    /// which lie w before and after.
    static void flag(const float* value, const float* high, const float* low, std::size_t w, float least,
                     unsigned char* __restrict hit) {
        for (std::size_t x = 0; x < w; ++x) {
            const float* h = high + x;
            const float* l = low + x;
            const float v = value[x];
            const int is_high = int(v > least) & int(v >= h[0]) & int(v >= *(h - w)) & int(v >= h[w]);
            const int is_low = int(v < -least) & int(v <= l[0]) & int(v <= *(l - w)) & int(v <= l[w]);
            hit[x] = static_cast<unsigned char>(is_high | is_low);
        }
    }

    /// Whether none of the neighbours before it in (layer, y, x) order is equal: one extremum for a flat top.
    [[nodiscard]] static bool first_extremum(const Difference& d, int x, int y, int layer) {
        const float value = d(x, y, layer);
        for (int k = -1; k <= 0; ++k)
            for (int j = -1; j <= (k < 0 ? 1 : 0); ++j)
                for (int i = -1; i <= (k == 0 && j == 0 ? -1 : 1); ++i)
                    if (d(x + i, y + j, layer + k) == value) return false;
        return true;
    }

    /// Moves to the extremum of the quadratic through the neighbours; nothing where it runs away, is weak or
    /// lies on an edge.
    [[nodiscard]] std::optional<Feature> refine(const Difference& d, int x, int y, int layer) const {
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
                layer < 1 || layer > layers_an_octave)
                return std::nullopt;
        }
        return std::nullopt;
    }

    [[nodiscard]] static float cross(float pp, float mp, float pm, float mm) {
        return 0.25f * (pp - mp - pm + mm);
    }
};

}  // namespace ism
