// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/core/guided_filter.hpp"

#include <algorithm>
#include <cmath>

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
}

TEST_CASE("guided_fit fits each window by least squares and takes the mean of all that see a pixel") {
    constexpr int width = 17, height = 12, radius = 2;
    constexpr double epsilon = 0.01;
    const ism::GrayImage guide = ism::test::noise(width, height, 1),
                         image = ism::test::noise(width, height, 2);
    ism::GrayImage slope(width, height), offset(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double g = plain_mean(guide, x, y, radius), p = plain_mean(image, x, y, radius);
            double both = 0, sq = 0;
            int count = 0;
            each_in_window(guide, x, y, radius, [&](int u, int v) {
                both += (guide(u, v) - g) * (image(u, v) - p);
                sq += (guide(u, v) - g) * (guide(u, v) - g);
                ++count;
            });
            slope(x, y) = float(both / (sq + epsilon * count));
            offset(x, y) = float(p - slope(x, y) * g);
        }
    const ism::GuidedFit fit = ism::guided_fit(guide, image, radius, epsilon);
    double worst = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            worst = std::max(worst, std::abs(fit.slope(x, y) - plain_mean(slope, x, y, radius)));
            worst = std::max(worst, std::abs(fit.offset(x, y) - plain_mean(offset, x, y, radius)));
        }
    CHECK(worst < 1e-4);
}

TEST_CASE("a guided filter keeps an edge of the guide and smooths noise beside it") {
    ism::GrayImage guide(40, 20), image = ism::test::noise(40, 20, 5, -0.2, 0.2);
    for (int y = 0; y < 20; ++y)
        for (int x = 20; x < 40; ++x) guide(x, y) = 1, image(x, y) += 1;
    const ism::GuidedFit fit = ism::guided_fit(guide, image, 3, 1e-4);
    for (int y = 5; y < 15; ++y)
        for (int x = 5; x < 35; ++x) {
            const float filtered = fit.slope(x, y) * guide(x, y) + fit.offset(x, y);
            CHECK(filtered == Approx(x < 20 ? 0 : 1).margin(0.12));
        }
}

TEST_CASE("guided_fit refuses images of two sizes and options out of range") {
    const ism::GrayImage image(8, 8), other(8, 9);
    CHECK_THROWS_WITH(ism::guided_fit(image, other, 1, 1e-4),
                      "guided_fit: size of the image: expected 8x8, got 8x9");
    CHECK_THROWS_WITH(ism::guided_fit(image, image, -1, 1e-4), Catch::Contains("radius"));
    CHECK_THROWS_WITH(ism::guided_fit(image, image, 1, 0), Catch::Contains("epsilon"));
}
