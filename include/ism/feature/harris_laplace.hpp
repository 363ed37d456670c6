// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
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

    /// @throws Error where an option is out of range.
    [[nodiscard]] std::vector<Feature> detect(const ScaleSpace& space, unsigned threads) const {
        expect(threshold >= 0, "Harris threshold", "0 or more", threshold);
        expect(alpha >= 0 && alpha < 0.25f, "Harris alpha", "0 to 0.25", alpha);
        expect(scale_tolerance > 0 && scale_tolerance <= 1, "scale_tolerance (octaves)", "above 0, up to 1",
               scale_tolerance);
        expect(border >= 0, "border (pixels)", "0 or more", border);
        const float offset = 0.5f * float(space.levels_per_octave());
        const auto respond = [&](int octave, int level, int first, int end, ImageView<float> out) {
            harris(space.level(octave, level), first, end, space.level_sigma(float(level)),
                   space.level_sigma(float(level) + offset), out);
        };
        return detail::scale_selected_maxima(space,
                                             {.first_level = 0,
                                              .scale_offset = offset,
                                              .scale_tolerance = scale_tolerance,
                                              .threshold = threshold,
                                              .least_laplacian = least_laplacian,
                                              .border = border},
                                             threads, respond);
    }

private:
    /// The measure for the rows first … end − 1, written into the rows of `out`.
    void harris(ImageView<const float> image, int first, int end, float sigma_d, float sigma_i,
                ImageView<float> out) const {
        const std::vector<float> kernel = gaussian_kernel(sigma_i);
        const int radius = int(kernel.size()) - 1, width = image.width(), height = image.height();
        const int top = std::max(0, first - radius), bottom = std::min(height, end + radius);
        Image<float> xx(width, bottom - top), xy = xx, yy = xx;
        for (int y = top; y < bottom; ++y)
            products(image, y, 0.25f * sigma_d * sigma_d, xx.row(y - top).data(), xy.row(y - top).data(),
                     yy.row(y - top).data());

        const std::size_t w = std::size_t(width);
        std::vector<float> column(w + 2 * std::size_t(radius)), mean(3 * w);
        std::vector<const float*> rows(2 * std::size_t(radius) + 1);
        const detail::BlurRow blur_row =
            detail::blur_row_of_radius[std::size_t(radius <= detail::unrolled_radius ? radius : 0)];
        for (int y = first; y < end; ++y) {
            float* to = mean.data();
            for (const Image<float>* plane : {&xx, &xy, &yy}) {
                for (int t = -radius; t <= radius; ++t)
                    rows[std::size_t(t + radius)] = plane->row(std::clamp(y + t, 0, height - 1) - top).data();
                blur_row(rows.data(), kernel.data(), radius, width, column.data(), to);
                to += w;
            }
            const float *mxx = mean.data(), *mxy = mxx + w, *myy = mxy + w;
            float* __restrict response = out.row(y - first).data();
            for (std::size_t x = 0; x < w; ++x) {
                const float trace = mxx[x] + myy[x];
                response[x] = mxx[x] * myy[x] - mxy[x] * mxy[x] - alpha * trace * trace;
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
