// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

/// @file
/// @brief OpenCV: cv::Mat as pictures, depth and views; images, masks and boxes of ours as those of OpenCV.
/// Needs its module core alone.

#if !__has_include(<opencv2/core.hpp>)
#error "ism/adapt/opencv.hpp needs OpenCV (Debian: libopencv-dev), by find_package(OpenCV) in CMake"
#include "ism_needs_OpenCV"  // no such file: the compilation ends here
#endif
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

#include <opencv2/core.hpp>

#include "ism/adapt/pixels.hpp"
#include "ism/core/camera.hpp"
#include "ism/core/error.hpp"
#include "ism/core/frame.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/detect/detection.hpp"

namespace ism {

/// @brief A matrix where it is, without a copy: 1 channel, 3 (b, g, r) or 4 (b, g, r, alpha), of 8 or 16 bits
/// or floats. It has to stay as long as the result is used.
/// @throws Error for an empty matrix, or one of another type or number of dimensions.
[[nodiscard]] inline RawPixels raw_pixels(const cv::Mat& mat) {
    expect(!mat.empty() && mat.dims == 2, "cv::Mat", "two dimensions, not empty",
           lazy_text(mat.dims, " dimensions, ", mat.total(), " pixels"));
    const int channels = mat.channels();
    const bool known = mat.depth() == CV_8U || mat.depth() == CV_16U || mat.depth() == CV_32F;
    expect(known && (channels == 1 || channels == 3 || channels == 4), "cv::Mat: type",
           "CV_8U, CV_16U or CV_32F of 1, 3 or 4 channels", cv::typeToString(mat.type()));
    PixelFormat format = channels == 1   ? pixel_format::gray8
                         : channels == 3 ? pixel_format::bgr8
                                         : pixel_format::bgra8;
    format.sample = mat.depth() == CV_8U    ? Sample::uint8
                    : mat.depth() == CV_16U ? Sample::uint16
                                            : Sample::float32;
    return {mat.data, mat.cols, mat.rows, std::ptrdiff_t(mat.step[0]), format};
}

/// @brief A picture: brightness, and colours where there are some (b, g, r as OpenCV has them).
/// @throws Error as raw_pixels(const cv::Mat&) does.
[[nodiscard]] inline Frame to_frame(const cv::Mat& picture, const std::optional<Camera>& camera = {}) {
    return to_frame(raw_pixels(picture), camera);
}

/// @brief A picture with registered depth (CV_16UC1 or CV_32FC1).
/// @param metres_per_unit  of the depth: .001 for millimetres, 1 for metres
/// @throws Error as raw_pixels(const cv::Mat&) and to_depth() do.
[[nodiscard]] inline Frame to_frame(const cv::Mat& picture, const cv::Mat& depth, double metres_per_unit,
                                    const std::optional<Camera>& camera = {}) {
    return to_frame(raw_pixels(picture), raw_pixels(depth), metres_per_unit, camera);
}

/// @brief A matrix of one channel as a view, without a copy.
/// @tparam T  std::uint8_t, std::uint16_t or float
/// @throws Error as view_of(const RawPixels&) does.
template <class T>
[[nodiscard]] ImageView<const T> view_of(const cv::Mat& mat) {
    return view_of<T>(raw_pixels(mat));
}

/// @brief Not of a matrix that is gone with the expression that computes it.
template <class T>
ImageView<const T> view_of(const cv::MatExpr&) = delete;

/// @brief A mask: what is not 0 is figure.
/// @throws Error where the matrix is not CV_8UC1.
[[nodiscard]] inline Mask to_mask(const cv::Mat& mat) {
    expect(mat.type() == CV_8UC1, "mask: type", "CV_8UC1", cv::typeToString(mat.type()));
    const auto view = view_of<std::uint8_t>(mat);
    Mask mask(view.width(), view.height());
    for (int y = 0; y < view.height(); ++y) std::copy_n(&view(0, y), view.width(), mask.row(y).begin());
    return mask;
}

/// @brief The camera of a matrix K (3 × 3, CV_64F or CV_32F), as cv::calibrateCamera() gives it. Pictures
/// have to be without distortion: see cv::undistort().
/// @throws Error for another size or type, and as camera_of_matrix() does.
[[nodiscard]] inline Camera to_camera(const cv::Mat& k) {
    const bool is_k = k.dims == 2 && k.rows == 3 && k.cols == 3 && (k.type() == CV_64F || k.type() == CV_32F);
    expect(is_k, "camera matrix", "3x3 of CV_64FC1 or CV_32FC1",
           lazy_text(k.rows, "x", k.cols, " of ", cv::typeToString(k.type())));
    const auto at = [&](int y, int x) { return k.type() == CV_64F ? k.at<double>(y, x) : k.at<float>(y, x); };
    return camera_of_matrix(
        {at(0, 0), at(0, 1), at(0, 2), at(1, 0), at(1, 1), at(1, 2), at(2, 0), at(2, 1), at(2, 2)});
}

/// @brief A grey image of ours as a matrix on the same memory, without a copy. It has to stay as long as the
/// matrix. CV_8UC1, CV_16UC1 or CV_32FC1.
template <class T>
requires std::is_same_v<T, std::uint8_t> || std::is_same_v<T, std::uint16_t> || std::is_same_v<T, float>
[[nodiscard]] cv::Mat mat_of(Image<T>& image) {
    return {image.height(), image.width(), cv::DataType<T>::type, image.pixels().data()};
}

/// @brief The same to read from.
template <class T>
requires std::is_same_v<T, std::uint8_t> || std::is_same_v<T, std::uint16_t> || std::is_same_v<T, float>
[[nodiscard]] const cv::Mat mat_of(const Image<T>& image) {
    return mat_of(const_cast<Image<T>&>(image));
}
template <class T>
cv::Mat mat_of(const Image<T>&&) = delete;

/// @brief Colours as OpenCV has them, CV_8UC3 in the order b, g, r.
[[nodiscard]] inline cv::Mat to_bgr(const RgbImage& image) {
    cv::Mat mat(image.height(), image.width(), CV_8UC3);
    for (int y = 0; y < image.height(); ++y) {
        auto* at = mat.ptr<cv::Vec3b>(y);
        for (const Rgb& pixel : image.row(y)) *at++ = {pixel.b, pixel.g, pixel.r};
    }
    return mat;
}

/// @brief The whole pixels that a box covers more than half, cut off at the image's edges.
[[nodiscard]] inline cv::Rect to_rect(const Box& box, cv::Size image) {
    const auto whole = [](double value, int most) {
        return int(std::lround(std::clamp(value, 0.0, double(most))));
    };
    const int x = whole(box.x, image.width), y = whole(box.y, image.height);
    return {x, y, whole(box.x + box.width, image.width) - x, whole(box.y + box.height, image.height) - y};
}

/// @brief The mask of a detection in the image: CV_8UC1, 255 = figure.
[[nodiscard]] inline cv::Mat to_mat(const Segmentation& segmentation, cv::Size image) {
    cv::Mat mat = cv::Mat::zeros(image, CV_8UC1);
    const Mask& mask = segmentation.mask;
    for (int y = std::max(0, -segmentation.y); y < std::min(mask.height(), image.height - segmentation.y);
         ++y)
        for (int x = std::max(0, -segmentation.x); x < std::min(mask.width(), image.width - segmentation.x);
             ++x)
            if (mask(x, y) != 0) mat.at<std::uint8_t>(segmentation.y + y, segmentation.x + x) = 255;
    return mat;
}

}  // namespace ism
