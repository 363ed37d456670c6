// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"

namespace ism {

/// @brief A part of an image, pixel by pixel, kept no larger than it is: pixel (i, j) of the mask is pixel
/// (x + i, y + j) of the image, and the mask covers the figure tightly. 0 = ground, 1 = figure.
struct RegionMask {
    int x = 0, y = 0;
    Mask mask = {};
    [[nodiscard]] bool operator==(const RegionMask&) const = default;
};

/// @brief The box around the figure.
[[nodiscard]] inline Box box_of(const RegionMask& region) {
    return {double(region.x), double(region.y), double(region.mask.width()), double(region.mask.height())};
}

/// @brief Number of figure pixels.
[[nodiscard]] inline std::size_t area_of(const RegionMask& region) {
    return mask_area(region.mask);
}

/// @brief Whether pixel (x, y) of the image is figure.
[[nodiscard]] inline bool contains(const RegionMask& region, int x, int y) {
    return region.mask.contains(x - region.x, y - region.y) && region.mask(x - region.x, y - region.y) != 0;
}

/// @brief Number of pixels that are figure in both.
[[nodiscard]] inline std::size_t intersection_area(const RegionMask& a, const RegionMask& b) {
    const int left = std::max(a.x, b.x), right = std::min(a.x + a.mask.width(), b.x + b.mask.width());
    const int top = std::max(a.y, b.y), bottom = std::min(a.y + a.mask.height(), b.y + b.mask.height());
    std::size_t common = 0;
    if (left >= right) return 0;
    for (int y = top; y < bottom; ++y) {
        const std::uint8_t* in_a = a.mask.row(y - a.y).data() + (left - a.x);
        const std::uint8_t* in_b = b.mask.row(y - b.y).data() + (left - b.x);
        std::uint32_t of_row = 0;
        for (int i = 0; i < right - left; ++i) of_row += std::uint32_t((in_a[i] != 0) & (in_b[i] != 0));
        common += of_row;
    }
    return common;
}

/// @brief Intersection over union of two figures, 0 … 1; 0 where both are empty.
[[nodiscard]] inline double iou(const RegionMask& a, const RegionMask& b) {
    const std::size_t common = intersection_area(a, b), together = area_of(a) + area_of(b) - common;
    return together > 0 ? double(common) / double(together) : 0;
}

/// @brief The figure of a mask of the whole image, or of a part of it that begins at (x, y). Empty where
/// there is none.
[[nodiscard]] inline RegionMask region_of(ImageView<const std::uint8_t> mask, int x = 0, int y = 0) {
    const Box box = mask_box(mask);
    if (box.area() == 0) return {};
    RegionMask region{x + int(box.x), y + int(box.y), Mask(int(box.width), int(box.height))};
    for (int j = 0; j < region.mask.height(); ++j)
        for (int i = 0; i < region.mask.width(); ++i)
            region.mask(i, j) = mask(int(box.x) + i, int(box.y) + j) != 0;
    return region;
}

/// @brief The mask of a whole image of width × height that has this figure; what is outside is dropped.
/// @throws Error where a side is negative.
[[nodiscard]] inline Mask full_mask(const RegionMask& region, int width, int height) {
    Mask mask(width, height);
    for (int j = std::max(0, -region.y); j < std::min(region.mask.height(), height - region.y); ++j)
        for (int i = std::max(0, -region.x); i < std::min(region.mask.width(), width - region.x); ++i)
            mask(region.x + i, region.y + j) = region.mask(i, j);
    return mask;
}

/// @brief Drops each region whose IoU with one before it is above `max_iou`.
[[nodiscard]] inline std::vector<RegionMask> without_duplicates(std::vector<RegionMask> regions,
                                                                double max_iou) {
    std::vector<RegionMask> kept;
    std::vector<double> areas;
    for (RegionMask& region : regions) {
        const auto area = double(area_of(region));
        const auto alike = [&](std::size_t k) {
            const double least = max_iou * (area + areas[k]) / (1 + max_iou);  // of what both have
            return std::min(area, areas[k]) > least &&
                   intersection(box_of(region), box_of(kept[k])).area() > least &&
                   double(intersection_area(region, kept[k])) > least;
        };
        bool known = false;
        for (std::size_t k = 0; k < kept.size() && !known; ++k) known = alike(k);
        if (known) continue;
        areas.push_back(area);
        kept.push_back(std::move(region));
    }
    return kept;
}

}  // namespace ism
