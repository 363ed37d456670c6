// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "toy/mesh.hpp"

#include <array>

namespace toy {

Mesh lathe(std::span<const Turned> outline, Vec base, int segments) {
    const int rows = int(outline.size()) - 1;
    return surface(segments, rows, true, [&](float u, float v) {
        const Turned at = outline[std::size_t(v * float(rows) + 0.5f)];
        const float angle = 2 * std::numbers::pi_v<float> * u;
        return base + Vec{at.radius * std::cos(angle), at.radius * std::sin(angle), at.height};
    });
}

Mesh ellipsoid(Vec centre, Vec radii, int segments) {
    return surface(segments, segments / 2, true, [&](float u, float v) {
        const float a = 2 * std::numbers::pi_v<float> * u, b = std::numbers::pi_v<float> * v;
        return centre + radii * Vec{std::cos(a) * std::sin(b), std::sin(a) * std::sin(b), -std::cos(b)};
    });
}

Mesh rounded_box(Vec centre, Vec half, float round) {
    Mesh mesh;
    const Vec inner = half - Vec{round, round, round};
    const auto ticks = [round](float h) {
        return std::array{-h, round * 0.45f - h, round - h, h - round, h - round * 0.45f, h};
    };
    const auto add_face = [&](int axis, float sign) {
        const std::array<float, 3> sides{half.x, half.y, half.z};
        const int u_axis = (axis + 1) % 3, v_axis = (axis + 2) % 3;
        const auto first = std::uint32_t(mesh.vertices.size());
        for (const float v : ticks(sides[std::size_t(v_axis)]))
            for (const float u : ticks(sides[std::size_t(u_axis)])) {
                std::array<float, 3> at{};
                at[std::size_t(axis)] = sign * sides[std::size_t(axis)];
                at[std::size_t(u_axis)] = u, at[std::size_t(v_axis)] = v;
                const Vec q{at[0], at[1], at[2]};
                const Vec core{std::clamp(q.x, -inner.x, inner.x), std::clamp(q.y, -inner.y, inner.y),
                               std::clamp(q.z, -inner.z, inner.z)};
                const Vec normal = normalised(q - core);
                mesh.vertices.push_back({centre + core + normal * round, normal});
            }
        for (std::uint32_t j = 0; j < 5; ++j)
            for (std::uint32_t i = 0; i < 5; ++i) {
                const std::uint32_t a = first + j * 6 + i;
                mesh.triangles.push_back({a, a + 1, a + 7});
                mesh.triangles.push_back({a, a + 7, a + 6});
            }
    };
    for (int axis = 0; axis < 3; ++axis) add_face(axis, 1), add_face(axis, -1);
    return mesh;
}

}  // namespace toy
