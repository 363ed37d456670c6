// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "ism/core/image.hpp"

namespace ism {

/// @brief A point in an image, pixels.
struct Point2 {
    double x = 0, y = 0;
    [[nodiscard]] constexpr bool operator==(const Point2&) const = default;
};

/// @brief A point in the camera frame, metres: x right, y down, z forward.
struct Point3 {
    double x = 0, y = 0, z = 0;
    [[nodiscard]] constexpr bool operator==(const Point3&) const = default;
};

/// @brief An upright rectangle in an image, pixels: the left upper corner and the sides (as in COCO, a box
/// covering the single pixel (3, 4) is {3, 4, 1, 1}).
struct Box {
    double x = 0, y = 0, width = 0, height = 0;

    [[nodiscard]] constexpr double area() const { return width * height; }
    /// @brief The middle, where (as for features) a pixel's coordinates are those of its centre.
    [[nodiscard]] constexpr Point2 centre() const { return {x + (width - 1) / 2, y + (height - 1) / 2}; }
    [[nodiscard]] constexpr bool operator==(const Box&) const = default;
};

/// @brief The box of a size around a centre; the reverse of Box::centre.
[[nodiscard]] constexpr Box box_around(Point2 centre, double width, double height) {
    return {centre.x - (width - 1) / 2, centre.y - (height - 1) / 2, width, height};
}

/// @brief Where two boxes overlap; without area where they do not.
[[nodiscard]] constexpr Box intersection(const Box& a, const Box& b) {
    const double x = std::max(a.x, b.x), y = std::max(a.y, b.y);
    return {x, y, std::max(0.0, std::min(a.x + a.width, b.x + b.width) - x),
            std::max(0.0, std::min(a.y + a.height, b.y + b.height) - y)};
}

/// @brief The part of a box that is in an image of this size; without area where there is none.
[[nodiscard]] constexpr Box clipped(const Box& box, int image_width, int image_height) {
    return intersection(box, {0, 0, double(image_width), double(image_height)});
}

/// @brief Intersection over union of two boxes, 0 … 1; 0 where both are empty.
[[nodiscard]] constexpr double iou(const Box& a, const Box& b) {
    const double common = intersection(a, b).area();
    const double together = a.area() + b.area() - common;
    return together > 0 ? common / together : 0;
}

/// @brief Number of figure pixels.
[[nodiscard]] inline std::size_t mask_area(ImageView<const std::uint8_t> mask) {
    std::size_t area = 0;
    for (int y = 0; y < mask.height(); ++y)
        for (const std::uint8_t value : mask.row(y)) area += value != 0;
    return area;
}

/// @brief The smallest box around the figure pixels; without area where there are none.
[[nodiscard]] inline Box mask_box(ImageView<const std::uint8_t> mask) {
    int left = mask.width(), top = mask.height(), right = -1, bottom = -1;
    for (int y = 0; y < mask.height(); ++y)
        for (int x = 0; x < mask.width(); ++x)
            if (mask(x, y) != 0) {
                left = std::min(left, x), right = std::max(right, x);
                top = std::min(top, y), bottom = std::max(bottom, y);
            }
    if (right < 0) return {};
    return {double(left), double(top), double(right - left + 1), double(bottom - top + 1)};
}

/// @brief Intersection over union of two masks of one size, 0 … 1; 0 where both are empty.
/// @throws Error where the sizes differ.
[[nodiscard]] inline double mask_iou(ImageView<const std::uint8_t> a, ImageView<const std::uint8_t> b) {
    expect(a.width() == b.width() && a.height() == b.height(), "mask size", size_text(a), size_text(b));
    std::size_t common = 0, together = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            common += a(x, y) != 0 && b(x, y) != 0;
            together += a(x, y) != 0 || b(x, y) != 0;
        }
    return together > 0 ? double(common) / double(together) : 0;
}

}  // namespace ism
