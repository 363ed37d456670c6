// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "toy/scene.hpp"

namespace toy {

namespace detail {

/// An upright box on the table: middle, half sides and axes.
struct Footprint {
    Vec middle, x_axis, y_axis;
    float half_x = 0, half_y = 0;
};

inline Footprint footprint(const Placed& thing, float margin) {
    const Model& m = thing.model;
    const Vec mid = (m.low + m.high) * 0.5f;
    return {thing.pose.to_world({mid.x, mid.y, 0}), thing.pose.x_axis, thing.pose.y_axis,
            (m.high.x - m.low.x) / 2 + margin, (m.high.y - m.low.y) / 2 + margin};
}

/// Whether two footprints overlap (separating axes).
inline bool collide(const Footprint& a, const Footprint& b) {
    const Vec apart = b.middle - a.middle;
    for (const Vec axis : {a.x_axis, a.y_axis, b.x_axis, b.y_axis}) {
        const auto reach = [axis](const Footprint& f) {
            return f.half_x * std::abs(dot(f.x_axis, axis)) + f.half_y * std::abs(dot(f.y_axis, axis));
        };
        if (std::abs(dot(apart, axis)) > reach(a) + reach(b)) return false;
    }
    return true;
}

/// Whether the whole thing is inside the picture, some pixels from the frame.
inline bool in_picture(const Placed& thing, const Viewer& viewer, const ToyOptions& options) {
    const Model& m = thing.model;
    for (int i = 0; i < 8; ++i) {
        const Vec corner{i & 1 ? m.high.x : m.low.x, i & 2 ? m.high.y : m.low.y, i & 4 ? m.high.z : m.low.z};
        const Vec p = viewer.pose.to_local(thing.pose.to_world(corner));
        if (p.z < 0.1f) return false;
        const ism::Point2 q = ism::project(viewer.camera, {p.x, p.y, p.z});
        if (q.x < 4 || q.y < 4 || q.x > options.width - 5 || q.y > options.height - 5) return false;
    }
    return true;
}

/// Where on the table a thing at `distance` from an eye at height `eye_z` stands, `across` −1 … 1 the
/// picture.
inline Vec spot(float eye_z, float distance, float across, float half_view) {
    const float ground = std::sqrt(std::max(0.01f, distance * distance - (eye_z - 0.05f) * (eye_z - 0.05f)));
    return {across * half_view * distance,
            std::sqrt(std::max(
                0.01f, ground * ground - across * across * half_view * half_view * distance * distance)),
            0};
}

}  // namespace detail

}  // namespace toy
