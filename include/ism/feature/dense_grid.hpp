// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "ism/feature/detector.hpp"
#include "ism/feature/range.hpp"

namespace ism {

/// @brief Not a detector but a regular grid at each of several scales, centred in the image. strength = 1.
struct DenseGrid {
    static constexpr std::string_view name = "dense";

    float spacing = 4;       ///< between neighbours, in units of the scale
    float margin = 2;        ///< from the image's edge, in units of the scale
    float first_scale = 2;   ///< smallest Feature::scale, pixels
    float scale_factor = 2;  ///< from one scale to the next
    int scale_count = 3;     ///< number of scales; those above the image's longer side are left out

    /// @brief Calls visit(name, value) for each option, for files.
    template <class Self, class Visit>
    static void each_parameter(Self& self, Visit&& visit) {
        visit("spacing", self.spacing);
        visit("margin", self.margin);
        visit("first_scale", self.first_scale);
        visit("scale_factor", self.scale_factor);
        visit("scale_count", self.scale_count);
    }

    /// @brief Validates the options.
    /// @throws Error where one is out of range, or neighbours at the first scale are closer than half a
    /// pixel.
    friend void check(const DenseGrid& options) {
        detail::expect_range("grid spacing (scales)", options.spacing, 0.01f, 1000.0f);
        detail::expect_range("grid margin (scales)", options.margin, 0.0f, 1000.0f);
        detail::expect_range("first_scale (pixels)", options.first_scale, 0.1f, 10000.0f);
        detail::expect_range("scale_factor", options.scale_factor, 1.01f, 16.0f);
        detail::expect_range("scale_count", options.scale_count, 1, 64);
        const float spacing_px = options.spacing * options.first_scale;
        expect(spacing_px >= 0.5f, "grid spacing at the first scale (pixels)", "0.5 or more", spacing_px);
    }

    /// @throws Error where an option is out of range.
    [[nodiscard]] std::vector<Feature> detect(const ScaleSpace& space, Workspace& workspace) const {
        check(*this);
        std::vector<Feature> features = workspace.empty_list();
        const float longest = float(std::max(space.width(), space.height()));
        float scale = first_scale;
        for (int i = 0; i < scale_count && scale <= longest; ++i, scale *= scale_factor) {
            const Line along_x = line(space.width(), scale), along_y = line(space.height(), scale);
            for (int row = 0; row < along_y.count; ++row)
                for (int column = 0; column < along_x.count; ++column)
                    features.push_back({.x = along_x.first + float(column) * spacing * scale,
                                        .y = along_y.first + float(row) * spacing * scale,
                                        .scale = scale,
                                        .strength = 1});
        }
        return features;
    }

private:
    struct Line {
        float first = 0;
        int count = 0;
    };
    [[nodiscard]] Line line(int pixels, float scale) const {
        const float room = float(pixels - 1) - 2 * margin * scale;
        if (room < 0) return {};
        const int gaps = int(room / (spacing * scale));
        return {(float(pixels - 1) - float(gaps) * spacing * scale) / 2, gaps + 1};
    }
};

}  // namespace ism
