// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/core/guided_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "support/catch.hpp"
#include "support/noise.hpp"

namespace {

/// Calls back for each pixel of a window that lies in the image.
template <class Visit>
void each_in_window(const ism::GrayImage& image, int x, int y, int radius, const Visit& visit) {
    for (int v = y - radius; v <= y + radius; ++v)
        for (int u = x - radius; u <= x + radius; ++u)
            if (image.contains(u, v)) visit(u, v);
}

/// The mean over a window, pixel by pixel.
double plain_mean(const ism::GrayImage& image, int x, int y, int radius) {
    double sum = 0;
    int count = 0;
    each_in_window(image, x, y, radius, [&](int u, int v) { sum += image(u, v), ++count; });
    return sum / count;
}

}  // namespace

TEST_CASE("box_mean is the mean of each window, also where it is larger than the image") {
    for (const auto& [width, height] : {std::pair(13, 9), {1, 7}, {5, 1}, {1, 1}})
        for (const int radius : {0, 1, 2, 4, 20}) {
            CAPTURE(width, height, radius);
            const ism::GrayImage image = ism::test::noise(width, height, 3);
            const ism::GrayImage mean = ism::box_mean(image, radius);
            double worst = 0;
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    worst = std::max(worst, std::abs(mean(x, y) - plain_mean(image, x, y, radius)));
            CHECK(worst < 1e-6);
        }
    const ism::GrayImage image = ism::test::noise(13, 9, 3);
    CHECK(ism::box_mean(image, std::numeric_limits<int>::max()) == ism::box_mean(image, 13));
}

TEST_CASE("guided_fit fits each window by least squares and takes the mean of all that see a pixel") {
    using Triple = std::array<double, 3>;
    constexpr int width = 17, height = 12, radius = 2;
    constexpr double epsilon = 0.01;
    const ism::ColorPlanes guide{ism::test::noise(width, height, 1), ism::test::noise(width, height, 2),
                                 ism::test::noise(width, height, 3)};
    const ism::GrayImage image = ism::test::noise(width, height, 4);
    ism::ColorPlanes slope{ism::GrayImage(width, height), ism::GrayImage(width, height),
                           ism::GrayImage(width, height)};
    ism::GrayImage offset(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double p = plain_mean(image, x, y, radius);
            Triple mean{}, both{}, a{};
            std::array<Triple, 3> squares{};
            for (std::size_t k = 0; k < 3; ++k) mean[k] = plain_mean(guide[k], x, y, radius);
            each_in_window(image, x, y, radius, [&](int u, int v) {
                for (std::size_t k = 0; k < 3; ++k) {
                    const double away = guide[k](u, v) - mean[k];
                    both[k] += away * (image(u, v) - p), squares[k][k] += epsilon;
                    for (std::size_t l = 0; l < 3; ++l) squares[k][l] += away * (guide[l](u, v) - mean[l]);
                }
            });
            for (int step = 0; step < 300; ++step)  // Gauss and Seidel's
                for (std::size_t k = 0; k < 3; ++k) {
                    const double others =
                        std::inner_product(a.begin(), a.end(), squares[k].begin(), -a[k] * squares[k][k]);
                    a[k] = (both[k] - others) / squares[k][k];
                }
            for (std::size_t k = 0; k < 3; ++k) slope[k](x, y) = float(a[k]);
            offset(x, y) = float(p - std::inner_product(a.begin(), a.end(), mean.begin(), 0.0));
        }
    const ism::GuidedFit fit = ism::guided_fit(guide, image, radius, epsilon);
    double worst = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            for (std::size_t k = 0; k < 3; ++k)
                worst = std::max(worst, std::abs(fit.slope[k](x, y) - plain_mean(slope[k], x, y, radius)));
            worst = std::max(worst, std::abs(fit.offset(x, y) - plain_mean(offset, x, y, radius)));
        }
    CHECK(worst < 1e-4);
}

TEST_CASE("a guided filter keeps an edge of the guide and smooths noise beside it") {
    for (const bool equally_bright : {false, true}) {
        ism::ColorPlanes guide{ism::GrayImage(40, 20), ism::GrayImage(40, 20), ism::GrayImage(40, 20)};
        ism::GrayImage image = ism::test::noise(40, 20, 5, -0.2, 0.2);
        for (int y = 0; y < 20; ++y)
            for (int x = 0; x < 40; ++x) {
                const bool right = x >= 20;
                guide[0](x, y) = right ? 0.8f : 0.2f;
                guide[1](x, y) = guide[2](x, y) = !equally_bright ? guide[0](x, y) : right ? 0.372f : 0.628f;
                if (right) image(x, y) += 1;
            }
        const ism::GuidedFit fit = ism::guided_fit(guide, image, 3, 1e-4);
        for (int y = 5; y < 15; ++y)
            for (int x = 5; x < 35; ++x) {
                float filtered = fit.offset(x, y);
                for (std::size_t k = 0; k < 3; ++k) filtered += fit.slope[k](x, y) * guide[k](x, y);
                CHECK(filtered == Approx(x < 20 ? 0 : 1).margin(0.12));
            }
    }
}

TEST_CASE("guided_fit refuses images of different sizes and options out of range") {
    const ism::GrayImage image(8, 8), other(8, 9);
    CHECK_THROWS_WITH(ism::guided_fit({image, image, image}, other, 1, 1e-4),
                      "guided_fit: size of the image: expected 8x8, got 8x9");
    CHECK_THROWS_WITH(ism::guided_fit({image, image, other}, image, 1, 1e-4),
                      "guided_fit: size of the image: expected 8x9, got 8x8");
    CHECK_THROWS_WITH(ism::guided_fit({image, image, image}, image, -1, 1e-4), Catch::Contains("radius"));
    CHECK_THROWS_WITH(ism::guided_fit({image, image, image}, image, 1, 0), Catch::Contains("epsilon"));
}
