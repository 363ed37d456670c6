// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "support/catch.hpp"
#include "support/depth_scene.hpp"

#include "ism/core/random.hpp"
#include "ism/depth/local_frame.hpp"
#include "ism/depth/surface.hpp"

namespace {

using depth_scene::Plane;

/// A plane through (0, 0, depth), turned by `slant` degrees towards `azimuth` degrees.
Plane slanted_plane(double slant, double azimuth, float depth_m) {
    const double s = slant / 180 * std::numbers::pi, a = azimuth / 180 * std::numbers::pi;
    const ism::Vec3f n{float(std::sin(s) * std::cos(a)), float(std::sin(s) * std::sin(a)),
                       float(-std::cos(s))};
    return {n, n.z * depth_m};
}

}  // namespace

TEST_CASE("normals of planes are exact, and points are where the camera sees them") {
    ism::ThreadPool pool(2);
    for (const double slant : {0, 30, 60})
        for (const double azimuth : {70, 200}) {
            const Plane plane = slanted_plane(slant, azimuth, 1.1f);
            const auto picture = depth_scene::render({plane});
            const ism::Surface surface = surface_of(picture.depth_m, depth_scene::camera, pool);
            float worst_normal = 0, worst_point = 0;
            int without = 0, readings = 0;
            for (int y = 0; y < surface.height(); ++y)
                for (int x = 0; x < surface.width(); ++x) {
                    if (!(picture.depth_m(x, y) > 0)) continue;
                    ++readings;
                    worst_point = std::max(
                        worst_point, std::fabs(dot(plane.normal, surface.points_m(x, y)) - plane.offset));
                    if (surface.has_normal(x, y))
                        worst_normal = std::max(worst_normal, length(surface.normals(x, y) - plane.normal));
                    else
                        ++without;
                }
            CAPTURE(slant, azimuth);
            CHECK(readings > 100000);
            CHECK(without < readings / 20);  // beside what is beyond 10 m
            CHECK(worst_normal < 1e-4f);
            CHECK(worst_point < 1e-5f);
        }
}

TEST_CASE("there is no normal between two surfaces, and none without readings around") {
    ism::ThreadPool pool(1);
    const Plane near = slanted_plane(30, 0, 0.9f), far = slanted_plane(20, 90, 1.5f);
    auto depth_m = depth_scene::render({far}).depth_m;
    const auto before = depth_scene::render({near}).depth_m;
    for (int y = 100; y < 300; ++y)
        for (int x = 200; x < 380; ++x) depth_m(x, y) = before(x, y);
    ism::Random random(3);
    const std::array<float, 5> none = {0, ism::no_depth, -1, INFINITY, -INFINITY};
    for (float& z : depth_m.pixels())
        if (random.uniform() < 0.2) z = none[random.index(none.size())];
    const ism::Surface surface = surface_of(depth_m, depth_scene::camera, pool);
    float worst = 0;
    int normals = 0, readings = 0;
    for (int y = 0; y < surface.height(); ++y)
        for (int x = 0; x < surface.width(); ++x) {
            const bool reading = ism::is_depth(depth_m(x, y));
            REQUIRE(surface.has_point(x, y) == reading);
            if (!reading) REQUIRE(surface.points_m(x, y) == ism::Vec3f{});
            if (!reading) REQUIRE(!surface.has_normal(x, y));
            readings += reading;
            if (!surface.has_normal(x, y)) continue;
            ++normals;
            const bool in_front = x >= 200 && x < 380 && y >= 100 && y < 300;
            worst = std::max(worst, length(surface.normals(x, y) - (in_front ? near : far).normal));
        }
    CHECK(worst < 1e-4f);
    CHECK(normals > 0.98 * readings);

    ism::DepthMap alone(20, 20);
    alone(10, 10) = 1;
    for (int i = 0; i < 20; ++i) alone(i, 3) = 1;  // a line has no normal either
    const ism::Surface of_alone = surface_of(alone, depth_scene::camera, pool);
    CHECK(of_alone.has_point(10, 10));
    for (const ism::Vec3f n : of_alone.normals.pixels()) CHECK(n == ism::Vec3f{});
}

TEST_CASE("edges between surfaces stay sharp") {
    ism::ThreadPool pool(1);
    const depth_scene::Table table;
    const auto block = table.block(0, 0, {0.2f, 0.2f, 0.2f}, 0.6);
    const auto picture = depth_scene::noisy(depth_scene::render({table.plane(), block}));
    const ism::Surface surface = surface_of(picture.depth_m, depth_scene::camera, pool);
    const auto faces = columns(block.rotation);
    int pixels = 0, blunt = 0;
    for (int y = 0; y < surface.height(); ++y)
        for (int x = 0; x < surface.width(); ++x) {
            if (!contains(picture.regions[1], x, y)) continue;
            float agreement = 0;
            for (const ism::Vec3f face : faces)
                agreement = std::max(agreement, std::fabs(dot(face, surface.normals(x, y))));
            ++pixels, blunt += agreement < 0.94f;  // 20 degrees
        }
    CHECK(pixels > 10000);
    CAPTURE(blunt, pixels);
    CHECK(blunt < 0.005 * pixels);
}

TEST_CASE("a surface needs an image and a camera") {
    ism::ThreadPool pool(1);
    CHECK_THROWS_AS(surface_of(ism::DepthMap(), depth_scene::camera, pool), ism::Error);
    CHECK_THROWS_AS(surface_of(ism::DepthMap(8, 8, 1.0f), ism::Camera{}, pool), ism::Error);
    CHECK(surface_of(ism::DepthMap(1, 1, 1.0f), depth_scene::camera, pool).has_point(0, 0));
}

TEST_CASE("the frame of a feature turns with what it is on") {
    ism::ThreadPool pool(1);
    const ism::Vec3f point{0.02f, -0.03f, 1}, normal = normalized(ism::Vec3f{0.3f, -0.4f, -1});
    const ism::Vec3f along = normalized(cross(normal, {0.5f, 1, 0.2f}));
    for (const ism::Vec3f axis : {ism::Vec3f{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {1, 2, 3}})
        for (const double angle : {-0.25, 0.0, 0.2}) {
            const ism::Rotation turn = ism::rotation_around(axis, angle);
            const ism::Vec3f p = rotate(turn, point), n = rotate(turn, normal), t = rotate(turn, along);
            const auto picture = depth_scene::render({Plane{n, dot(n, p)}});
            const ism::Surface surface = surface_of(picture.depth_m, depth_scene::camera, pool);
            const auto seen = project(depth_scene::camera, to_point3(p));
            const auto ahead = project(depth_scene::camera, to_point3(p + 1e-3f * t));
            const auto frame =
                local_frame(surface, seen.x, seen.y, std::atan2(ahead.y - seen.y, ahead.x - seen.x));
            REQUIRE(frame);
            CHECK(length(frame->point_m - p) < 1e-4f);
            const auto [first, second, third] = columns(frame->rotation);
            CHECK(length(first - t) < 2e-3f);
            CHECK(length(second - cross(n, t)) < 2e-3f);
            CHECK(length(third - n) < 1e-3f);
        }
}

TEST_CASE("a feature has no frame where there is no surface") {
    ism::ThreadPool pool(1);
    auto depth_m = depth_scene::render({slanted_plane(10, 0, 1)}).depth_m;
    for (int y = 90; y < 150; ++y)
        for (int x = 100; x < 200; ++x) depth_m(x, y) = 0;
    const ism::Surface surface = surface_of(depth_m, depth_scene::camera, pool);
    CHECK(local_frame(surface, 50.3, 60, 1));
    CHECK(local_frame(surface, 100.9, 120, 1));  // 1.9 px from the next reading
    CHECK_FALSE(local_frame(surface, 104, 120, 1));
    CHECK(local_frame(surface, 0, 0, 1));
    for (const double outside : {-3.0, 700.0, double(NAN), double(INFINITY)}) {
        CHECK_FALSE(local_frame(surface, outside, 60, 1));
        CHECK_FALSE(local_frame(surface, 60, outside, 1));
    }
}
