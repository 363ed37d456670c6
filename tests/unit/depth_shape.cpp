// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <numeric>

#include "support/catch.hpp"
#include "support/depth_scene.hpp"

#include "ism/depth/shape_histogram.hpp"

using depth_scene::Ball;
using depth_scene::Block;

TEST_CASE("a shape histogram tells shapes apart, however they are turned") {
    ism::ThreadPool pool(1);
    const auto histogram = [&](const depth_scene::Shape& shape) {
        const auto picture = depth_scene::noisy(depth_scene::render({shape}));
        return shape_histogram(surface_of(picture.depth_m, depth_scene::camera, pool), picture.regions[0],
                               0.04);
    };
    const auto likeness = [](const ism::ShapeHistogram& a, const ism::ShapeHistogram& b) {
        return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
    };
    const auto block = [](double angle) {
        const ism::Rotation seen_at_a_corner =
            ism::rotation_around({0, 1, 0}, 0.7) * ism::rotation_around({1, 0, 0}, 0.6);
        return Block{
            {0.03f, 0, 0.9f}, {0.1f, 0.1f, 0.1f}, ism::rotation_around({0, 0, 1}, angle) * seen_at_a_corner};
    };
    const auto flat = histogram(Block{{0, 0, 0.9f}, {0.1f, 0.1f, 0.02f}});
    const auto ball = histogram(Ball{{0, 0, 0.9f}, 0.12f}), cube = histogram(block(0));
    for (const auto& h : {flat, ball, cube}) CHECK(likeness(h, h) == Approx(1).margin(1e-4));
    CHECK(likeness(flat, ball) < 0.9);
    CHECK(likeness(flat, cube) < 0.9);
    CHECK(likeness(ball, cube) < 0.95);
    for (const double angle : {0.4, 1.1, 2.5}) CHECK(likeness(cube, histogram(block(angle))) > 0.985);
    CHECK(likeness(ball, histogram(Ball{{0.1f, -0.08f, 0.9f}, 0.12f})) > 0.985);

    const auto picture = depth_scene::render({Ball{{0, 0, 0.9f}, 0.12f}});
    const ism::Surface surface = surface_of(picture.depth_m, depth_scene::camera, pool);
    CHECK(shape_histogram(surface, {150, 110, ism::Mask(4, 4, 1)}, 0.04) == ism::ShapeHistogram{});
    CHECK(shape_histogram(surface, {0, 0, ism::Mask(30, 30, 1)}, 0.04) ==
          ism::ShapeHistogram{});  // no depth there
    CHECK_THROWS_AS(shape_histogram(surface, picture.regions[0], 0), ism::Error);
}
