// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <variant>
#include <vector>

#include "ism/core/camera.hpp"
#include "ism/core/random.hpp"
#include "ism/core/region_mask.hpp"
#include "ism/core/rotation.hpp"

/// Depth images of planes, balls and blocks, by casting rays. Rays have z = 1, so distances along them are
/// depths.
namespace depth_scene {

constexpr int width = 640, height = 480;
constexpr ism::Camera camera{525, 525, 319.5, 239.5};
constexpr float nowhere = std::numeric_limits<float>::infinity();

/// The points with normal·point = offset.
struct Plane {
    ism::Vec3f normal;
    float offset;
};
struct Ball {
    ism::Vec3f centre;
    float radius;
};
struct Block {
    ism::Vec3f centre, half_sides;
    ism::Rotation rotation = {};
};
using Shape = std::variant<Plane, Ball, Block>;

inline float depth_along(ism::Vec3f ray, const Plane& plane) {
    const float depth = plane.offset / dot(plane.normal, ray);
    return depth > 0 ? depth : nowhere;
}
inline float depth_along(ism::Vec3f ray, const Ball& ball) {
    const double a = dot(ray, ray), b = dot(ray, ball.centre);
    const double c = dot(ball.centre, ball.centre) - double(ball.radius) * ball.radius, root = b * b - a * c;
    return root > 0 ? float((b - std::sqrt(root)) / a) : nowhere;
}
inline float depth_along(ism::Vec3f ray, const Block& block) {
    const ism::Vec3f d = rotate(inverse(block.rotation), ray),
                     o = rotate(inverse(block.rotation), -block.centre);
    float enter = 0, leave = nowhere;
    const auto slab = [&](float from, float along, float half) {
        const float a = (-half - from) / along, b = (half - from) / along;
        enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
    };
    slab(o.x, d.x, block.half_sides.x), slab(o.y, d.y, block.half_sides.y),
        slab(o.z, d.z, block.half_sides.z);
    return enter > 0 && enter <= leave ? enter : nowhere;
}

struct Picture {
    ism::DepthMap depth_m{width, height};
    std::vector<ism::RegionMask> regions;  ///< of each shape
};

inline Picture render(const std::vector<Shape>& shapes) {
    Picture picture;
    std::vector<ism::Mask> masks(shapes.size(), ism::Mask(width, height));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const ism::Vec3f ray = ism::to_vec3f(back_project(camera, {double(x), double(y)}, 1));
            float nearest = 10;
            ism::Mask* seen = nullptr;
            for (std::size_t s = 0; s < shapes.size(); ++s) {
                float depth = nowhere;
                if (const auto* plane = std::get_if<Plane>(&shapes[s])) depth = depth_along(ray, *plane);
                if (const auto* ball = std::get_if<Ball>(&shapes[s])) depth = depth_along(ray, *ball);
                if (const auto* block = std::get_if<Block>(&shapes[s])) depth = depth_along(ray, *block);
                if (depth < nearest) nearest = depth, seen = &masks[s];
            }
            if (seen == nullptr) continue;
            picture.depth_m(x, y) = nearest;
            (*seen)(x, y) = 1;
        }
    for (const ism::Mask& mask : masks) picture.regions.push_back(ism::region_of(mask));
    return picture;
}

/// With the noise of a depth camera, about 1 mm at 1 m.
inline Picture noisy(Picture picture) {
    ism::Random random(11);
    for (float& z : picture.depth_m.pixels())
        if (z > 0) z += 0.001f * z * z * float(random.normal());
    return picture;
}

/// A table 1 m in front of the camera, seen from 45 degrees above, and what stands on it.
struct Table {
    ism::Vec3f right{1, 0, 0}, up = normalized(ism::Vec3f{0, -1, -1}), away = cross(up, right),
                               middle{0, 0, 1};

    [[nodiscard]] Plane plane() const { return {up, dot(up, middle)}; }
    [[nodiscard]] ism::Vec3f at(float x, float y, float z) const {
        return middle + x * right + y * away + z * up;
    }
    /// A block with its lower side at (x, y), turned around `up`.
    [[nodiscard]] Block block(float x, float y, ism::Vec3f sides, double angle = 0) const {
        return {at(x, y, sides.z / 2), 0.5f * sides,
                ism::rotation_around(up, angle) * ism::rotation_of_columns(right, away, up)};
    }
};

}  // namespace depth_scene
