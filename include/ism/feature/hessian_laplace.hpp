// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "ism/feature/detector.hpp"
#include "ism/feature/laplacian_scale.hpp"

namespace ism {

/// @brief Blobs: maxima in the plane of the determinant of the Hessian, σ⁴·(Lxx·Lyy − Lxy²), at those places
/// where the Laplacian has an extremum over scale nearby (Mikolajczyk & Schmid 2004). A Gaussian blob of
/// deviation t is found at the scale t. strength = the determinant. Of features less than half a scale and
/// half an octave apart the strongest stays.
struct HessianLaplace {
    static constexpr std::string_view name = "hessian-laplace";

    float threshold = 2e-3f;         ///< least determinant, brightness 0 … 1
    float least_laplacian = 0.005f;  ///< least |normalised Laplacian|
    float scale_tolerance = 0.5f;    ///< octaves from the level searched to the extremum over scale
    int border = 5;                  ///< pixels of the octave without features along the edge

    /// @brief Calls visit(name, value) for each option, for files.
    template <class Self, class Visit>
    static void each_parameter(Self& self, Visit&& visit) {
        visit("threshold", self.threshold);
        visit("least_laplacian", self.least_laplacian);
        visit("scale_tolerance", self.scale_tolerance);
        visit("border", self.border);
    }

    /// @brief Validates the options.
    /// @throws Error where one is out of range.
    friend void check(const HessianLaplace& options) {
        detail::expect_range("Hessian threshold", options.threshold, 0.0f, detail::max_threshold);
        detail::check_scale_selection(options.least_laplacian, options.scale_tolerance, options.border);
    }

    /// @throws Error where an option is out of range.
    [[nodiscard]] std::vector<Feature> detect(const ScaleSpace& space, Workspace& workspace) const {
        return search_all_rows(*this, space, workspace);
    }

    /// @brief See RowDetector.
    [[nodiscard]] SearchReach prepare(const ScaleSpace& space, const Workspace& /*workspace*/) const {
        check(*this);
        return detail::scale_selection_reach(space, selection());
    }
    /// @brief See RowDetector.
    void search(const ScaleSpace& space, int octave, int first, int end, Workspace& workspace,
                unsigned worker, std::vector<Feature>& found) const {
        const auto respond = [&](int level, int top, int bottom, ImageView<float> out, std::span<float>) {
            const ImageView<const float> image = space.level(octave, level);
            const float sigma = space.level_sigma(float(level)), sigma4 = sigma * sigma * sigma * sigma;
            for (int y = top; y < bottom; ++y)
                determinant(image.row(y - 1).data(), image.row(y).data(), image.row(y + 1).data(),
                            image.width(), sigma4, out.row(y - top).data());
        };
        detail::search_scale_selected(
            space, selection(), octave, first, end, workspace, worker, found,
            [](int, int) { return std::size_t{0}; }, respond);
    }
    /// @brief See RowDetector.
    void finish(std::vector<Feature>& features, Workspace& workspace) const {
        detail::drop_scale_selected(features, workspace);
    }

private:
    [[nodiscard]] detail::ScaleSelection selection() const {
        return {.first_level = 1,
                .scale_offset = 0,
                .scale_tolerance = scale_tolerance,
                .threshold = threshold,
                .least_laplacian = least_laplacian,
                .border = border};
    }

    static void determinant(const float* above, const float* here, const float* below, int width,
                            float sigma4, float* __restrict out) {
        for (int x = 1; x < width - 1; ++x) {
            const float xx = here[x - 1] - 2 * here[x] + here[x + 1];
            const float yy = above[x] - 2 * here[x] + below[x];
            const float xy = 0.25f * (below[x + 1] - below[x - 1] - above[x + 1] + above[x - 1]);
            out[x] = sigma4 * (xx * yy - xy * xy);
        }
    }
};

}  // namespace ism
