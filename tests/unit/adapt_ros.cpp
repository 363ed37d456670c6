// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "support/catch.hpp"

#include "ism/adapt/ros.hpp"

namespace {

/// The shapes of the messages: those of ROS have these members and more.
struct ImageMessage {
    std::uint32_t height = 0, width = 0;
    std::string encoding;
    std::uint8_t is_bigendian = 0;
    std::uint32_t step = 0;
    std::vector<std::uint8_t> data;
};
struct InfoMessage2 {  // of ROS 2
    std::uint32_t height = 0, width = 0;
    std::array<double, 9> k{};
};
struct RectifiedMessage2 {
    std::array<double, 9> k{};
    std::array<double, 12> p{};
};
struct RectifiedMessage1 {
    std::array<double, 9> K{};
    std::array<double, 12> P{};
};
struct InfoMessage1 {  // of ROS 1
    std::array<double, 9> K{};
};
static_assert(ism::RosImage<ImageMessage> && !ism::RosImage<InfoMessage2>);
static_assert(ism::RosCameraInfo<InfoMessage1> && ism::RosCameraInfo<InfoMessage2>);

constexpr std::array<double, 9> intrinsics{525, 0, 319.5, 0, 526, 239.5, 0, 0, 1};

ImageMessage picture(const std::string& encoding, std::uint32_t width, std::vector<std::uint8_t> row) {
    const auto step = std::uint32_t(row.size());
    return {1, width, encoding, 0, step, std::move(row)};
}

}  // namespace

TEST_CASE("image messages in each encoding") {
    CHECK(ism::to_frame(picture("mono8", 2, {0, 255, 9, 9})).gray(1, 0) == 1);
    for (const auto& [encoding, bytes] : std::vector<std::pair<std::string, std::vector<std::uint8_t>>>{
             {"rgb8", {1, 2, 3}}, {"bgr8", {3, 2, 1}}, {"rgba8", {1, 2, 3, 0}}, {"bgra8", {3, 2, 1, 0}}})
        CHECK(ism::to_frame(picture(encoding, 1, bytes)).color(0, 0) == ism::Rgb{1, 2, 3});
    CHECK(ism::to_frame(picture("mono16", 1, {255, 255})).gray(0, 0) == 1);
    CHECK(ism::to_frame(picture("8UC1", 1, {255})).gray(0, 0) == 1);
    for (const auto& [encoding, bytes] : std::vector<std::pair<std::string, std::vector<std::uint8_t>>>{
             {"rgb16", {9, 1, 9, 2, 9, 3}}, {"bgr16", {9, 3, 9, 2, 9, 1}}})
        CHECK(ism::to_frame(picture(encoding, 1, bytes)).color(0, 0) == ism::Rgb{1, 2, 3});
}

TEST_CASE("an image message with depth and camera") {
    const ImageMessage color = picture("rgb8", 2, {1, 2, 3, 4, 5, 6});
    ImageMessage units = picture("16UC1", 2, {0xe8, 0x03, 0, 0});  // 1000 mm
    const ism::Frame frame = ism::to_frame(color, units, InfoMessage2{480, 640, intrinsics});
    CHECK((frame.depth_m(0, 0) == 1.0f && frame.depth_m(1, 0) == 0));
    CHECK(frame.camera == ism::Camera{525, 526, 319.5, 239.5});
    CHECK(ism::to_camera(InfoMessage1{intrinsics}) == *frame.camera);

    units.data = {0x03, 0xe8, 0, 0}, units.is_bigendian = 1;
    CHECK(ism::to_frame(color, units, InfoMessage1{intrinsics}).depth_m(0, 0) == 1.0f);

    const ImageMessage metres = picture("32FC1", 2, {0, 0, 0, 0x40, 0, 0, 0, 0});  // 2 m
    CHECK(ism::to_frame(color, metres, InfoMessage1{intrinsics}).depth_m(0, 0) == 2);
}

TEST_CASE("the camera of a rectified picture is that of P, where there is one") {
    const std::array<double, 12> of_rectified{400, 0, 300, -50, 0, 410, 200, 0, 0, 0, 1, 0};
    const ism::Camera camera{400, 410, 300, 200}, raw{525, 526, 319.5, 239.5};
    CHECK(ism::to_camera(RectifiedMessage2{intrinsics, of_rectified}) == camera);
    CHECK(ism::to_camera(RectifiedMessage1{intrinsics, of_rectified}) == camera);
    CHECK(ism::to_camera(RectifiedMessage2{intrinsics, {}}) == raw);
    CHECK(ism::to_camera(RectifiedMessage1{intrinsics, {}}) == raw);
}

TEST_CASE("messages that contradict themselves are refused") {
    CHECK_THROWS_WITH(
        ism::to_frame(picture("yuv422", 1, {0, 0})),
        "image message: encoding: expected mono8, 8UC1, rgb8, bgr8, rgba8, bgra8, mono16, 16UC1, rgb16, "
        "bgr16 or 32FC1, got 'yuv422'");
    ImageMessage cut = picture("mono8", 2, {1, 2});
    cut.height = 2;
    CHECK_THROWS_WITH(ism::to_frame(cut),
                      "image message: bytes of data: expected 4 (step 2 x height 2), got 2");
    CHECK_THROWS_WITH(ism::to_frame(picture("rgb8", 2, {1, 2})),
                      "image message: step: expected 6 or more for 2 pixels of rgb8, got 2");
    CHECK_THROWS_WITH(ism::to_frame(ImageMessage{2, 2, "mono8", 0, 0, {}}),
                      "image message: step: expected 2 or more for 2 pixels of mono8, got 0");
    CHECK_THROWS_WITH(ism::to_frame(ImageMessage{0, 0, "mono8", 0, 0, {}}),
                      Catch::StartsWith("image message: size: expected") && Catch::EndsWith("got 0x0"));
    CHECK_THROWS_WITH(ism::to_camera(InfoMessage2{}),
                      "camera message: expected a calibrated camera, got a matrix K of zeros");
    CHECK_THROWS_WITH(
        ism::to_frame(picture("mono8", 2, {1, 2}), picture("mono8", 2, {1, 2}), InfoMessage1{intrinsics}),
        Catch::Contains("one channel of 16 bits or floats"));
}
