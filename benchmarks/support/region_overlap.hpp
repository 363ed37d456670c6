// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "support/homography.hpp"

#include "ism/core/geometry.hpp"
#include "ism/feature/feature.hpp"

namespace bench {

/// @brief The ellipse a·u² + 2b·uv + c·v² ≤ 1 around `centre`.
struct Ellipse {
    ism::Point2 centre;
    double a = 1, b = 0, c = 1;
    [[nodiscard]] double area() const { return std::numbers::pi / std::sqrt(a * c - b * b); }
    /// @brief Where it is at the height y: the ends of the row, none where it does not reach.
    [[nodiscard]] std::optional<std::pair<double, double>> row(double y) const {
        const double v = y - centre.y, root = b * b * v * v - a * (c * v * v - 1);
        if (!(root > 0)) return std::nullopt;
        const double half = std::sqrt(root) / a, middle = centre.x - b * v / a;
        return std::pair(middle - half, middle + half);
    }
};

/// @brief The circle of `radius` around a feature of the second image, as it lies in the first.
/// @param to_first  from the second image to the first
[[nodiscard]] inline Ellipse projected(const ism::Feature& f, double radius, const Homography& to_first) {
    const auto [p, q, r, s] = to_first.affine(f.x, f.y);
    const double det = p * s - q * r, k = 1 / (det * det * radius * radius);
    // inverse affine map: (s, −q; −r, p) / det; the ellipse is |inverse · (u, v)|² ≤ radius²
    return {to_first(f.x, f.y), k * (s * s + r * r), -k * (s * q + r * p), k * (q * q + p * p)};
}

/// @brief 1 − intersection / union of a feature of the first image and one of the second, both made larger
/// by what makes the first a circle of 30 pixels (Mikolajczyk et al. 2005).
[[nodiscard]] inline double overlap_error(const ism::Feature& first, const ism::Feature& second,
                                          const Homography& to_first) {
    constexpr double radius = 30;
    constexpr int rows = 60;
    Ellipse other = projected(second, second.scale * radius / first.scale, to_first);
    const double circle_area = std::numbers::pi * radius * radius, other_area = other.area();
    const double dx = other.centre.x - first.x, dy = other.centre.y - first.y;
    const double ratio = std::max(circle_area, other_area) / std::min(circle_area, other_area);
    if (!(ratio < 3) || dx * dx + dy * dy > 4 * radius * radius * ratio) return 1;
    double shared = 0;
    for (int i = 0; i < rows; ++i) {
        const double y = radius * ((2 * i + 1.0) / rows - 1), half = std::sqrt(radius * radius - y * y);
        if (const auto ends = other.row(first.y + y))
            shared +=
                std::max(0.0, std::min(ends->second, first.x + half) - std::max(ends->first, first.x - half));
    }
    shared *= 2 * radius / rows;
    return 1 - shared / (circle_area + other_area - shared);
}

}  // namespace bench
