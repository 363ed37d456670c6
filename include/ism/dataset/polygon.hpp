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
#include "ism/io/limits.hpp"

namespace ism {

/// @brief The corners of an outline in the coordinates of boxes: pixel (x, y) covers x … x + 1 and y … y + 1.
using Polygon = std::vector<Point2>;

/// @brief The box around the corners of an outline.
/// @throws Error where there is none.
[[nodiscard]] inline Box box_around(const Polygon& corners) {
    expect(!corners.empty(), "outline", "corners", "none");
    Point2 least = corners[0], most = corners[0];
    for (const Point2& corner : corners) {
        least = {std::min(least.x, corner.x), std::min(least.y, corner.y)};
        most = {std::max(most.x, corner.x), std::max(most.y, corner.y)};
    }
    return {least.x, least.y, most.x - least.x, most.y - least.y};
}

/// @brief The pixels whose middle lies in one of the polygons (each by the even-odd rule; where polygons
/// overlap is figure). What reaches outside is cut off.
/// @throws Error where a polygon has less than 3 corners or one that is not finite or beyond 1e9, or the size
/// is absurd.
[[nodiscard]] inline Mask fill_polygons(std::span<const Polygon> polygons, int width, int height) {
    expect(is_image_size(width, height), "mask size", image_size_limits, lazy_text(width, "x", height));
    Mask mask(width, height);
    std::vector<double> crossings;
    for (const Polygon& polygon : polygons) {
        expect(polygon.size() >= 3, "polygon", "at least 3 corners", polygon.size());
        double top = height, bottom = 0;
        for (const Point2& corner : polygon) {
            expect(std::abs(corner.x) <= 1e9 && std::abs(corner.y) <= 1e9, "polygon corner",
                   "pixels up to 1e9", lazy_text(corner.x, ", ", corner.y));
            top = std::min(top, corner.y), bottom = std::max(bottom, corner.y);
        }
        const auto first = [](double edge, int end) {  // the first pixel whose middle is not before the edge
            return static_cast<int>(std::clamp(std::ceil(edge - 0.5), 0.0, double(end)));
        };
        for (int y = first(top, height), end = first(bottom, height); y < end; ++y) {
            const double middle = y + 0.5;
            crossings.clear();
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const Point2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
                if ((a.y <= middle) != (b.y <= middle))
                    crossings.push_back(a.x + (middle - a.y) / (b.y - a.y) * (b.x - a.x));
            }
            std::sort(crossings.begin(), crossings.end());
            for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
                for (int x = first(crossings[i], width); x < first(crossings[i + 1], width); ++x)
                    mask(x, y) = 1;
        }
    }
    return mask;
}

}  // namespace ism
