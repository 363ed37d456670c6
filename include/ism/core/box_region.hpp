// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/core/resize_area.hpp"

namespace ism {

/// @brief The part of a picture that shows a box and a margin around it, in parts of its sides: at least 2 ×
/// 2 pixels within the picture.
struct BoxRegion {
    int x = 0, y = 0, width = 0, height = 0;
    BoxRegion(const Box& box, double margin, int picture_width, int picture_height) {
        const auto inside = [](double px, int least, int most) {
            return int(std::clamp(px, double(least), double(most)));
        };
        x = inside(std::floor(box.x - margin * box.width), 0, picture_width - 2);
        y = inside(std::floor(box.y - margin * box.height), 0, picture_height - 2);
        width = inside(std::ceil(box.x + (1 + margin) * box.width), x + 2, picture_width) - x;
        height = inside(std::ceil(box.y + (1 + margin) * box.height), y + 2, picture_height) - y;
    }
};

/// @brief The pixels of a region in another size, three numbers each, 0 … 255 (ResizedRows).
[[nodiscard]] inline std::vector<float> region_colors(ImageView<const Rgb> color, const BoxRegion& region,
                                                      int width, int height) {
    std::vector<float> numbers(3 * std::size_t(region.width));
    const auto row_of_region = [&](std::size_t y) -> std::span<const float> {
        float* to = numbers.data();
        for (const Rgb c :
             color.row(region.y + int(y)).subspan(std::size_t(region.x), std::size_t(region.width)))
            *to++ = c.r, *to++ = c.g, *to++ = c.b;
        return numbers;
    };
    return resize_area<3>(row_of_region, region.width, region.height, width, height);
}

}  // namespace ism
