// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/image.hpp"

namespace {

/// Pixel (x, y) is 10·y + x.
ism::GrayImage numbered(int width, int height) {
    ism::GrayImage image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image(x, y) = float(10 * y + x);
    return image;
}

}  // namespace

TEST_CASE("an image holds its pixels row after row") {
    const auto image = numbered(4, 3);
    CHECK(image.width() == 4);
    CHECK(image.height() == 3);
    CHECK(image.pixels()[1 * 4 + 2] == 12);
    CHECK(image(2, 1) == 12);
    CHECK(image.row(2).size() == 4);
    CHECK(image.row(2)[3] == 23);
    CHECK(image.contains(3, 2));
    CHECK_FALSE(image.contains(4, 2));
    CHECK_FALSE(image.contains(0, -1));
    CHECK(ism::GrayImage(2, 1, {5, 6})(1, 0) == 6);
    CHECK_THROWS_WITH(ism::GrayImage(2, 2, {5, 6, 7}), "image pixels: expected 4, got 3");
    CHECK_THROWS_WITH(ism::GrayImage(-1, 2), "image size: expected sides of 0 or more, got -1x2");
    CHECK(ism::GrayImage(0, 7).empty());
    CHECK(ism::GrayImage().empty());
}

TEST_CASE("an image that was moved away is empty, and absurd ones are refused") {
    ism::GrayImage image(3, 2, 0.5f), other(1, 1);
    const ism::GrayImage moved = std::move(image);
    CHECK(moved.width() == 3);
    CHECK(moved.pixels().size() == 6);
    CHECK(image.width() == 0);  // NOLINT(bugprone-use-after-move)
    CHECK(image.height() == 0);
    CHECK(image.view().empty());
    image = ism::GrayImage(4, 5);
    other = std::move(image);
    CHECK(other.height() == 5);
    CHECK(image.height() == 0);  // NOLINT(bugprone-use-after-move)
    const int most = std::numeric_limits<int>::max();
    CHECK_THROWS_WITH(ism::GrayImage(most, most), Catch::Contains("one that memory could hold"));
}

TEST_CASE("a view of a part of an image looks at the same pixels") {
    auto image = numbered(6, 5);
    const ism::ImageView<float> part = image.view().region(2, 1, 3, 4);
    CHECK(part.width() == 3);
    CHECK(part.height() == 4);
    CHECK(part.stride() == 6);
    CHECK(part(0, 0) == 12);
    CHECK(part(2, 3) == 44);
    part(1, 1) = -1;
    CHECK(image(3, 2) == -1);
    const ism::ImageView<const float> fixed = part;
    CHECK(fixed.row(1)[1] == -1);
    CHECK(fixed.row(1).size() == 3);
    CHECK(part.region(1, 2, 2, 2)(1, 1) == 44);  // a part of a part
    CHECK(image.view().region(0, 0, 6, 5).width() == 6);
    CHECK(image.view().region(6, 5, 0, 0).empty());
}

TEST_CASE("a view refuses a part that reaches outside, however large the numbers") {
    const auto image = numbered(6, 5);
    constexpr int largest = std::numeric_limits<int>::max();
    for (const std::array<int, 4>& r : {std::array{-1, 0, 2, 2},
                                        {0, -1, 2, 2},
                                        {5, 0, 2, 2},
                                        {0, 4, 2, 2},
                                        {0, 0, -1, 2},
                                        {0, 0, 2, -1},
                                        {0, 0, 7, 1},
                                        {largest, 0, 1, 1},
                                        {1, 1, largest, 1},
                                        {1, 1, 1, largest}})
        CHECK_THROWS_AS(image.view().region(r[0], r[1], r[2], r[3]), ism::Error);
    CHECK_THROWS_WITH(image.view().region(5, 0, 2, 2),
                      "image region: expected a part of 6x5, got 2x2 at (5, 0)");
}

TEST_CASE("the value between pixels is bilinear, and goes on beyond the edge") {
    const auto image = numbered(4, 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 4; ++x) CHECK(ism::sample_bilinear(image, float(x), float(y)) == image(x, y));
    CHECK(ism::sample_bilinear(image, 1.25f, 0.5f) == Approx(1.25 + 5));
    CHECK(ism::sample_bilinear(image, 2.5f, 1.75f) == Approx(2.5 + 17.5));
    // the edge goes on
    CHECK(ism::sample_bilinear(image, -7, 1.5f) == Approx(15));
    CHECK(ism::sample_bilinear(image, 3.001f, 1.5f) == Approx(18));
    CHECK(ism::sample_bilinear(image, 99, 99) == 23);
    CHECK(ism::sample_bilinear(image, 1.5f, -0.5f) == Approx(1.5));
    CHECK(ism::sample_bilinear(image, -1e30f, 1e30f) == 20);
    CHECK(ism::sample_bilinear(image, NAN, NAN) == 0);
    const ism::GrayImage one(1, 1, 0.7f);
    for (const float at : {-2.0f, 0.0f, 0.4f, 9.0f}) CHECK(ism::sample_bilinear(one, at, -at) == 0.7f);
}

TEST_CASE("brightness of bytes and colours is 0 to 1") {
    const ism::Image<std::uint8_t> bytes(3, 1, {0, 51, 255});
    const auto gray = ism::to_gray(bytes);
    CHECK(gray(0, 0) == 0);
    CHECK(gray(1, 0) == Approx(0.2));
    CHECK(gray(2, 0) == 1);
    const ism::RgbImage color(4, 1, {{255, 255, 255}, {255, 0, 0}, {0, 255, 0}, {0, 0, 255}});
    const auto mixed = ism::to_gray(color);
    CHECK(mixed(0, 0) == Approx(1));
    CHECK(mixed(1, 0) == Approx(0.299));
    CHECK(mixed(2, 0) == Approx(0.587));
    CHECK(mixed(3, 0) == Approx(0.114));
}

TEST_CASE("mirroring exchanges left and right, twice nothing") {
    const auto image = numbered(5, 3);
    const auto other = ism::mirrored(image);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 5; ++x) CHECK(other(x, y) == image(4 - x, y));
    CHECK(ism::mirrored(other) == image);
    CHECK(ism::mirrored(ism::GrayImage()).empty());
}
