// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>

#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/show/color.hpp"

namespace ism {

// All shapes have smooth edges and are cut off at the image's border; what has a coordinate that is not
// finite is not drawn. Pixel (x, y) has its centre at (x, y).

/// @brief A pen: colour, width in pixels and how much it covers, 0 … 1.
struct Pen {
    Rgb color = white;
    double width_px = 1;
    double opacity = 1;
};

namespace detail {

/// Pixels a … b of a side of `size` pixels; none where b < a.
struct PixelRange {
    int first = 0, last = -1;
};
[[nodiscard]] inline PixelRange clipped(double a, double b, int size) {
    if (!(std::isfinite(a) && std::isfinite(b)) || b < 0 || a > size - 1) return {};
    return {int(std::max(0.0, std::floor(a))), int(std::min(size - 1.0, std::ceil(b)))};
}

/// Paints the pixels of [left, right] × [top, bottom] as far as `distance(x, y)`, the distance to the inside
/// of a shape, says that they are covered.
template <std::invocable<double, double> Distance>
void paint(ImageView<Rgb> image, double left, double top, double right, double bottom, const Pen& pen,
           const Distance& distance) {
    const PixelRange columns = clipped(left - 1, right + 1, image.width());
    const PixelRange rows = clipped(top - 1, bottom + 1, image.height());
    for (int y = rows.first; y <= rows.last; ++y)
        for (int x = columns.first; x <= columns.last; ++x) {
            const double cover = std::clamp(0.5 - distance(double(x), double(y)), 0.0, 1.0);
            if (cover > 0) image(x, y) = mix(image(x, y), pen.color, cover * pen.opacity);
        }
}

}  // namespace detail

/// @brief A straight line with round ends.
inline void draw_line(ImageView<Rgb> image, Point2 a, Point2 b, const Pen& pen) {
    const double dx = b.x - a.x, dy = b.y - a.y, length_sq = dx * dx + dy * dy, half = pen.width_px / 2;
    const auto distance = [&](double x, double y) {
        const double t =
            length_sq > 0 ? std::clamp(((x - a.x) * dx + (y - a.y) * dy) / length_sq, 0.0, 1.0) : 0;
        return std::hypot(x - a.x - t * dx, y - a.y - t * dy) - half;
    };
    // row by row only the columns near the line, so that long slanting lines stay cheap
    const double top = std::min(a.y, b.y) - half, bottom = std::max(a.y, b.y) + half;
    const detail::PixelRange rows = detail::clipped(top - 1, bottom + 1, image.height());
    for (int y = rows.first; y <= rows.last; ++y) {
        const double reach = half + 1;
        double left = std::min(a.x, b.x), right = std::max(a.x, b.x);
        if (std::abs(dy) > 1e-9) {
            const double x0 = a.x + (y - reach - a.y) / dy * dx, x1 = a.x + (y + reach - a.y) / dy * dx;
            left = std::clamp(std::min(x0, x1), left, right);
            right = std::clamp(std::max(x0, x1), left, right);
        }
        detail::paint(image.region(0, y, image.width(), 1), left - reach, 0, right + reach, 0, pen,
                      [&](double x, double) { return distance(x, double(y)); });
    }
}

/// @brief A circle line.
inline void draw_circle(ImageView<Rgb> image, Point2 centre, double radius_px, const Pen& pen) {
    const double reach = radius_px + pen.width_px / 2;
    detail::paint(image, centre.x - reach, centre.y - reach, centre.x + reach, centre.y + reach, pen,
                  [&](double x, double y) {
                      const double from_line = std::hypot(x - centre.x, y - centre.y) - radius_px;
                      return std::abs(from_line) - pen.width_px / 2;
                  });
}

/// @brief A filled disc.
inline void fill_disc(ImageView<Rgb> image, Point2 centre, double radius_px, Rgb color, double opacity = 1) {
    detail::paint(image, centre.x - radius_px, centre.y - radius_px, centre.x + radius_px,
                  centre.y + radius_px, {.color = color, .opacity = opacity},
                  [&](double x, double y) { return std::hypot(x - centre.x, y - centre.y) - radius_px; });
}

/// @brief Fills the pixels of a box.
inline void fill_box(ImageView<Rgb> image, const Box& box, Rgb color, double opacity = 1) {
    const double x = box.x + (box.width - 1) / 2, y = box.y + (box.height - 1) / 2;
    detail::paint(image, box.x, box.y, box.x + box.width - 1, box.y + box.height - 1,
                  {.color = color, .opacity = opacity}, [&](double px, double py) {
                      return std::max(std::abs(px - x) - box.width / 2, std::abs(py - y) - box.height / 2);
                  });
}

/// @brief The outline of a box, the pen's width inside its edge.
inline void draw_box(ImageView<Rgb> image, const Box& box, const Pen& pen) {
    const double w = std::min({pen.width_px, box.width / 2, box.height / 2});
    const double inner = box.height - 2 * w;
    fill_box(image, {box.x, box.y, box.width, w}, pen.color, pen.opacity);
    fill_box(image, {box.x, box.y + box.height - w, box.width, w}, pen.color, pen.opacity);
    fill_box(image, {box.x, box.y + w, w, inner}, pen.color, pen.opacity);
    fill_box(image, {box.x + box.width - w, box.y + w, w, inner}, pen.color, pen.opacity);
}

}  // namespace ism
