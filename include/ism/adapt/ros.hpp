// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

/// @file
/// @brief ROS 1 and 2: messages by their shape, so nothing of ROS is included. Any struct with the members of
/// sensor_msgs/Image or sensor_msgs/CameraInfo will do.

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "ism/adapt/pixels.hpp"
#include "ism/core/camera.hpp"
#include "ism/core/error.hpp"
#include "ism/core/frame.hpp"
#include "ism/io/limits.hpp"

namespace ism {

/// @brief sensor_msgs::Image (ROS 1) and sensor_msgs::msg::Image (ROS 2).
template <class M>
concept RosImage = requires(const M& message) {
    { message.width } -> std::convertible_to<std::uint32_t>;
    { message.height } -> std::convertible_to<std::uint32_t>;
    { message.step } -> std::convertible_to<std::uint32_t>;
    { message.is_bigendian } -> std::convertible_to<int>;
    { message.encoding } -> std::convertible_to<std::string_view>;
    { message.data.data() } -> std::convertible_to<const std::uint8_t*>;
    { message.data.size() } -> std::convertible_to<std::size_t>;
};

/// @brief sensor_msgs::msg::CameraInfo (ROS 2, members k and p) and sensor_msgs::CameraInfo (ROS 1, members K
/// and P). P may be missing.
template <class M>
concept RosCameraInfo = requires(const M& message) {
    { message.k[0] } -> std::convertible_to<double>;
}
|| requires(const M& message) {
    { message.K[0] } -> std::convertible_to<double>;
};

namespace detail {

[[nodiscard]] constexpr PixelFormat of_16_bits(PixelFormat format) {
    format.sample = Sample::uint16;
    return format;
}

struct RosEncoding {
    std::string_view name;
    PixelFormat format;
};
inline constexpr std::array ros_encodings{
    RosEncoding{"mono8", pixel_format::gray8},
    RosEncoding{"8UC1", pixel_format::gray8},
    RosEncoding{"rgb8", pixel_format::rgb8},
    RosEncoding{"bgr8", pixel_format::bgr8},
    RosEncoding{"rgba8", pixel_format::rgba8},
    RosEncoding{"bgra8", pixel_format::bgra8},
    RosEncoding{"mono16", pixel_format::gray16},
    RosEncoding{"16UC1", pixel_format::gray16},
    RosEncoding{"rgb16", of_16_bits(pixel_format::rgb8)},
    RosEncoding{"bgr16", of_16_bits(pixel_format::bgr8)},
    RosEncoding{"32FC1", pixel_format::gray_float},
};

}  // namespace detail

/// @brief The pixels of a message where they are, without a copy; it has to stay as long as the result is
/// used. Numbers of either byte order.
/// @throws Error for an encoding other than mono8, 8UC1, rgb8, bgr8, rgba8, bgra8, mono16, 16UC1, rgb16,
/// bgr16 and 32FC1, a step that is too small, or data that end early.
template <RosImage M>
[[nodiscard]] RawPixels raw_pixels(const M& message) {
    const std::string_view encoding = message.encoding;
    const detail::RosEncoding* known = nullptr;
    for (const detail::RosEncoding& candidate : detail::ros_encodings)
        if (candidate.name == encoding) known = &candidate;
    expect(known != nullptr, "image message: encoding",
           "mono8, 8UC1, rgb8, bgr8, rgba8, bgra8, mono16, 16UC1, rgb16, bgr16 or 32FC1",
           lazy_text("'", encoding, "'"));
    const std::uint64_t width = message.width, height = message.height, step = message.step;
    const std::uint64_t row_bytes = width * std::uint64_t(known->format.pixel_bytes());
    expect(width > 0 && height > 0 && width <= max_image_side && height <= max_image_side,
           "image message: size", image_size_limits, lazy_text(width, "x", height));
    expect(step >= row_bytes, "image message: step",
           lazy_text(row_bytes, " or more for ", width, " pixels of ", encoding), step);
    expect(message.data.size() / step >= height, "image message: bytes of data",
           lazy_text(step * height, " (step ", step, " x height ", height, ")"), message.data.size());
    RawPixels pixels{message.data.data(), int(width), int(height), std::ptrdiff_t(step), known->format};
    pixels.format.swapped = known->format.sample != Sample::uint8 &&
                            (message.is_bigendian != 0) != (std::endian::native == std::endian::big);
    check(pixels);
    return pixels;
}

/// @brief The camera of a message. Pictures have to be rectified (image_rect): it is that of rectified
/// pictures, P, or where P is missing or 0 that of K, and the distortion is not looked at.
/// @throws Error for a camera that is not calibrated, and as camera_of_matrix() does.
template <RosCameraInfo M>
[[nodiscard]] Camera to_camera(const M& message) {
    const auto rectified = [](const auto& p) {
        return camera_of_matrix({p[0], p[1], p[2], p[4], p[5], p[6], p[8], p[9], p[10]});
    };
    const auto raw = [](const auto& k) {
        expect(k[0] != 0, "camera message", "a calibrated camera", "a matrix K of zeros");
        return camera_of_matrix({k[0], k[1], k[2], k[3], k[4], k[5], k[6], k[7], k[8]});
    };
    if constexpr (requires { message.p[0]; })
        if (message.p[0] != 0) return rectified(message.p);
    if constexpr (requires { message.P[0]; })
        if (message.P[0] != 0) return rectified(message.P);
    if constexpr (requires { message.k[0]; })
        return raw(message.k);
    else
        return raw(message.K);
}

/// @brief A picture.
/// @throws Error as raw_pixels(const RosImage&) does.
template <RosImage M>
[[nodiscard]] Frame to_frame(const M& picture, const std::optional<Camera>& camera = {}) {
    return to_frame(raw_pixels(picture), camera);
}

/// @brief A picture with registered depth: 16UC1 in millimetres or 32FC1 in metres (REP 118).
/// @throws Error as raw_pixels(const RosImage&), to_depth() and to_camera() do.
template <RosImage M, RosImage D, RosCameraInfo C>
[[nodiscard]] Frame to_frame(const M& picture, const D& depth, const C& info) {
    const RawPixels pixels = raw_pixels(depth);
    return to_frame(raw_pixels(picture), pixels, pixels.format.sample == Sample::float32 ? 1 : 0.001,
                    to_camera(info));
}

}  // namespace ism
