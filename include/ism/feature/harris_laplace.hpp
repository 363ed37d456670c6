// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "ism/feature/blur.hpp"
#include "ism/feature/detector.hpp"
#include "ism/feature/laplacian_scale.hpp"

namespace ism {

/// @brief Corners: maxima in the plane of the scale-adapted Harris measure at those places where the
/// Laplacian has an extremum over scale nearby (Mikolajczyk & Schmid 2001, 2004). The measure det(M) −
/// α·tr(M)² takes the gradients of a level of deviation σ_D, times σ_D², averaged with a Gaussian of the
/// integration scale σ_I = √2·σ_D. The scale of a feature is where the Laplacian has its extremum, within
/// scale_tolerance of σ_I; its strength is the measure. Of features less than half a scale and half an octave
/// apart the strongest stays.
struct HarrisLaplace {
    static constexpr std::string_view name = "harris-laplace";

    float threshold = 1e-6f;         ///< least Harris measure, brightness 0 … 1
    float alpha = 0.06f;             ///< α, 0 … 0.25
    float least_laplacian = 0.005f;  ///< least |normalised Laplacian|
    float scale_tolerance = 0.5f;    ///< octaves from the level searched to the extremum over scale
    int border = 5;                  ///< pixels of the octave without features along the edge

    /// @brief Calls visit(name, value) for each option, for files.
    template <class Self, class Visit>
    static void each_parameter(Self& self, Visit&& visit) {
        visit("threshold", self.threshold);
        visit("alpha", self.alpha);
        visit("least_laplacian", self.least_laplacian);
        visit("scale_tolerance", self.scale_tolerance);
        visit("border", self.border);
    }

    /// @brief Validates the options.
    /// @throws Error where one is out of range.
    friend void check(const HarrisLaplace& options) {
        detail::expect_range("Harris threshold", options.threshold, 0.0f, detail::max_threshold);
        detail::expect_range("Harris alpha", options.alpha, 0.0f, 0.25f);
        detail::check_scale_selection(options.least_laplacian, options.scale_tolerance, options.border);
    }

    /// @throws Error where an option is out of range.
    [[nodiscard]] std::vector<Feature> detect(const ScaleSpace& space, Workspace& workspace) const {
        return search_all_rows(*this, space, workspace);
    }

    /// @brief See RowDetector.
    [[nodiscard]] SearchReach prepare(const ScaleSpace& space, Workspace& workspace) const {
        check(*this);
        SearchReach reach = detail::scale_selection_reach(space, selection(space));
        for (int level = 0; level < space.levels_per_octave(); ++level)
            reach.rows = std::max(reach.rows, int(kernel(space, level, workspace).size()) + 3);
        return reach;
    }
    /// @brief See RowDetector.
    void search(const ScaleSpace& space, int octave, int first, int end, Workspace& workspace,
                unsigned worker, std::vector<Feature>& found) const {
        const int width = space.level(octave, 0).width();
        const auto memory_for = [&](int level, int rows) {
            const int radius = int(kernel(space, level, workspace).size()) - 1;
            return 3 * std::size_t(width) * std::size_t(2 * rows + 2 * radius + 1) +
                   detail::blur_scratch(width, radius);
        };
        const auto respond = [&](int level, int top, int bottom, ImageView<float> out,
                                 std::span<float> memory) {
            harris(space.level(octave, level), top, bottom, space.level_sigma(float(level)),
                   kernel(space, level, workspace), memory, out);
        };
        detail::search_scale_selected(space, selection(space), octave, first, end, workspace, worker, found,
                                      memory_for, respond);
    }
    /// @brief See RowDetector.
    void finish(std::vector<Feature>& features, Workspace& workspace) const {
        detail::drop_scale_selected(features, workspace);
    }

private:
    [[nodiscard]] detail::ScaleSelection selection(const ScaleSpace& space) const {
        return {.first_level = 0,
                .scale_offset = 0.5f * float(space.levels_per_octave()),
                .scale_tolerance = scale_tolerance,
                .threshold = threshold,
                .least_laplacian = least_laplacian,
                .border = border};
    }

    /// Averages over the integration scale of a level. Made by prepare(), so that search() only reads it.
    [[nodiscard]] static std::span<const float> kernel(const ScaleSpace& space, int level,
                                                       Workspace& workspace) {
        return workspace.kernel(space.level_sigma(float(level) + 0.5f * float(space.levels_per_octave())));
    }

    /// The measure for the rows first … end − 1, written into the rows of `out`.
    void harris(ImageView<const float> image, int first, int end, float sigma_d,
                std::span<const float> kernel, std::span<float> memory, ImageView<float> out) const {
        const int radius = int(kernel.size()) - 1, width = image.width(), height = image.height();
        const int top = std::max(0, first - radius), bottom = std::min(height, end + radius + 1);
        float* next = memory.data();
        const auto plane = [&](int rows) {
            const ImageView<float> view(next, width, rows, width);
            next += std::ptrdiff_t(width) * rows;
            return view;
        };
        const std::array product = {plane(bottom - top), plane(bottom - top), plane(bottom - top)};
        const std::array mean = {plane(end - first), plane(end - first), plane(end - first)};
        for (int y = top; y < bottom; ++y)
            products(image, y, 0.25f * sigma_d * sigma_d, product[0].row(y - top).data(),
                     product[1].row(y - top).data(), product[2].row(y - top).data());
        for (std::size_t i = 0; i < 3; ++i)
            detail::blur_band([&](int y) { return product[i].row(y - top).data(); }, width, height, kernel,
                              first, end, next, [&](int y) { return mean[i].row(y - first).data(); });
        for (int y = 0; y < end - first; ++y) {
            const float *xx = mean[0].row(y).data(), *xy = mean[1].row(y).data(), *yy = mean[2].row(y).data();
            float* __restrict response = out.row(y).data();
            for (int x = 0; x < width; ++x) {
                const float trace = xx[x] + yy[x];
                response[x] = xx[x] * yy[x] - xy[x] * xy[x] - alpha * trace * trace;
            }
        }
    }

    /// Products of the gradient's components in one row, times 4 · factor.
    static void products(ImageView<const float> image, int y, float factor, float* __restrict xx,
                         float* __restrict xy, float* __restrict yy) {
        const int last = image.width() - 1;
        const float* above = image.row(std::max(y - 1, 0)).data();
        const float* here = image.row(y).data();
        const float* below = image.row(std::min(y + 1, image.height() - 1)).data();
        for (int x = 1; x < last; ++x) {
            const float dx = here[x + 1] - here[x - 1], dy = below[x] - above[x];
            xx[x] = factor * dx * dx, xy[x] = factor * dx * dy, yy[x] = factor * dy * dy;
        }
        for (const int x : {0, last}) {
            const float dx = here[std::min(x + 1, last)] - here[std::max(x - 1, 0)], dy = below[x] - above[x];
            xx[x] = factor * dx * dx, xy[x] = factor * dx * dy, yy[x] = factor * dy * dy;
        }
    }
};

}  // namespace ism
