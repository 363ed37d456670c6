// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "support/catch.hpp"

#include "ism/dataset/inspect.hpp"

namespace inspected {
namespace {

// an image of 100×80 pixels with one labelled box, and a depth of `depth_m` everywhere
ism::DatasetImage image_with(const ism::Box& box) {
    ism::DatasetImage image{.id = 1, .file = "a.png", .width = 100, .height = 80, .depth_scale = 0.001};
    image.objects.push_back({.id = 1, .box = box});
    return image;
}
ism::Frame frame_of(float depth_m = 0) {
    ism::Frame frame{.gray = ism::GrayImage(100, 80), .color = ism::RgbImage(100, 80)};
    if (depth_m > 0) frame.depth_m = ism::DepthMap(100, 80, depth_m);
    return frame;
}
ism::CompressedRle filled(int x0, int y0, int x1, int y1) {
    ism::Mask mask(100, 80);
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) mask(x, y) = 1;
    return ism::compress_mask(mask);
}
std::vector<std::string> kinds_of(const ism::DatasetImage& image, const ism::Frame& frame) {
    std::vector<std::string> kinds;
    for (const ism::Remark& remark : ism::inspect_image(image, frame).remarks) kinds.push_back(remark.kind);
    return kinds;
}
using Kinds = std::vector<std::string>;

}  // namespace

TEST_CASE("A sound label gives facts and no remark") {
    ism::DatasetImage image = image_with({20, 10, 40, 40});
    image.objects[0].segmentation = filled(20, 10, 60, 50);
    ism::Frame frame = frame_of(0.7f);
    for (int x = 20; x < 30; ++x)
        for (int y = 10; y < 50; ++y) frame.depth_m(x, y) = ism::no_depth;
    const ism::ImageFacts facts = ism::inspect_image(image, frame);
    CHECK(facts.remarks.empty());
    REQUIRE(facts.objects.size() == 1);
    CHECK(facts.objects[0].size_px == 40);
    CHECK(facts.objects[0].masked);
    CHECK(facts.objects[0].depth_share == 0.75);
    CHECK(facts.objects[0].depth_m == Approx(0.7));
    CHECK(facts.depth_share == Approx(0.95));
}

TEST_CASE("What looks wrong with a label is remarked") {
    CHECK(kinds_of(image_with({20, 10, 40, 6}), frame_of()) == Kinds{"tiny box"});
    CHECK(kinds_of(image_with({80, 10, 40, 40}), frame_of()) == Kinds{"box outside the image"});
    ism::DatasetImage image = image_with({20, 10, 40, 40});
    image.objects[0].segmentation = filled(40, 10, 80, 50);
    CHECK(kinds_of(image, frame_of()) == Kinds{"mask outside its box"});
    image.objects[0].segmentation = filled(20, 10, 30, 50);
    CHECK(kinds_of(image, frame_of()) == Kinds{"box much larger than its mask"});
    image.objects[0].segmentation = filled(0, 0, 0, 0);
    CHECK(kinds_of(image, frame_of()) == Kinds{"bad mask"});
    image = image_with({20, 10, 40, 40});
    image.objects.push_back(image.objects[0]);
    CHECK(kinds_of(image, frame_of()) == Kinds{"labelled twice"});
    image.objects[1].class_index = 1;
    CHECK(kinds_of(image, frame_of()) == Kinds{"two classes in one box"});
    image.objects[1].box = {20, 10, 30, 40};
    CHECK(kinds_of(image, frame_of()).empty());
    image.objects[1] = {.id = 2, .box = {1, 1, 2, 2}, .crowd = true};
    CHECK(kinds_of(image, frame_of()).empty());
}

TEST_CASE("Labels of one picture are the same in any order, and others with another class or box") {
    ism::DatasetImage image = image_with({20, 10, 40, 40});
    image.objects.push_back({.id = 2, .class_index = 1, .box = {1, 1, 20, 20}});
    ism::DatasetImage other = image;
    std::swap(other.objects[0], other.objects[1]);
    CHECK(ism::same_labels(image, other));
    other.objects[0].class_index = 0;
    CHECK_FALSE(ism::same_labels(image, other));
    other.objects[0] = image.objects[1], other.objects[1].box.x = 21;
    CHECK_FALSE(ism::same_labels(image, other));
    other.objects.pop_back();
    CHECK_FALSE(ism::same_labels(image, other));
}

TEST_CASE("A depth scale that puts objects far away, and depth that lacks them, are remarked") {
    const ism::DatasetImage image = image_with({20, 10, 40, 40});
    CHECK(kinds_of(image, frame_of(500)) == Kinds{"depth scale"});
    CHECK(kinds_of(image, frame_of(0.0007f)) == Kinds{"depth scale"});
    ism::Frame frame = frame_of(0.7f);
    for (float& depth_m : frame.depth_m.pixels()) depth_m = ism::no_depth;
    frame.depth_m(0, 0) = 0.7f;
    CHECK(kinds_of(image, frame) == Kinds{"little depth"});
    ism::DatasetImage covered = image;
    covered.depth_file = "d.png";
    CHECK(kinds_of(covered, frame_of()) == Kinds{"depth without a reading"});
}

TEST_CASE("A camera that cannot be that of its images is remarked") {
    ism::Frame frame = frame_of();
    const auto kinds_with = [&](const ism::Camera& camera) {
        frame.camera = camera;
        return kinds_of(image_with({20, 10, 40, 40}), frame);
    };
    CHECK(kinds_with({90, 90, 50, 40}).empty());
    CHECK(kinds_with({90, 91, 3, 70}).empty());
    CHECK(kinds_with({55, 40, 50, 40}).empty());
    CHECK(kinds_with({90, 90, 101, 40}) == Kinds{"camera"});
    CHECK(kinds_with({50, 40, 90, 90}) == Kinds{"camera"});
    CHECK(ism::camera_doubt({525, 525, 640.5, 240}, 640, 480) ==
          "the camera's principal point (640.5, 240) is outside of the image of 640x480 pixels");
    CHECK(ism::camera_doubt({319.5, 239.5, 525, 525}, 640, 480) ==
          "the camera's principal point (525, 525) is outside of the image of 640x480 pixels; "
          "are cx, cy given as fx, fy?");
    CHECK(ism::camera_doubt({640, 360, 700, 701}, 1280, 720) ==
          "the camera's principal point (700, 701) is not in the middle of the image of 1280x720 pixels; "
          "are cx, cy given as fx, fy?");
    CHECK(ism::camera_doubt({300, 300, 290, 291}, 640, 480).empty());  // a wide lens
}

TEST_CASE("A position that is not where its object is seen is remarked") {
    ism::DatasetImage image = image_with({20, 10, 40, 40});
    ism::Frame frame = frame_of(0.7f);
    frame.camera = ism::Camera{90, 90, 50, 40};
    const auto kinds_at = [&](const ism::Point3& position_m) {
        image.objects[0].position_m = position_m;
        return kinds_of(image, frame);
    };
    const ism::Point3 middle = ism::back_project(*frame.camera, {40, 30}, 0.75);
    CHECK(kinds_at(middle).empty());
    CHECK(kinds_at(ism::back_project(*frame.camera, {62, 30}, 0.7)).empty());
    CHECK(kinds_at(ism::back_project(*frame.camera, {90, 30}, 0.7)) == Kinds{"position"});
    CHECK(kinds_at({1000 * middle.x, 1000 * middle.y, 1000 * middle.z}) == Kinds{"position"});
    CHECK(kinds_at({0.1 * middle.x, 0.1 * middle.y, 0.1 * middle.z}) == Kinds{"position"});
    frame.depth_m = {};
    CHECK(kinds_at({0.1 * middle.x, 0.1 * middle.y, 0.1 * middle.z}).empty());
    frame.camera.reset();
    CHECK(kinds_at({3, 3, 3}).empty());
}

TEST_CASE("Pictures have the same fingerprint where all pixels are the same") {
    ism::Frame frame = frame_of();
    const auto before = ism::inspect_image(image_with({20, 10, 40, 40}), frame).fingerprint;
    CHECK(ism::inspect_image(image_with({1, 2, 30, 30}), frame).fingerprint == before);
    frame.color(99, 79).b = 1;
    CHECK(ism::inspect_image(image_with({20, 10, 40, 40}), frame).fingerprint != before);
}

}  // namespace inspected
