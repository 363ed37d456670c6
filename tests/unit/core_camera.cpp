// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "support/catch.hpp"

#include "ism/core/frame.hpp"
#include "ism/core/random.hpp"

TEST_CASE("a point is seen where it is projected, and found again by its depth") {
    const ism::Camera camera{.fx = 525, .fy = 510, .cx = 319.5, .cy = 239.5};
    // on the axis, and a known place: 0.2 m right, 0.1 m up at 2 m
    CHECK(ism::project(camera, {0, 0, 3}) == ism::Point2{319.5, 239.5});
    const ism::Point2 seen = ism::project(camera, {0.2, -0.1, 2});
    CHECK(seen.x == Approx(319.5 + 52.5));
    CHECK(seen.y == Approx(239.5 - 25.5));
    ism::Random random(3);
    for (int i = 0; i < 100; ++i) {
        const ism::Point2 pixel{random.uniform(-50, 700), random.uniform(-50, 500)};
        const double depth_m = std::exp(random.uniform(-3, 4));
        const ism::Point3 point = ism::back_project(camera, pixel, depth_m);
        CHECK(point.z == depth_m);
        const ism::Point2 again = ism::project(camera, point);
        CHECK(again.x == Approx(pixel.x).margin(1e-9));
        CHECK(again.y == Approx(pixel.y).margin(1e-9));
    }
}

TEST_CASE("a camera is refused whose numbers are outside their range") {
    const ism::Camera good{.fx = 525, .fy = 525, .cx = 320, .cy = 240};
    CHECK_NOTHROW(check(good));
    for (double ism::Camera::*focal : {&ism::Camera::fx, &ism::Camera::fy}) {
        ism::Camera camera = good;
        for (const double value : {1.0, 1e7}) {
            camera.*focal = value;
            CHECK_NOTHROW(check(camera));
            // whatever is accepted gives a position, of the farthest pixel and the largest depth too
            const ism::Point3 point =
                ism::back_project(camera, {65536, 65536}, double(std::numeric_limits<float>::max()));
            CHECK(std::isfinite(point.x));
            CHECK(std::isfinite(point.y));
        }
        for (const double value : {5e-324, 0.0, 0.999, -525.0, 1.001e7, double(INFINITY), double(NAN)}) {
            camera.*focal = value;
            CHECK_THROWS_WITH(
                check(camera),
                ism::join_text("camera focal lengths fx, fy (pixels): expected 1 to 1e+07, got ", camera.fx,
                               ", ", camera.fy));
        }
    }
    for (double ism::Camera::*centre : {&ism::Camera::cx, &ism::Camera::cy}) {
        ism::Camera camera = good;
        for (const double value : {-1e7, 0.0, 1e7}) {
            camera.*centre = value;
            CHECK_NOTHROW(check(camera));
        }
        for (const double value : {-1.001e7, 1.001e7, double(INFINITY), double(NAN)}) {
            camera.*centre = value;
            CHECK_THROWS_WITH(
                check(camera),
                ism::join_text("camera principal point cx, cy (pixels): expected -1e+07 to 1e+07, got ",
                               camera.cx, ", ", camera.cy));
        }
    }
}

TEST_CASE("units of a depth camera become metres, and no reading stays none") {
    const ism::RawDepth raw(3, 1, {0, 1000, 65535});
    const auto depth_m = ism::to_metres(raw, 0.001);
    CHECK(depth_m(0, 0) == 0);
    CHECK(depth_m(1, 0) == 1.0f);
    CHECK(depth_m(2, 0) == Approx(65.535));
    CHECK_FALSE(ism::is_depth(depth_m(0, 0)));
    CHECK(ism::is_depth(depth_m(1, 0)));
    for (const double value : {-1.0, double(NAN), double(INFINITY), double(ism::no_depth)})
        CHECK_FALSE(ism::is_depth(value));
    for (const double scale : {0.0, -0.001, double(NAN), double(INFINITY)})
        CHECK_THROWS_WITH(
            ism::to_metres(raw, scale),
            ism::join_text("depth scale (metres per unit): expected a positive number, got ", scale));
}

TEST_CASE("a frame is refused whose parts do not fit together") {
    ism::Frame frame{.gray = ism::GrayImage(32, 20, 0.5f)};
    CHECK_NOTHROW(check(frame));
    frame.color = ism::RgbImage(32, 20), frame.depth_m = ism::DepthMap(32, 20);
    frame.camera = ism::Camera{100, 100, 16, 10};
    CHECK_THROWS_WITH(check(frame), "depth image: expected at least one reading above 0, got none");
    frame.depth_m(31, 19) = ism::no_depth, frame.depth_m(0, 0) = -1;
    CHECK_THROWS_AS(check(frame), ism::Error);
    frame.depth_m(31, 19) = 0.4f;
    CHECK_NOTHROW(check(frame));
    frame.camera->fx = 0;
    CHECK_THROWS_AS(check(frame), ism::Error);
    frame.camera.reset();
    frame.color = ism::RgbImage(20, 32);
    CHECK_THROWS_WITH(check(frame), "color image size: expected 32x20, got 20x32");
    frame.color = {};
    frame.depth_m = ism::DepthMap(32, 21, 1.0f);
    CHECK_THROWS_WITH(check(frame), "depth image size: expected 32x20, got 32x21");
    CHECK_THROWS_WITH(check(ism::Frame{.gray = ism::GrayImage(15, 200)}),
                      "image size: expected at least 16x16, got 15x200");
    CHECK_THROWS_AS(check(ism::Frame{}), ism::Error);
    // the brightness is the extractor's business
    CHECK_NOTHROW(check(ism::Frame{.gray = ism::GrayImage(16, 16, NAN)}));
}
