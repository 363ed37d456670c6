// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>

#include "ism/core/geometry.hpp"
#include "ism/feature/feature.hpp"
#include "ism/model/occurrence.hpp"
#include "ism/model/training_object.hpp"

/// "A feature seen there says that the object lies here": the similarity transform between an object at the
/// reference size, with its centre at (0, 0), and an object in an image. Everything that needs it has it from
/// here: axes, boxes, masks and training.
namespace ism {

/// @brief Where an object lies in an image.
struct Placement {
    Point2 centre;     ///< pixels
    double scale = 1;  ///< pixels of the image a pixel of the reference size
    double angle = 0;  ///< turned by so much, radians from x towards y
};

/// @brief An object as upright as it was labelled, in this box.
[[nodiscard]] inline Placement upright_in(const Box& box) {
    return {box.centre(), scale_of(box), 0};
}

namespace detail {

/// A vector turned and scaled as a placement says. Most objects are upright: they need no sine.
[[nodiscard]] inline Point2 turned(double x, double y, double angle, double scale) {
    if (angle == 0) return {x * scale, y * scale};
    const double cosine = std::cos(angle) * scale, sine = std::sin(angle) * scale;
    return {cosine * x - sine * y, sine * x + cosine * y};
}

}  // namespace detail

/// @brief Where the object of an occurrence lies when its feature is seen as `f` (Eq 2, with rotation): scale
/// s_f / s_i, angle θ_f − θ_i, centre (x_f, y_f) − the occurrence's offset scaled and turned by these.
[[nodiscard]] inline Placement placement(const Feature& f, const Occurrence& o) {
    const double scale = double(f.scale) / double(o.scale);
    const double angle = double(f.angle) - double(o.angle);
    const Point2 offset = detail::turned(o.x, o.y, angle, scale);
    return {{f.x - offset.x, f.y - offset.y}, scale, angle};
}

/// @brief Depth of the object's centre when its feature is seen as `f`, metres: d_f − d_i where training
/// knows d_i, how far behind the centre the feature lies, as the paper proposes below Eq 5; else d_f.
[[nodiscard]] inline double centre_depth_m(const Feature& f, const Occurrence& o) {
    return double(f.depth_m) - (std::isfinite(o.depth_m) ? double(o.depth_m) : 0);
}

/// @brief A pixel of the image in the coordinates of the placed object: pixels at the reference size from its
/// centre.
[[nodiscard]] inline Point2 to_object(const Placement& placement, Point2 pixel) {
    return detail::turned(pixel.x - placement.centre.x, pixel.y - placement.centre.y, -placement.angle,
                          1 / placement.scale);
}

/// @brief The reverse of to_object().
[[nodiscard]] inline Point2 to_image(const Placement& placement, Point2 on_object) {
    const Point2 offset = detail::turned(on_object.x, on_object.y, placement.angle, placement.scale);
    return {placement.centre.x + offset.x, placement.centre.y + offset.y};
}

/// @brief The occurrence that a feature is on an object that lies so; placement() is its reverse. Depth,
/// weight and indices stay as they are by default.
[[nodiscard]] inline Occurrence as_occurrence(const Feature& f, const Placement& object) {
    const Point2 at = to_object(object, {f.x, f.y});
    Occurrence occurrence;
    occurrence.x = static_cast<float>(at.x);
    occurrence.y = static_cast<float>(at.y);
    occurrence.scale = static_cast<float>(f.scale / object.scale);
    occurrence.angle = static_cast<float>(f.angle - object.angle);
    return occurrence;
}

/// @brief The upright box around a training object that is placed so: its own, or where it is turned the box
/// around its turned figure.
[[nodiscard]] inline Box placed_box(const Placement& placement, const TrainingObject& object) {
    if (placement.angle == 0)
        return box_around(placement.centre, placement.scale * object.width, placement.scale * object.height);
    const auto reach = [&](double direction) {
        double turns = (direction - placement.angle) / (2 * std::numbers::pi);
        turns -= std::floor(turns);
        const double step = turns * reach_directions, share = step - std::floor(step);
        const std::size_t before = static_cast<std::size_t>(step) % reach_directions;
        return placement.scale *
               ((1 - share) * object.reach[before] + share * object.reach[(before + 1) % reach_directions]);
    };
    constexpr double quarter = std::numbers::pi / 2;
    const double right = reach(0), down = reach(quarter), left = reach(2 * quarter), up = reach(3 * quarter);
    // A pixel's coordinates are those of its centre: its edges lie half beside.
    return {placement.centre.x + 0.5 - left, placement.centre.y + 0.5 - up, left + right, up + down};
}

}  // namespace ism
