// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "toy/draw.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace toy {

Viewer look_at(const ism::Camera& camera, Vec eye, Vec target, float roll) {
    const Vec forward = normalised(target - eye), level = normalised(cross(forward, Vec{0, 0, 1}));
    const Vec down = cross(forward, level);
    const float c = std::cos(roll), s = std::sin(roll);
    return {camera, {level * c + down * s, down * c - level * s, forward, eye}};
}

namespace detail {

Geometry draw(std::span<const Placed> things, const Viewer& viewer, int width, int height) {
    Geometry g{{}, {}, RasterTarget(width * samples, height * samples), {}};
    const auto& cam = viewer.camera;
    std::vector<RasterPoint> flat;
    std::vector<int> alone(things.size()), seen(things.size());
    ism::Image<std::int32_t> stamp(width * samples, height * samples, -1);
    for (std::uint32_t t = 0; t < things.size(); ++t) {
        for (std::uint32_t k = 0; k < things[t].model.parts.size(); ++k) {
            const Mesh& mesh = things[t].model.parts[k].mesh;
            const auto first = std::uint32_t(g.corners.size());
            flat.clear();
            for (const Vertex& vertex : mesh.vertices) {
                const Vec p = things[t].pose.to_world(vertex.position), q = viewer.pose.to_local(p);
                g.corners.push_back({p, things[t].pose.turn(vertex.normal)});
                const float near = q.z > 0.02f ? 1 / q.z : std::numeric_limits<float>::quiet_NaN();
                flat.push_back({(float(cam.fx) * q.x * near + float(cam.cx) + 0.5f) * samples - 0.5f,
                                (float(cam.fy) * q.y * near + float(cam.cy) + 0.5f) * samples - 0.5f, near});
            }
            for (const auto& [a, b, c] : mesh.triangles) {
                const std::array points{flat[a], flat[b], flat[c]};
                const auto number = std::int32_t(g.triangles.size());
                g.triangles.push_back({{first + a, first + b, first + c}, t, k});
                for_each_sample(points, width * samples, height * samples, [&](int x, int y, float value) {
                    if (value > g.seen.nearness(x, y))
                        g.seen.nearness(x, y) = value, g.seen.triangle(x, y) = number;
                    if (stamp(x, y) != std::int32_t(t)) stamp(x, y) = std::int32_t(t), ++alone[t];
                });
            }
        }
    }
    for (const std::int32_t number : g.seen.triangle.pixels())
        if (number >= 0) ++seen[g.triangles[std::size_t(number)].thing];
    for (std::size_t t = 0; t < things.size(); ++t)
        g.visible.push_back(alone[t] > 0 ? double(seen[t]) / alone[t] : 0);
    return g;
}

}  // namespace detail

}  // namespace toy
