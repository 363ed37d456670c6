// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"

namespace ism {

/// @brief One 8-bit colour pixel.
struct Rgb {
    std::uint8_t r = 0, g = 0, b = 0;
    [[nodiscard]] constexpr bool operator==(const Rgb&) const = default;
};

/// @brief Pixel types: plain values that can be copied byte by byte.
template <class T>
concept Pixel = std::is_trivially_copyable_v<T> && std::is_default_constructible_v<T>;

/// @brief A non-owning rectangle of pixels. Rows lie `stride` pixels apart.
/// Pixel (x, y) has its centre at the coordinates (x, y); x runs right, y down.
template <class T>
requires Pixel<std::remove_const_t<T>>
class ImageView {
public:
    constexpr ImageView() = default;

    /// @brief A view of `height` rows of `width` pixels, the first at `data`.
    constexpr ImageView(T* data, int width, int height, std::ptrdiff_t stride)
        : data_(data), width_(width), height_(height), stride_(stride) {}

    /// @brief A mutable view converts to a read-only one.
    constexpr operator ImageView<const T>() const requires(!std::is_const_v<T>) {
        return {data_, width_, height_, stride_};
    }

    [[nodiscard]] constexpr int width() const { return width_; }
    [[nodiscard]] constexpr int height() const { return height_; }
    [[nodiscard]] constexpr std::ptrdiff_t stride() const { return stride_; }
    [[nodiscard]] constexpr bool empty() const { return width_ <= 0 || height_ <= 0; }
    [[nodiscard]] constexpr bool contains(int x, int y) const {
        return x >= 0 && y >= 0 && x < width_ && y < height_;
    }

    [[nodiscard]] constexpr T& operator()(int x, int y) const { return data_[y * stride_ + x]; }
    [[nodiscard]] constexpr std::span<T> row(int y) const {
        return {data_ + y * stride_, static_cast<std::size_t>(width_)};
    }

    /// @brief The part of width × height whose first pixel is (x, y).
    /// @throws Error where it reaches outside this view.
    [[nodiscard]] ImageView region(int x, int y, int width, int height) const {
        expect(x >= 0 && y >= 0 && width >= 0 && height >= 0 && x <= width_ - width && y <= height_ - height,
               "image region", lazy_text("a part of ", width_, "x", height_),
               lazy_text(width, "x", height, " at (", x, ", ", y, ")"));
        return {data_ + y * stride_ + x, width, height, stride_};
    }

private:
    T* data_ = nullptr;
    int width_ = 0;
    int height_ = 0;
    std::ptrdiff_t stride_ = 0;
};

/// @brief An image that owns its pixels, row after row without gaps.
template <Pixel T>
class Image {
public:
    using value_type = T;

    Image() = default;
    Image(const Image&) = default;
    Image& operator=(const Image&) = default;
    /// @brief Leaves `other` empty.
    Image(Image&& other) noexcept
        : width_(std::exchange(other.width_, 0)),
          height_(std::exchange(other.height_, 0)),
          pixels_(std::move(other.pixels_)) {}
    Image& operator=(Image&& other) noexcept {
        width_ = std::exchange(other.width_, 0), height_ = std::exchange(other.height_, 0);
        pixels_ = std::move(other.pixels_);
        return *this;
    }

    /// @brief An image of width × height pixels, all of them `value`.
    /// @throws Error where a side is negative, or both together are absurd.
    Image(int width, int height, T value = {})
        : width_(width), height_(height), pixels_(checked_size(width, height), value) {}

    /// @brief Takes over `pixels`, row after row.
    /// @throws Error where their number is not width · height.
    Image(int width, int height, std::vector<T> pixels)
        : width_(width), height_(height), pixels_(std::move(pixels)) {
        expect(pixels_.size() == checked_size(width, height), "image pixels", checked_size(width, height),
               pixels_.size());
    }

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] bool empty() const { return pixels_.empty(); }
    [[nodiscard]] bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }

    [[nodiscard]] T& operator()(int x, int y) { return pixels_[offset(x, y)]; }
    [[nodiscard]] const T& operator()(int x, int y) const { return pixels_[offset(x, y)]; }

    [[nodiscard]] std::span<T> row(int y) { return {pixels_.data() + offset(0, y), std::size_t(width_)}; }
    [[nodiscard]] std::span<const T> row(int y) const {
        return {pixels_.data() + offset(0, y), std::size_t(width_)};
    }
    [[nodiscard]] std::span<T> pixels() { return {pixels_.data(), pixels_.size()}; }
    [[nodiscard]] std::span<const T> pixels() const { return {pixels_.data(), pixels_.size()}; }

    [[nodiscard]] ImageView<const T> view() const { return {pixels_.data(), width_, height_, width_}; }
    [[nodiscard]] ImageView<T> view() { return {pixels_.data(), width_, height_, width_}; }
    operator ImageView<const T>() const { return view(); }
    operator ImageView<T>() { return view(); }

    [[nodiscard]] bool operator==(const Image&) const = default;

private:
    [[nodiscard]] std::size_t offset(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    }
    [[nodiscard]] static std::size_t checked_size(int width, int height) {
        expect(width >= 0 && height >= 0, "image size", "sides of 0 or more", lazy_text(width, "x", height));
        const auto size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        expect(size <= std::vector<T>().max_size(), "image size", "one that memory could hold",
               lazy_text(width, "x", height));
        return size;
    }

    int width_ = 0;
    int height_ = 0;
    std::vector<T> pixels_;
};

using GrayImage = Image<float>;         ///< brightness 0 (black) … 1 (white)
using RgbImage = Image<Rgb>;            ///< colour, 8 bits a channel
using RawDepth = Image<std::uint16_t>;  ///< a depth camera's units; 0 = no reading
using DepthMap = Image<float>;          ///< metres along the optical axis; 0 or NaN = no reading
using Mask = Image<std::uint8_t>;       ///< 0 = ground, anything else = figure

/// @brief "640x480", for messages.
template <class I>
requires requires(const I& image) {
    image.width();
    image.height();
}
[[nodiscard]] LazyText<3> size_text(const I& image) {
    return lazy_text(image.width(), "x", image.height());
}

/// @brief Brightness of a colour image (ITU-R BT.601 weights), 0 … 1.
[[nodiscard]] inline GrayImage to_gray(ImageView<const Rgb> color) {
    GrayImage gray(color.width(), color.height());
    for (int y = 0; y < color.height(); ++y)
        for (int x = 0; x < color.width(); ++x) {
            const Rgb c = color(x, y);
            gray(x, y) = (0.299f * c.r + 0.587f * c.g + 0.114f * c.b) / 255.0f;
        }
    return gray;
}

/// @brief An 8-bit grey image as brightness 0 … 1.
[[nodiscard]] inline GrayImage to_gray(ImageView<const std::uint8_t> bytes) {
    GrayImage gray(bytes.width(), bytes.height());
    for (int y = 0; y < bytes.height(); ++y)
        for (int x = 0; x < bytes.width(); ++x) gray(x, y) = bytes(x, y) / 255.0f;
    return gray;
}

/// @brief An image with left and right exchanged.
template <Pixel T>
[[nodiscard]] Image<T> mirrored(Image<T> image) {
    for (int y = 0; y < image.height(); ++y) {
        const auto row = image.row(y);
        std::reverse(row.begin(), row.end());
    }
    return image;
}

namespace detail {

/// The four pixels around a place of an image, and how far it lies from the first of them; outside the image
/// it is the nearest place of its edge.
struct BilinearPlace {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    float ax = 0, ay = 0;

    BilinearPlace(int width, int height, float x, float y) {
        const float cx = std::min(std::max(0.0f, x), static_cast<float>(width - 1));
        const float cy = std::min(std::max(0.0f, y), static_cast<float>(height - 1));
        x0 = static_cast<int>(cx), y0 = static_cast<int>(cy);
        x1 = x0 + 1 < width ? x0 + 1 : x0, y1 = y0 + 1 < height ? y0 + 1 : y0;
        ax = cx - static_cast<float>(x0), ay = cy - static_cast<float>(y0);
    }
};

}  // namespace detail

/// @brief The value between pixels by bilinear interpolation; outside the image the edge pixels are repeated.
/// NaN counts as 0. The image must not be empty.
[[nodiscard]] inline float sample_bilinear(ImageView<const float> image, float x, float y) {
    const detail::BilinearPlace p(image.width(), image.height(), x, y);
    return (1 - p.ay) * ((1 - p.ax) * image(p.x0, p.y0) + p.ax * image(p.x1, p.y0)) +
           p.ay * ((1 - p.ax) * image(p.x0, p.y1) + p.ax * image(p.x1, p.y1));
}

/// @brief The colour between pixels, likewise.
[[nodiscard]] inline Rgb sample_bilinear(ImageView<const Rgb> image, float x, float y) {
    const detail::BilinearPlace p(image.width(), image.height(), x, y);
    const auto mixed = [&](std::uint8_t Rgb::*channel) {
        const float upper = (1 - p.ax) * image(p.x0, p.y0).*channel + p.ax * image(p.x1, p.y0).*channel;
        const float lower = (1 - p.ax) * image(p.x0, p.y1).*channel + p.ax * image(p.x1, p.y1).*channel;
        return static_cast<std::uint8_t>((1 - p.ay) * upper + p.ay * lower + 0.5f);
    };
    return {mixed(&Rgb::r), mixed(&Rgb::g), mixed(&Rgb::b)};
}

}  // namespace ism
