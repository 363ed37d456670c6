// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/train/turned_object.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/image.hpp"
#include "ism/core/random.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/hog/box_template.hpp"
#include "ism/hog/hog_pyramid.hpp"
#include "ism/train/template_examples.hpp"

namespace {

/// Whose red grows to the right, green downwards.
ism::RgbImage slopes(int width, int height, int step) {
    ism::RgbImage image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image(x, y) = {std::uint8_t(x / step), std::uint8_t(y / step), 7};
    return image;
}

}  // namespace

TEST_CASE("an object that is not turned looks as in its image, and outside the edge is repeated") {
    const ism::RgbImage image = slopes(60, 40, 1);
    const auto [picture, box] = ism::detail::turned_object(image, {30, 6, 32, 8}, 0, 0.5);  // side 16
    REQUIRE(picture.width() == 48);
    REQUIRE(picture.height() == 24);
    CHECK(box == ism::Box{8, 8, 32, 8});
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            REQUIRE(picture(x, y) == image(std::min(22 + x, 59), std::max(0, y - 2)));
}

TEST_CASE("an object is turned clockwise about the middle of its box") {
    const ism::RgbImage image = slopes(60, 40, 1);
    const auto [picture, box] = ism::detail::turned_object(image, {20, 10, 16, 16}, std::numbers::pi / 2, 0);
    REQUIRE(picture.width() == 16);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) REQUIRE(picture(x, y) == image(20 + y, 10 + 15 - x));

    const double angle_rad = 5 * std::numbers::pi / 180;
    const auto turned = ism::detail::turned_object(image, {20, 10, 16, 16}, angle_rad, 0);
    const auto at = [&](int x, int y) {  // from the middle
        return turned.picture(8 + x, 8 + y);
    };
    CHECK(at(0, 0) == image(28, 18));
    CHECK(int(at(7, 0).g) < int(image(35, 18).g));  // what was above has come here
    CHECK(int(at(-7, 0).g) > int(image(21, 18).g));
}

TEST_CASE("of a large object the picture is smaller and shows as much") {
    const ism::RgbImage image = slopes(1000, 900, 4);
    const auto [picture, box] = ism::detail::turned_object(image, {100, 50, 800, 800}, 0, 0.05);
    REQUIRE(picture.width() == 440);
    REQUIRE(picture.height() == 440);
    CHECK(box.width == 400);
    CHECK(box.x == Approx(20));
    for (const int i : {0, 100, 439}) {  // two pixels of the image a pixel, from (60, 10) on
        CHECK(std::abs(picture(i, i).r - (60 + 2 * i) / 4) <= 1);
        CHECK(std::abs(picture(i, i).g - (10 + 2 * i) / 4) <= 1);
    }
}

TEST_CASE("a box beside its image shows the nearest edge") {
    const ism::RgbImage image = slopes(30, 20, 1);
    for (const double x : {-500.0, 500.0}) {
        const auto [picture, box] = ism::detail::turned_object(image, {x, 5, 1e-3, 4e3}, 0.1, 0.2);
        REQUIRE(!picture.empty());
        CHECK(picture(0, 0).r == (x < 0 ? 0 : 29));
    }
}

TEST_CASE("an image shows each object of a class turned, on both sides") {
    const ism::RgbImage image = slopes(120, 90, 1);
    const ism::TemplateImage shown{
        .color = image, .labels = {{0, {20, 10, 40, 30}}, {1, {70, 40, 40, 30}}}, .proposals = {}};
    const ism::BoxGrid grid{.columns = 4, .rows = 3};
    ism::detail::TemplateExamples examples;
    ism::Random random(1);
    ism::HogPyramid pyramid;
    ism::ThreadPool pool(1);
    ism::detail::add_turned_examples(shown, 1, grid, 3, random, pyramid, pool, examples);
    const std::size_t row = grid.cells() * ism::cell_numbers;
    REQUIRE(examples.plain.size() == 3 * row);
    CHECK(examples.mirrored.size() == 3 * row);
    CHECK(examples.negative.empty());
    const std::vector<float> first(examples.plain.begin(), examples.plain.begin() + std::ptrdiff_t(row)),
        second(examples.plain.begin() + std::ptrdiff_t(row),
               examples.plain.begin() + std::ptrdiff_t(2 * row));
    CHECK(first != second);
    ism::detail::add_turned_examples(shown, 1, grid, 0, random, pyramid, pool, examples);
    CHECK(examples.plain.size() == 3 * row);
}
