// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "toy/mesh.hpp"

namespace toy {

/// @brief How a point of a surface answers to light.
struct Surface {
    Vec albedo = {0.5f, 0.5f, 0.5f};  ///< linear colour
    float gloss = 0.1f;               ///< 0 = chalk … 1 = polished
};

/// @brief The surface at a point of the model (metres, its own frame) that faces `normal`.
using Paint = std::function<Surface(const Vec& point, const Vec& normal)>;

/// @brief A mesh with its paint.
struct Part {
    Mesh mesh;
    Paint paint;
};

/// @brief A thing of one or more parts. Its frame has the origin on the ground below it, z up; what it shows
/// to the viewer looks towards −y.
struct Model {
    std::vector<Part> parts;
    Vec low = {}, high = {};  ///< corners of the box around it, metres

    void add(Mesh mesh, Paint paint) { parts.push_back({std::move(mesh), std::move(paint)}); }
};

/// @brief `model` with the box around it measured.
[[nodiscard]] Model finished(Model model);

/// @brief One colour all over.
[[nodiscard]] inline Paint plain(Vec albedo, float gloss) {
    return [=](const Vec&, const Vec&) { return Surface{albedo, gloss}; };
}

}  // namespace toy
