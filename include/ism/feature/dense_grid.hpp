// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string_view>
#include <vector>

#include "ism/feature/detector.hpp"

namespace ism {

/// @brief No detector at all: a regular grid at each of a row of scales, centred in the image. strength = 1.
struct DenseGrid {
    static constexpr std::string_view name = "dense";

    float spacing = 4;       ///< between neighbours, in units of the scale
    float margin = 2;        ///< from the image's edge, in units of the scale
    float first_scale = 2;   ///< smallest Feature::scale, pixels
    float scale_factor = 2;  ///< from one scale to the next, > 1
    int scale_count = 3;     ///< number of scales, ≥ 1

    /// @brief Calls visit(name, value) for each option, for files.
    template <class Self, class Visit>
    static void each_parameter(Self& self, Visit&& visit) {
        visit("spacing", self.spacing);
        visit("margin", self.margin);
        visit("first_scale", self.first_scale);
        visit("scale_factor", self.scale_factor);
        visit("scale_count", self.scale_count);
    }

    /// @throws Error where an option is out of range.
    [[nodiscard]] std::vector<Feature> detect(const ScaleSpace& space, Workspace& workspace) const {
        expect(spacing > 0, "grid spacing (scales)", "a positive number", spacing);
        expect(margin >= 0, "grid margin (scales)", "0 or more", margin);
        expect(first_scale > 0, "first_scale (pixels)", "a positive number", first_scale);
        expect(scale_factor > 1, "scale_factor", "more than 1", scale_factor);
        expect(scale_count >= 1, "scale_count", "1 or more", scale_count);
        std::vector<Feature> features = workspace.empty_list();
        float scale = first_scale;
        for (int i = 0; i < scale_count; ++i, scale *= scale_factor) {
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
