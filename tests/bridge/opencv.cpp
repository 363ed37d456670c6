// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/adapt/opencv.hpp"

#include "support/catch.hpp"

#include "ism/adapt/opencv.hpp"  // a second time

TEST_CASE("matrices of OpenCV as pictures") {
    cv::Mat bgr(20, 30, CV_8UC3, cv::Scalar(30, 20, 10));
    bgr.at<cv::Vec3b>(4, 7) = {3, 2, 1};
    const ism::Frame frame = ism::to_frame(bgr);
    CHECK((frame.gray.width() == 30 && frame.gray.height() == 20));
    CHECK(frame.color(7, 4) == ism::Rgb{1, 2, 3});
    CHECK(frame.color(0, 0) == ism::Rgb{10, 20, 30});
    CHECK(frame.gray == ism::to_gray(frame.color.view()));

    const cv::Mat part = bgr(cv::Rect(5, 3, 16, 16));  // rows farther apart than they are long
    CHECK(ism::to_frame(part).color(2, 1) == ism::Rgb{1, 2, 3});
    CHECK(ism::raw_pixels(part).data == bgr.ptr(3, 5));

    CHECK(ism::to_frame(cv::Mat(2, 2, CV_8UC4, cv::Scalar(30, 20, 10, 0))).color(1, 1) ==
          ism::Rgb{10, 20, 30});
    CHECK(ism::to_frame(cv::Mat(2, 2, CV_8UC1, cv::Scalar(255))).gray(1, 1) == 1);
    CHECK(ism::to_frame(cv::Mat(2, 2, CV_16UC1, cv::Scalar(65535))).gray(1, 1) == 1);
    CHECK(ism::to_frame(cv::Mat(2, 2, CV_32FC3, cv::Scalar(0, 0, 1))).color(1, 1) == ism::Rgb{255, 0, 0});
    CHECK(cv::norm(ism::to_bgr(frame.color), bgr) == 0);
}

TEST_CASE("depth and camera of OpenCV") {
    const cv::Mat picture(2, 2, CV_8UC1, cv::Scalar(9));
    const cv::Matx33d k(525, 0, 1, 0, 526, 2, 0, 0, 1);
    const ism::Camera camera = ism::to_camera(cv::Mat(k));
    CHECK(camera == ism::Camera{525, 526, 1, 2});
    CHECK(ism::to_camera(cv::Mat(cv::Matx33f(k))) == camera);
    const ism::Frame units = ism::to_frame(picture, cv::Mat(2, 2, CV_16UC1, cv::Scalar(1500)), 0.001, camera);
    CHECK((units.depth_m(1, 1) == 1.5f && units.camera == camera));
    CHECK(ism::to_frame(picture, cv::Mat(2, 2, CV_32FC1, cv::Scalar(1.5)), 1).depth_m(1, 1) == 1.5f);
}

TEST_CASE("views and matrices share memory") {
    const cv::Mat floats(5, 6, CV_32FC1, cv::Scalar(.5));
    const ism::ImageView<const float> view = ism::view_of<float>(floats(cv::Rect(1, 1, 3, 3)));
    CHECK((&view(2, 1) == floats.ptr<float>(2, 3) && view.width() == 3 && view.height() == 3));
    ism::GrayImage gray(4, 3, 0.25f);
    cv::Mat mat = ism::mat_of(gray);
    mat.at<float>(2, 1) = 1;
    CHECK((gray(1, 2) == 1 && mat.rows == 3 && mat.type() == CV_32FC1));
    ism::Mask mask(4, 3);
    CHECK(ism::mat_of(mask).type() == CV_8UC1);
}

TEST_CASE("boxes and masks of detections for OpenCV") {
    CHECK(ism::to_rect({1.4, 2.6, 10, 5}, {100, 100}) == cv::Rect(1, 3, 10, 5));
    CHECK(ism::to_rect({-5, -5, 10, 300}, {100, 80}) == cv::Rect(0, 0, 5, 80));
    CHECK(ism::to_rect({200, 200, 10, 10}, {100, 80}).empty());
    ism::Segmentation part;
    part.x = -1, part.y = 2, part.mask = ism::Mask(3, 2, 1);
    part.mask(1, 1) = 0;
    const cv::Mat mat = ism::to_mat(part, {4, 3});
    CHECK(cv::countNonZero(mat) == 2);  // of the row y = 2, x = 0 and 1; all else is outside
    CHECK((mat.at<std::uint8_t>(2, 0) == 255 && mat.at<std::uint8_t>(2, 1) == 255));
    const ism::Mask whole = ism::to_mask(mat);
    CHECK((ism::mask_area(whole) == 2 && whole == ism::to_mask(mat.clone())));
}

TEST_CASE("matrices of other types are refused with what they are") {
    CHECK_THROWS_WITH(ism::to_frame(cv::Mat(2, 2, CV_64FC1)),
                      "cv::Mat: type: expected CV_8U, CV_16U or CV_32F of 1, 3 or 4 channels, got CV_64FC1");
    CHECK_THROWS_WITH(ism::to_frame(cv::Mat(2, 2, CV_8UC2)), Catch::Contains("got CV_8UC2"));
    CHECK_THROWS_WITH(ism::to_frame(cv::Mat()),
                      Catch::StartsWith("cv::Mat: expected two dimensions, not empty"));
    CHECK_THROWS_WITH(
        ism::to_frame(cv::Mat(2, 2, CV_8UC1), cv::Mat(2, 2, CV_8UC3), 1),
        Catch::Contains("depth image: expected one channel of 16 bits or floats, got 3 channels of 8 bits"));
    CHECK_THROWS_WITH(ism::to_frame(cv::Mat(2, 2, CV_8UC1), cv::Mat(3, 2, CV_16UC1), 1),
                      "depth image size: expected 2x2, got 2x3");
    CHECK_THROWS_AS(ism::view_of<float>(cv::Mat(2, 2, CV_8UC1)), ism::Error);
    CHECK_THROWS_WITH(ism::to_mask(cv::Mat(2, 2, CV_8UC3)), "mask: type: expected CV_8UC1, got CV_8UC3");
    const cv::Mat k = (cv::Mat_<double>(3, 3) << 525, 0, 320, 0, 526, 240, 0, 0, 1);
    CHECK(ism::to_camera(k) == ism::Camera{525, 526, 320, 240});
    CHECK_THROWS_WITH(
        ism::to_camera(cv::Mat(k.t())),
        "camera matrix: expected zeros below its diagonal (is it transposed?), got 0, 320, 240");
    CHECK_THROWS_WITH(ism::to_camera(cv::Mat(k * 2)), "camera matrix: its last number: expected 1, got 2");
    // cv::Mat::convertTo() keeps 0 ... 255
    CHECK_THROWS_WITH(ism::to_frame(cv::Mat(2, 2, CV_32FC3, cv::Scalar(7, 8, 90))),
                      "picture of floats: expected 0 to 1 (accepted: -1 to 2), got 0 to 90");
    CHECK_THROWS_WITH(ism::to_camera(cv::Mat(3, 2, CV_64F)),
                      "camera matrix: expected 3x3 of CV_64FC1 or CV_32FC1, got 3x2 of CV_64FC1");
}
