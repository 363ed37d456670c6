// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/adapt/pcl.hpp"

#include <limits>

#include "support/catch.hpp"

#include "ism/adapt/pcl.hpp"  // a second time

namespace {

const ism::Camera camera{525, 526, 15.5, 9.5};

/// A slanted wall seen by `camera`, with one pixel that has no reading.
template <class Point = pcl::PointXYZRGB>
pcl::PointCloud<Point> wall() {
    pcl::PointCloud<Point> cloud(32, 20);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 32; ++x) {
            Point& point = cloud(x, y);
            const ism::Point3 p = ism::back_project(camera, {double(x), double(y)}, 1 + 0.01 * x);
            point.x = float(p.x), point.y = float(p.y), point.z = float(p.z);
            point.r = std::uint8_t(x), point.g = std::uint8_t(y), point.b = 200;
        }
    cloud(3, 2).x = cloud(3, 2).y = cloud(3, 2).z = std::numeric_limits<float>::quiet_NaN();
    return cloud;
}

}  // namespace

TEST_CASE("an organised cloud of PCL as a frame") {
    const ism::Frame frame = ism::to_frame(wall());
    CHECK((frame.gray.width() == 32 && frame.gray.height() == 20));
    CHECK(frame.color(7, 4) == ism::Rgb{7, 4, 200});
    CHECK(frame.gray == ism::to_gray(frame.color.view()));
    CHECK(frame.depth_m(7, 4) == 1.07f);
    CHECK_FALSE(ism::is_depth(frame.depth_m(3, 2)));
    CHECK(frame.camera->fx == Approx(camera.fx).epsilon(1e-3));
    CHECK(frame.camera->fy == Approx(camera.fy).epsilon(1e-3));
    CHECK(frame.camera->cx == Approx(camera.cx).margin(0.01));
    CHECK(frame.camera->cy == Approx(camera.cy).margin(0.01));
    CHECK(ism::to_frame(wall(), camera).camera == camera);
    CHECK(ism::to_frame(wall<pcl::PointXYZRGBA>()).color(7, 4) == ism::Rgb{7, 4, 200});
}

TEST_CASE("clouds that are no image are refused") {
    auto cloud = wall();
    cloud.width = 640, cloud.height = 1;
    CHECK_THROWS_WITH(ism::to_frame(cloud),
                      "cloud: expected an organised one (rows and columns of an image), got 640x1");
    CHECK_THROWS_AS(ism::to_frame(cloud, camera), ism::Error);
    auto moved = wall();
    for (auto& point : moved) point.x += 0.01f * float(int(point.g) % 2);
    CHECK_THROWS_WITH(ism::to_frame(moved), Catch::Contains("points on the rays of a camera"));
    auto without = wall();
    for (auto& point : without) point.z = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_WITH(ism::to_frame(without),
                      "cloud: expected points with depth in two rows and columns or more, got 0 with depth");
    auto cut = wall();
    cut.resize(32 * 19);
    cut.width = 32, cut.height = 20;
    CHECK_THROWS_WITH(ism::to_frame(cut), "cloud: points: expected 32x20, got 608");
    CHECK_THROWS_WITH(ism::to_frame(cut, camera), "cloud: points: expected 32x20, got 608");
    auto upwards = wall();
    for (auto& point : upwards) point.y = -point.y;
    CHECK_THROWS_WITH(ism::to_frame(upwards),
                      Catch::Contains("(x right, y down, z forward), got focal lengths"));
}

TEST_CASE("a single point that is off does not hide a cloud's camera") {
    auto cloud = wall();
    cloud(3, 3).x += 0.02f;
    CHECK(ism::to_frame(cloud).camera->fx == Approx(camera.fx).epsilon(0.01));
}

TEST_CASE("detections as positions and as points of the cloud") {
    ism::Detections found;
    found.objects.resize(2);
    found.objects[1].class_index = 4;
    found.objects[1].position_m = ism::Point3{1, 2, 3};
    const auto positions = ism::to_positions(found);
    REQUIRE(positions.size() == 1);
    CHECK((positions[0].label == 4 && positions[0].x == 1 && positions[0].y == 2 && positions[0].z == 3));

    const auto cloud = wall();
    ism::Segmentation part;
    part.x = 30, part.y = 18, part.mask = ism::Mask(5, 1, 1);
    const auto indices = ism::to_indices(part, 32, 20);
    REQUIRE(indices.indices == pcl::Indices{18 * 32 + 30, 18 * 32 + 31});
    CHECK((cloud[std::size_t(indices.indices[1])].r == 31 && cloud[std::size_t(indices.indices[1])].g == 18));
}
