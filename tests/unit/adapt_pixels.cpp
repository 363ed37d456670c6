// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "support/catch.hpp"

#include "ism/adapt/pixels.hpp"

namespace {

namespace format = ism::pixel_format;
using Bytes = std::vector<std::uint8_t>;

ism::RawPixels of(const Bytes& bytes, int width, int height, std::ptrdiff_t stride, ism::PixelFormat pixel) {
    return {bytes.data(), width, height, stride, pixel};
}

template <class T>
concept HasRawPixels = requires(ism::ImageView<T> image) {
    ism::raw_pixels(image);
};
static_assert(HasRawPixels<const float> && HasRawPixels<std::uint8_t> && HasRawPixels<const ism::Rgb>);
static_assert(!HasRawPixels<const double>);

}  // namespace

TEST_CASE("pixels of any channel order give the colours they show") {
    const ism::Rgb red_green_blue{10, 20, 30};
    const auto alone = [](const Bytes& bytes, ism::PixelFormat pixel) {
        return ism::to_rgb(of(bytes, 1, 1, std::ptrdiff_t(bytes.size()), pixel))(0, 0);
    };
    CHECK(alone({10, 20, 30}, format::rgb8) == red_green_blue);
    CHECK(alone({30, 20, 10}, format::bgr8) == red_green_blue);
    CHECK(alone({10, 20, 30, 99}, format::rgba8) == red_green_blue);
    CHECK(alone({30, 20, 10, 99}, format::bgra8) == red_green_blue);
    CHECK(alone({99, 10, 20, 30}, {.channels = 4, .red = 1, .green = 2, .blue = 3}) == red_green_blue);
    CHECK(alone({7}, format::gray8) == ism::Rgb{7, 7, 7});
}

TEST_CASE("rows any number of bytes apart, and from the last to the first") {
    const Bytes bytes{1, 2, 99, 99, 99, 3, 4};  // two rows of two, five bytes apart
    const ism::RgbImage down = ism::to_rgb(of(bytes, 2, 2, 5, format::gray8));
    CHECK((down(0, 0).r == 1 && down(1, 0).r == 2 && down(0, 1).r == 3 && down(1, 1).r == 4));
    const ism::RgbImage up = ism::to_rgb({bytes.data() + 5, 2, 2, -5, format::gray8});
    CHECK((up(0, 0).r == 3 && up(1, 0).r == 4 && up(0, 1).r == 1 && up(1, 1).r == 2));
}

TEST_CASE("brightness of raw pixels is that of images, bit by bit") {
    ism::RgbImage color(16, 16);
    ism::Image<std::uint8_t> gray(16, 16);
    for (int i = 0; i < 256; ++i) {
        color(i % 16, i / 16) = {std::uint8_t(i), std::uint8_t(i * 7), std::uint8_t(255 - i)};
        gray(i % 16, i / 16) = std::uint8_t(i);
    }
    CHECK(ism::to_gray(ism::raw_pixels(color.view())) == ism::to_gray(color.view()));
    CHECK(ism::to_gray(ism::raw_pixels(gray.view())) == ism::to_gray(gray.view()));
    const ism::Frame frame = ism::to_frame(ism::raw_pixels(color.view()));
    CHECK((frame.color == color && frame.gray == ism::to_gray(color.view()) && !frame.camera));
    CHECK(ism::to_frame(ism::raw_pixels(gray.view())).color.empty());
}

TEST_CASE("16 bits and floats, at addresses that are not aligned, of either byte order") {
    Bytes bytes(1 + 8);
    const std::array<std::uint16_t, 4> units{0, 1000, 65535, 256};
    std::memcpy(bytes.data() + 1, units.data(), 8);
    const ism::RawPixels raw{bytes.data() + 1, 4, 1, 8, format::gray16};
    CHECK(ism::to_gray(raw)(2, 0) == 1.0f);
    CHECK(ism::to_rgb(raw)(1, 0).r == 1000 / 256);
    const ism::DepthMap depth_m = ism::to_depth(raw, 0.001);
    CHECK((depth_m(0, 0) == 0 && depth_m(1, 0) == 1.0f && depth_m(2, 0) == 65.535f));
    ism::RawPixels swapped = raw;
    swapped.format.swapped = true;
    CHECK(ism::to_depth(swapped, 1)(3, 0) == 1.0f);  // 0x0100 as 0x0001

    const std::array<float, 4> metres{0.5f, std::numeric_limits<float>::quiet_NaN(), 2, -1};
    const ism::RawPixels floats{metres.data(), 4, 1, 16, format::gray_float};
    const ism::DepthMap as_metres = ism::to_depth(floats, 1);
    CHECK((as_metres(0, 0) == 0.5f && std::isnan(as_metres(1, 0)) && as_metres(2, 0) == 2));
    const ism::RgbImage colors = ism::to_rgb(floats);
    CHECK((colors(0, 0).r == 128 && colors(1, 0).r == 0 && colors(2, 0).r == 255 && colors(3, 0).r == 0));
}

TEST_CASE("a view of raw pixels is the same memory, or is refused") {
    const std::array<float, 8> values{1, 2, 3, 4, 5, 6, 7, 8};
    const auto view = ism::view_of<float>({values.data(), 3, 2, 16, format::gray_float});
    CHECK((&view(0, 0) == values.data() && &view(2, 1) == values.data() + 6));
    const Bytes rgb(12);
    CHECK(ism::view_of<ism::Rgb>(of(rgb, 2, 2, 6, format::rgb8)).stride() == 2);
    CHECK_THROWS_WITH(ism::view_of<ism::Rgb>(of(rgb, 1, 2, 4, format::rgb8)),
                      "pixels to be seen without a copy: stride in bytes: expected a multiple of 3, got 4");
    CHECK_THROWS_AS(ism::view_of<ism::Rgb>(of(rgb, 2, 2, 6, format::bgr8)), ism::Error);
    CHECK_THROWS_AS(ism::view_of<std::uint16_t>({rgb.data() + 1, 1, 1, 2, format::gray16}), ism::Error);
}

TEST_CASE("what cannot be pixels is refused with what was expected and found") {
    const Bytes bytes(64);
    CHECK_THROWS_WITH(ism::to_gray({nullptr, 2, 2, 2, format::gray8}),
                      "pixels: expected an address, got none");
    CHECK_THROWS_WITH(ism::to_gray(of(bytes, 8, 2, 20, format::rgb8)),
                      "pixels: stride in bytes: expected 24 or more for rows of 8 pixels of 3 bytes, got 20");
    CHECK_THROWS_WITH(ism::to_gray(of(bytes, 0, 2, 20, format::rgb8)), Catch::Contains("got 0x2"));
    CHECK_THROWS_WITH(ism::to_rgb(of(bytes, 2, 2, 6, {.channels = 3, .red = 3})),
                      "pixels: channel of a colour: expected 0 ... 2, got 3");
    CHECK_THROWS_WITH(ism::to_depth(of(bytes, 2, 2, 2, format::gray8), 0.001),
                      "depth image: expected one channel of 16 bits or floats, got 1 channel of 8 bits");
    CHECK_THROWS_WITH(ism::to_depth(of(bytes, 2, 2, 4, format::gray16), 0),
                      "depth scale (metres per unit): expected a positive number, got 0");
    CHECK_THROWS_WITH(ism::to_frame(of(bytes, 2, 2, 2, format::gray8), of(bytes, 2, 1, 4, format::gray16), 1),
                      "depth image size: expected 2x2, got 2x1");
    std::array<float, 4> floats{0, 0.5f, 37, 1};
    const ism::RawPixels gray{floats.data(), 2, 2, 8, format::gray_float};
    CHECK_THROWS_WITH(ism::to_frame(gray),
                      "picture of floats: expected 0 to 1 (accepted: -1 to 2), got 0 to 37");
    floats[2] = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_WITH(ism::to_frame(gray),
                      "picture of floats: expected numbers, got one that is none or infinite");
    floats[2] = 1.5f;
    CHECK(ism::to_frame(gray).gray(0, 1) == 1.5f);
}
