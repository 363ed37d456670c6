// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

/// @file
/// @brief Pixels that lie in memory of somebody else: of any channel order, rows any number of bytes apart.
/// The adapters of other libraries are made of this.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>

#include "ism/core/camera.hpp"
#include "ism/core/error.hpp"
#include "ism/core/frame.hpp"
#include "ism/core/image.hpp"
#include "ism/io/limits.hpp"

namespace ism {

/// @brief What one number of a pixel is.
enum class Sample : unsigned char { uint8, uint16, float32 };

/// @brief How a pixel lies in memory: `channels` numbers, and which of them are red, green and blue. Of a
/// grey pixel they are the same one. Further channels (alpha, say) are not read.
struct PixelFormat {
    Sample sample = Sample::uint8;
    int channels = 1;
    int red = 0, green = 0, blue = 0;
    bool swapped = false;  ///< the bytes of a number are in the other order than this machine's

    [[nodiscard]] constexpr bool is_gray() const { return red == green && green == blue; }
    [[nodiscard]] constexpr int sample_bytes() const {
        return sample == Sample::uint8 ? 1 : sample == Sample::uint16 ? 2 : 4;
    }
    [[nodiscard]] constexpr int pixel_bytes() const { return channels * sample_bytes(); }
    [[nodiscard]] constexpr bool operator==(const PixelFormat&) const = default;
};

/// @brief The usual formats. One of 16 bits or floats is another with its `sample` changed.
namespace pixel_format {
inline constexpr PixelFormat gray8{}, gray16{.sample = Sample::uint16}, gray_float{.sample = Sample::float32};
inline constexpr PixelFormat rgb8{.channels = 3, .green = 1, .blue = 2},
    bgr8{.channels = 3, .red = 2, .green = 1};
inline constexpr PixelFormat rgba8{.channels = 4, .green = 1, .blue = 2},
    bgra8{.channels = 4, .red = 2, .green = 1};
}  // namespace pixel_format

/// @brief Pixels of somebody else, who keeps them alive. Rows lie `stride_bytes` apart, below 0 where the
/// first row of the picture is the last in memory.
struct RawPixels {
    const void* data = nullptr;  ///< the first pixel of the first row; need not be aligned
    int width = 0, height = 0;
    std::ptrdiff_t stride_bytes = 0;
    PixelFormat format = {};
};

/// @brief "640x480", for messages.
[[nodiscard]] inline LazyText<3> size_text(const RawPixels& pixels) {
    return lazy_text(pixels.width, "x", pixels.height);
}

/// @brief Validates what is told of the pixels.
/// @throws Error for no memory, an absurd size, rows that overlap, or a channel that a pixel lacks.
inline void check(const RawPixels& pixels) {
    const PixelFormat& format = pixels.format;
    expect(pixels.data != nullptr, "pixels", "an address", "none");
    expect(is_image_size(pixels.width, pixels.height), "pixels: size", image_size_limits, size_text(pixels));
    expect(format.channels >= 1 && format.channels <= 64, "pixels: channels", "1 ... 64", format.channels);
    for (const int channel : {format.red, format.green, format.blue})
        expect(channel >= 0 && channel < format.channels, "pixels: channel of a colour",
               lazy_text("0 ... ", format.channels - 1), channel);
    const std::ptrdiff_t row = std::ptrdiff_t(pixels.width) * format.pixel_bytes();
    expect(
        pixels.stride_bytes >= row || pixels.stride_bytes <= -row, "pixels: stride in bytes",
        lazy_text(row, " or more for rows of ", pixels.width, " pixels of ", format.pixel_bytes(), " bytes"),
        pixels.stride_bytes);
}

namespace detail {

template <class T>
[[nodiscard]] T load_sample(const std::byte* at, bool swapped) {
    std::array<std::byte, sizeof(T)> bytes;
    std::memcpy(bytes.data(), at, sizeof(T));
    if (swapped) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
}

/// Calls `make(red, green, blue)` for each pixel, its result is that of the image.
template <class T, class Pixel, class Make>
void convert_samples(const RawPixels& pixels, Image<Pixel>& image, const Make& make) {
    const PixelFormat& format = pixels.format;
    const auto step = std::ptrdiff_t(format.pixel_bytes());
    const auto offset = [](int channel) { return std::ptrdiff_t(channel) * std::ptrdiff_t(sizeof(T)); };
    const std::ptrdiff_t red = offset(format.red), green = offset(format.green), blue = offset(format.blue);
    for (int y = 0; y < pixels.height; ++y) {
        const std::byte* at = static_cast<const std::byte*>(pixels.data) + y * pixels.stride_bytes;
        for (Pixel& pixel : image.row(y)) {
            pixel = make(load_sample<T>(at + red, format.swapped), load_sample<T>(at + green, format.swapped),
                         load_sample<T>(at + blue, format.swapped));
            at += step;
        }
    }
}

template <class Pixel, class Make>
[[nodiscard]] Image<Pixel> convert_pixels(const RawPixels& pixels, const Make& make) {
    check(pixels);
    Image<Pixel> image(pixels.width, pixels.height);
    switch (pixels.format.sample) {
        case Sample::uint8:
            convert_samples<std::uint8_t>(pixels, image, make);
            break;
        case Sample::uint16:
            convert_samples<std::uint16_t>(pixels, image, make);
            break;
        case Sample::float32:
            convert_samples<float>(pixels, image, make);
    }
    return image;
}

template <class T>
inline constexpr float full_sample = std::is_same_v<T, std::uint8_t>    ? 255.0f
                                     : std::is_same_v<T, std::uint16_t> ? 65535.0f
                                                                        : 1.0f;

}  // namespace detail

/// @brief Colours, 8 bits a channel: of 16 bits the upper ones, of floats 0 … 1 the nearest.
/// @throws Error as check(const RawPixels&) does.
[[nodiscard]] inline RgbImage to_rgb(const RawPixels& pixels) {
    const auto byte = []<class T>(T value) {
        if constexpr (std::is_same_v<T, float>)
            return std::uint8_t(value > 0 ? 255 * std::min(value, 1.0f) + 0.5f : 0.0f);
        else
            return std::uint8_t(value >> (8 * (sizeof(T) - 1)));
    };
    return detail::convert_pixels<Rgb>(pixels, [&](auto r, auto g, auto b) {
        return Rgb{byte(r), byte(g), byte(b)};
    });
}

/// @brief Brightness 0 … 1, colours weighted as by to_gray(); floats are taken as brightness 0 … 1 already.
/// @throws Error as check(const RawPixels&) does.
[[nodiscard]] inline GrayImage to_gray(const RawPixels& pixels) {
    const auto weighted = []<class T>(T r, T g, T b) {
        return (0.299f * float(r) + 0.587f * float(g) + 0.114f * float(b)) / detail::full_sample<T>;
    };
    if (pixels.format.sample == Sample::uint8 && !pixels.format.is_gray())
        return to_gray(to_rgb(pixels));  // the same bits as of our images, whatever the compiler fuses
    const auto first = []<class T>(T r, T, T) { return float(r) / detail::full_sample<T>; };
    return pixels.format.is_gray() ? detail::convert_pixels<float>(pixels, first)
                                   : detail::convert_pixels<float>(pixels, weighted);
}

/// @brief Depth in metres of a depth camera's units: whole numbers of 16 bits or floats. 0 and NaN stay as
/// they are, no reading.
/// @param metres_per_unit  .001 for millimetres
/// @throws Error as check(const RawPixels&) does, for 8 bits or several channels, and for a scale that is not
/// a positive number.
[[nodiscard]] inline DepthMap to_depth(const RawPixels& pixels, double metres_per_unit) {
    expect(std::isfinite(metres_per_unit) && metres_per_unit > 0, "depth scale (metres per unit)",
           "a positive number", metres_per_unit);
    expect(pixels.format.channels == 1 && pixels.format.sample != Sample::uint8, "depth image",
           "one channel of 16 bits or floats",
           lazy_text(pixels.format.channels, pixels.format.channels == 1 ? " channel of " : " channels of ",
                     8 * pixels.format.sample_bytes(), " bits"));
    return detail::convert_pixels<float>(
        pixels, [&](auto value, auto, auto) { return float(value * metres_per_unit); });
}

namespace detail {

/// Refuses floats of 0 … 255, as conversions of other libraries leave them: nearly all of them would be
/// white.
inline void check_unit_floats(const RawPixels& picture) {
    if (picture.format.sample != Sample::float32) return;
    float least = 0, most = 1;
    bool numbers = true;
    (void)convert_pixels<std::uint8_t>(picture, [&](auto r, auto g, auto b) {
        least = std::min({least, float(r), float(g), float(b)});
        most = std::max({most, float(r), float(g), float(b)});
        numbers = numbers && std::isfinite(float(r) + float(g) + float(b));
        return std::uint8_t(0);
    });
    expect(numbers, "picture of floats", "numbers", "one that is none or infinite");
    expect(least >= -1 && most <= 2, "picture of floats", "0 to 1 (accepted: -1 to 2)",
           lazy_text(least, " to ", most));
}

}  // namespace detail

/// @brief A picture as the library takes it: brightness, and colours where there are some.
/// @throws Error as check(const RawPixels&) does, and for floats that are far from 0 ... 1.
[[nodiscard]] inline Frame to_frame(const RawPixels& picture, const std::optional<Camera>& camera = {}) {
    detail::check_unit_floats(picture);
    if (picture.format.is_gray()) return {.gray = to_gray(picture), .camera = camera};
    Frame frame{.gray = {}, .color = to_rgb(picture), .camera = camera};
    frame.gray = picture.format.sample == Sample::uint8 ? to_gray(frame.color) : to_gray(picture);
    return frame;
}

/// @brief The same with registered depth.
/// @throws Error as to_depth() does, and where depth is of another size.
[[nodiscard]] inline Frame to_frame(const RawPixels& picture, const RawPixels& depth, double metres_per_unit,
                                    const std::optional<Camera>& camera = {}) {
    expect(picture.width == depth.width && picture.height == depth.height, "depth image size",
           size_text(picture), size_text(depth));
    Frame frame = to_frame(picture, camera);
    frame.depth_m = to_depth(depth, metres_per_unit);
    return frame;
}

/// @brief The format of pixels that lie in memory as ours do.
template <class T>
inline constexpr PixelFormat format_of = {};
template <>
inline constexpr PixelFormat format_of<std::uint16_t> = pixel_format::gray16;
template <>
inline constexpr PixelFormat format_of<float> = pixel_format::gray_float;
template <>
inline constexpr PixelFormat format_of<Rgb> = pixel_format::rgb8;

/// @brief What a pixel of ours can be: std::uint8_t, std::uint16_t or float for grey ones, Rgb for those of 8
/// bits in the order r, g, b.
template <class T>
concept PixelValue = std::same_as<T, std::uint8_t> || std::same_as<T, std::uint16_t> ||
    std::same_as<T, float> || std::same_as<T, Rgb>;

/// @brief The pixels where they are, without a copy.
/// @throws Error as check(const RawPixels&) does, for another format, and where rows do not lie a whole
/// number of pixels apart or are not aligned: these have to be copied.
template <PixelValue T>
[[nodiscard]] ImageView<const T> view_of(const RawPixels& pixels) {
    check(pixels);
    constexpr PixelFormat expected = format_of<T>;
    expect(pixels.format == expected, "pixels to be seen without a copy",
           lazy_text(expected.channels, " x ", 8 * expected.sample_bytes(), " bits in this machine's order"),
           lazy_text(pixels.format.channels, " x ", 8 * pixels.format.sample_bytes(),
                     " bits in another order or kind"));
    constexpr auto size = std::ptrdiff_t(sizeof(T));
    expect(pixels.stride_bytes % size == 0, "pixels to be seen without a copy: stride in bytes",
           lazy_text("a multiple of ", size), pixels.stride_bytes);
    expect(reinterpret_cast<std::uintptr_t>(pixels.data) % alignof(T) == 0,
           "pixels to be seen without a copy: address", lazy_text("a multiple of ", alignof(T)), "another");
    return {static_cast<const T*>(pixels.data), pixels.width, pixels.height, pixels.stride_bytes / size};
}

/// @brief An image of ours as raw pixels.
template <class T>
requires PixelValue<std::remove_const_t<T>>
[[nodiscard]] RawPixels raw_pixels(ImageView<T> image) {
    return {image.width() > 0 && image.height() > 0 ? &image(0, 0) : nullptr, image.width(), image.height(),
            image.stride() * std::ptrdiff_t(sizeof(T)), format_of<std::remove_const_t<T>>};
}

}  // namespace ism
