// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "toy/vec.hpp"

namespace toy {

/// @brief A corner of a triangle with the direction its surface faces.
struct Vertex {
    Vec position, normal;
};

/// @brief Triangles over shared corners.
struct Mesh {
    std::vector<Vertex> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// @brief A surface place(u, v), u and v in 0 … 1, as a grid of columns × rows quads; where `closed` the
/// last column joins the first. Normals are the mean of the triangles around a corner.
template <std::invocable<float, float> Place>
[[nodiscard]] Mesh surface(int columns, int rows, bool closed, Place&& place) {
    Mesh mesh;
    const int across = closed ? columns : columns + 1;
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i < across; ++i)
            mesh.vertices.push_back({place(float(i) / float(columns), float(j) / float(rows)), {}});
    const auto index = [&](int i, int j) { return std::uint32_t(j * across + i % across); };
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            mesh.triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
            mesh.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
        }
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec p = mesh.vertices[a].position;
        const Vec n = cross(mesh.vertices[b].position - p, mesh.vertices[c].position - p);
        for (const std::uint32_t k : {a, b, c}) mesh.vertices[k].normal = mesh.vertices[k].normal + n;
    }
    for (Vertex& vertex : mesh.vertices) vertex.normal = normalised(vertex.normal);
    return mesh;
}

/// @brief A point of the outline that lathe() turns: distance from the axis and height, metres.
struct Turned {
    float radius = 0, height = 0;
};

/// @brief `outline` turned around the vertical axis through `base`. A point given twice makes an edge.
[[nodiscard]] Mesh lathe(std::span<const Turned> outline, Vec base, int segments = 32);

/// @brief An ellipsoid with half axes `radii`.
[[nodiscard]] Mesh ellipsoid(Vec centre, Vec radii, int segments = 24);

/// @brief A bent pipe: path(t) is its middle line, radius(t) its thickness, t in 0 … 1. Its ends are open.
template <std::invocable<float> Path, std::invocable<float> Radius>
[[nodiscard]] Mesh tube(int segments, int rows, Path&& path, Radius&& radius) {
    return surface(segments, rows, true, [&](float u, float v) {
        const Vec along = normalised(path(v + 0.01f) - path(v - 0.01f));
        const Vec helper = std::abs(along.y) < 0.9f ? Vec{0, 1, 0} : Vec{1, 0, 0};
        const Vec side = normalised(cross(helper, along)), other = cross(along, side);
        const float angle = 2 * std::numbers::pi_v<float> * u;
        return path(v) + (side * std::cos(angle) + other * std::sin(angle)) * radius(v);
    });
}

/// @brief A box with half sides `half` whose edges are rounded with radius `round`.
[[nodiscard]] Mesh rounded_box(Vec centre, Vec half, float round);

}  // namespace toy
