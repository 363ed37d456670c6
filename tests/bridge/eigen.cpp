// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/adapt/eigen.hpp"

#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "support/catch.hpp"

#include "ism/adapt/eigen.hpp"  // a second time
#include "ism/adapt/pixels.hpp"

TEST_CASE("images as arrays of Eigen on the same memory") {
    ism::GrayImage image(4, 3, 0.5f);
    auto map = ism::eigen_map(image);
    CHECK((map.rows() == 3 && map.cols() == 4));
    map(2, 1) = 7;
    CHECK(image(1, 2) == 7);
    map += 1;
    CHECK(image(0, 0) == 1.5f);
    const auto part = ism::eigen_map(std::as_const(image).view().region(1, 1, 2, 2));
    CHECK((part(1, 0) == 8 && part.sum() == 8 + 3 * 1.5f));
    static_assert(std::is_same_v<decltype(ism::eigen_map(std::as_const(image)))::Scalar, float>);
    CHECK(ism::eigen_map(ism::GrayImage().view()).size() == 0);
}

TEST_CASE("arrays of Eigen as views") {
    ism::EigenImage<float> array = ism::EigenImage<float>::Zero(3, 5);
    array(2, 1) = 4;
    const auto whole = ism::view_of(array);
    CHECK((whole.width() == 5 && whole.height() == 3 && whole(1, 2) == 4 && &whole(0, 0) == array.data()));
    const auto part = ism::view_of(array.block(1, 1, 2, 3));
    CHECK((part.width() == 3 && part(0, 1) == 4 && part.stride() == 5));
    const Eigen::Map<ism::EigenImage<float>, 0, Eigen::Stride<5, 2>> every_other(array.data(), 2, 2);
    CHECK_THROWS_WITH(ism::view_of(every_other), "view of an Eigen matrix: inner stride: expected 1, got 2");
}

TEST_CASE("pixels are seen without a copy where Eigen is included, too") {
    const std::vector<std::uint8_t> values{1, 2, 3, 4, 5, 6};
    const ism::RawPixels gray{.data = values.data(),
                              .width = 3,
                              .height = 2,
                              .stride_bytes = 3,
                              .format = ism::pixel_format::gray8};
    CHECK(ism::view_of<std::uint8_t>(gray)(2, 1) == 6);
    const ism::RawPixels color{
        .data = values.data(), .width = 1, .height = 2, .stride_bytes = 3, .format = ism::pixel_format::rgb8};
    CHECK(ism::view_of<ism::Rgb>(color)(0, 1).g == 5);
}

TEST_CASE("positions, rotations and cameras for Eigen and back") {
    const ism::Rotation turn = ism::rotation_around({1, 2, 3}, 0.7);
    const ism::Vec3f v{0.3f, -0.2f, 0.9f};
    CHECK((ism::to_eigen(turn) * ism::to_eigen(v) - ism::to_eigen(ism::rotate(turn, v))).norm() < 1e-6);
    const ism::Rotation back = ism::to_rotation(Eigen::Quaternionf(2 * ism::to_eigen(turn).coeffs()));
    CHECK(back.w == Approx(turn.w));
    CHECK(back.z == Approx(turn.z));
    CHECK(ism::to_point3(ism::to_eigen(ism::Point3{1, 2, 3})) == ism::Point3{1, 2, 3});

    const ism::Camera camera{500, 510, 320, 240};
    const Eigen::Vector3d seen = ism::to_eigen(camera) * Eigen::Vector3d(0.1, 0.2, 2);
    const ism::Point2 pixel = ism::project(camera, {0.1, 0.2, 2});
    CHECK(seen.x() / seen.z() == Approx(pixel.x));
    CHECK(seen.y() / seen.z() == Approx(pixel.y));
    CHECK(ism::to_camera(ism::to_eigen(camera)) == camera);
    CHECK_THROWS_AS(ism::to_camera(Eigen::Matrix3d::Zero()), ism::Error);
    CHECK_THROWS_AS(ism::to_camera(ism::to_eigen(camera).transpose()), ism::Error);
}

TEST_CASE("the pose of a detection as Eigen has it") {
    ism::Detection detection;
    CHECK_FALSE(ism::camera_from_object(detection));
    detection.position_m = ism::Point3{1, 2, 3};
    CHECK(ism::camera_from_object(detection)->linear().isIdentity());
    detection.rotation = ism::rotation_around({0, 0, 1}, std::acos(0.0));  // x becomes y
    const Eigen::Vector3d at = *ism::camera_from_object(detection) * Eigen::Vector3d(1, 0, 0);
    CHECK((at - Eigen::Vector3d(1, 3, 3)).norm() < 1e-6);
}
