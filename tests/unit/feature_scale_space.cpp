// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <numbers>

#include "support/catch.hpp"
#include "support/noise.hpp"

#include "ism/core/random.hpp"
#include "ism/feature/gradient.hpp"
#include "ism/feature/resize.hpp"
#include "ism/feature/scale_space.hpp"

using ism::test::noise;

namespace {

/// A blob of deviation `sigma` that a camera without blur of its own would see.
ism::GrayImage blob(int width, int height, double x, double y, double sigma) {
    ism::GrayImage image(width, height);
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i)
            image(i, j) = float(std::exp(-((i - x) * (i - x) + (j - y) * (j - y)) / (2 * sigma * sigma)));
    return image;
}

/// Mass, centre and variance of a level in pixels of the input image.
struct Moments {
    double mass = 0, x = 0, y = 0, xx = 0, yy = 0;
};
Moments moments(ism::ImageView<const float> image, double step) {
    Moments m;
    for (int j = 0; j < image.height(); ++j)
        for (int i = 0; i < image.width(); ++i) {
            const double value = image(i, j), x = i * step, y = j * step;
            m.mass += value, m.x += value * x, m.y += value * y;
            m.xx += value * x * x, m.yy += value * y * y;
        }
    m.x /= m.mass, m.y /= m.mass;
    m.xx = m.xx / m.mass - m.x * m.x, m.yy = m.yy / m.mass - m.y * m.y;
    m.mass *= step * step;
    return m;
}

}  // namespace

TEST_CASE("a Gaussian kernel has the sum 1 and the variance asked for") {
    for (const double sigma : {0.3, 0.5, 1.0, 1.2262735, 1.6, 3.09, 5.5, 12.0}) {
        const auto half = ism::gaussian_kernel(sigma);
        double sum = half[0], variance = 0;
        for (std::size_t i = 1; i < half.size(); ++i) {
            sum += 2 * double(half[i]);
            variance += 2 * double(half[i]) * double(i * i);
        }
        CHECK(sum == Approx(1).epsilon(1e-6));
        CHECK(variance == Approx(sigma * sigma).epsilon(1e-5));
    }
    CHECK_THROWS_AS(ism::gaussian_kernel(0), ism::Error);
    CHECK_THROWS_AS(ism::gaussian_kernel(NAN), ism::Error);
}

TEST_CASE("blurring equals the plain double sum over the kernel") {
    const int height = 29;
    for (const int width : {5, 37, 150})  // less than a block of columns, little more, more than a strip
        for (const double sigma : {0.7, 2.0, 7.0}) {
            const auto image = noise(width, height, 1);
            const auto half = ism::gaussian_kernel(sigma);
            const int radius = int(half.size()) - 1;
            ism::GrayImage fast(width, height);
            ism::Workspace workspace;
            ism::blur(image.view(), half, fast.view(), workspace);
            double worst = 0;
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x) {
                    double sum = 0;
                    for (int j = -radius; j <= radius; ++j)
                        for (int i = -radius; i <= radius; ++i)
                            sum += double(half[std::size_t(std::abs(i))]) *
                                   double(half[std::size_t(std::abs(j))]) *
                                   double(image(std::clamp(x + i, 0, width - 1),
                                                std::clamp(y + j, 0, height - 1)));
                    worst = std::max(worst, std::fabs(sum - double(fast(x, y))));
                }
            CAPTURE(width, sigma);
            CHECK(worst < 2e-6);
        }
}

TEST_CASE("every level keeps a blob's mass and place and has the stated deviation") {
    for (const bool doubled : {true, false})
        for (const int levels_an_octave : {1, 3, 5}) {
            const double x = 61.3, y = 64.8, sigma = 2.5;
            ism::ScaleSpace space;
            space.build(blob(131, 126, x, y, sigma).view(),
                        {.levels_per_octave = levels_an_octave, .double_first_octave = doubled});
            for (int o = 0; o < std::min(3, space.octaves()); ++o)
                for (int i = 0; i < space.levels(); ++i) {
                    CAPTURE(doubled, levels_an_octave, o, i);
                    const double stated = double(space.sigma(o, float(i)));
                    const double variance = sigma * sigma - 0.25 + stated * stated;
                    if (std::sqrt(variance) > 11) continue;  // would reach the image's edge
                    const Moments m = moments(space.level(o, i), double(space.step(o)));
                    CHECK(m.x == Approx(x).margin(2e-3));
                    CHECK(m.y == Approx(y).margin(2e-3));
                    CHECK(m.xx == Approx(variance).epsilon(2e-3));
                    CHECK(m.yy == Approx(variance).epsilon(2e-3));
                    CHECK(m.mass == Approx(2 * std::numbers::pi_v<double> * sigma * sigma).epsilon(1e-3));
                }
        }
}

TEST_CASE("scales follow base_sigma * step * 2^(i/S)") {
    ism::ScaleSpace space;
    space.build(noise(64, 48, 2).view());
    CHECK(space.step(0) == 0.5f);
    CHECK(space.step(1) == 1.0f);
    CHECK(space.sigma(0, 0) == Approx(0.8));
    CHECK(space.sigma(1, 3) == Approx(3.2));
    CHECK(space.sigma(2, 1) == Approx(3.2 * std::cbrt(2.0)));
    CHECK(space.level(0, 0).width() == 127);
    CHECK(space.level(1, 0).width() == 64);
    for (int o = 0; o < space.octaves(); ++o)
        for (int i = 1; i <= 3; ++i)
            CHECK(space.nearest_level(space.sigma(o, float(i)) * 1.05f) == ism::LevelIndex{o, i});
    CHECK(space.nearest_level(0.01f) == ism::LevelIndex{0, 0});
    const auto [octave, level] = space.nearest_level(1e6f);
    CHECK(octave == space.octaves() - 1);
    CHECK(level == space.levels() - 1);
}

TEST_CASE("halved levels are every second pixel, and show a feature at about one deviation a pixel") {
    ism::ScaleSpace space;
    CHECK_THROWS_AS(space.sampling(1), ism::Error);
    space.build(noise(65, 50, 7).view());
    for (int o = 0; o < space.octaves(); ++o)
        for (int i = 1; i <= 3; ++i) {
            const auto level = space.level(o, i), half = space.halved(o, i);
            REQUIRE(half.width() == (level.width() + 1) / 2);
            REQUIRE(half.height() == (level.height() + 1) / 2);
            bool same = true;
            for (int y = 0; y < half.height(); ++y)
                for (int x = 0; x < half.width(); ++x) same = same && half(x, y) == level(2 * x, 2 * y);
            CHECK(same);
        }
    for (float scale = 0.95f; scale < 6; scale *= 1.1f) {
        const float deviation_px = scale / space.sampling(scale).step;
        CHECK(deviation_px >= 0.85f);
        CHECK(deviation_px <= 1.9f);
    }
    CHECK(space.sampling(0.8f).step == 0.5f);
    CHECK(space.sampling(0.8f).image.width() == space.level(0, 0).width());
}

TEST_CASE("images of any size from 16x16 on have a scale space, with the same bits for any threads") {
    ism::ScaleSpace reused;
    for (const auto& [width, height] :
         {std::pair{16, 16}, {17, 16}, {16, 19}, {203, 17}, {100, 40}, {151, 77}})
        for (const bool doubled : {true, false}) {
            const auto image = noise(width, height, 3);
            const ism::ScaleSpaceOptions options{.double_first_octave = doubled};
            ism::ScaleSpace fresh;
            fresh.build(image.view(), options, 1);
            reused.build(image.view(), options, 2);
            REQUIRE(fresh.octaves() == reused.octaves());
            REQUIRE(fresh.octaves() >= 1);
            bool same = true;
            for (int o = 0; o < fresh.octaves(); ++o)
                for (int i = 0; i < fresh.levels(); ++i)
                    for (int y = 0; y < fresh.level(o, i).height(); ++y)
                        for (int x = 0; x < fresh.level(o, i).width(); ++x)
                            same = same && fresh.level(o, i)(x, y) == reused.level(o, i)(x, y);
            CHECK(same);
        }
}

TEST_CASE("a scale space refuses small images and options out of range") {
    ism::ScaleSpace space;
    CHECK_THROWS_WITH(space.build(ism::GrayImage(15, 64).view()),
                      "image size: expected at least 16x16, got 15x64");
    const auto image = noise(32, 32, 4);
    CHECK_THROWS_AS(space.build(image.view(), {.levels_per_octave = 0}), ism::Error);
    CHECK_THROWS_AS(space.build(image.view(), {.base_sigma = NAN}), ism::Error);
    CHECK_THROWS_AS(space.build(image.view(), {.input_sigma = -1}), ism::Error);
    CHECK_THROWS_AS(space.build(image.view(), {.max_octaves = 0}), ism::Error);
}

TEST_CASE("gradients without library calls agree with hypot and atan2") {
    double worst_length = 0, worst_angle = 0;
    for (int step = 0; step < 3600; ++step) {
        const double angle = (step - 1800 + 0.5) * std::numbers::pi / 1800;
        float magnitude = 0, direction = 0;
        ism::detail::to_polar(float(0.01 * std::cos(angle)), float(0.01 * std::sin(angle)), magnitude,
                              direction);
        worst_length = std::max(worst_length, std::fabs(double(magnitude) / 0.01 - 1));
        worst_angle = std::max(worst_angle, std::fabs(double(direction) - angle));
    }
    CHECK(worst_length < 3e-6);
    CHECK(worst_angle < 1e-5);
    float magnitude = 1, direction = 1;
    ism::detail::to_polar(0, 0, magnitude, direction);
    CHECK(magnitude == 0);
    CHECK(direction == 0);
}

TEST_CASE("resizing keeps the place of a blob at x * factor and takes it to its blur") {
    const double x = 40.4, y = 37.7, sigma = 4;
    const auto image = blob(90, 81, x, y, sigma);
    ism::Workspace workspace;
    for (const double factor : {0.37, 0.5, 1.5, 2.0, 3.3}) {
        CAPTURE(factor);
        const auto other = ism::resized(image.view(), factor, 0.5f, workspace);
        CHECK(other.width() == int(std::floor(89 * factor)) + 1);
        const Moments m = moments(other.view(), 1 / factor);
        CHECK(m.x == Approx(x).margin(0.01));
        CHECK(m.y == Approx(y).margin(0.01));
        const double blur = factor < 1 ? 0.25 * (1 / (factor * factor) - 1) : 0.0;
        CHECK(m.xx == Approx(sigma * sigma + blur).epsilon(0.03));
    }
    CHECK_THROWS_AS(ism::resized(image.view(), 0, 0.5f, workspace), ism::Error);
    CHECK_THROWS_AS(ism::resized(image.view(), 1e9, 0.5f, workspace), ism::Error);
}
