// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/core/color_bins.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"

namespace {

/// Lab as CIE defines it, in the scale of ism::Lab.
std::array<double, 3> plain_lab(double r, double g, double b) {
    const auto linear = [](double v) {
        v /= 255;
        return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    const auto root = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; };
    r = linear(r), g = linear(g), b = linear(b);
    const double x = root((0.412453 * r + 0.357580 * g + 0.180423 * b) / 0.950456);
    const double y = root(0.212671 * r + 0.715160 * g + 0.072169 * b);
    const double z = root((0.019334 * r + 0.119193 * g + 0.950227 * b) / 1.088754);
    return {2.55 * (116 * y - 16), 500 * (x - y) + 128, 200 * (y - z) + 128};
}

using Bin = std::array<int, 3>;

/// The bin of a colour, without a table.
Bin plain_bin(const ism::Lab& lab) {
    return {int(std::clamp(lab[0], 0.0f, 255.0f) / 4), int(std::clamp(lab[1], 64.0f, 191.0f) / 4),
            int(std::clamp(lab[2], 64.0f, 191.0f) / 4)};
}

/// What of a histogram is near a bin, by the product of 1 3 4 3 1 along the three axes.
double near(const std::map<Bin, double>& histogram, const Bin& at) {
    constexpr double kernel[] = {4 / 12.0, 3 / 12.0, 1 / 12.0};
    double sum = 0;
    for (const auto& [bin, weight] : histogram) {
        double part = weight;
        for (std::size_t k = 0; k < 3; ++k) {
            const int away = std::abs(bin[k] - at[k]);
            part *= away <= 2 ? kernel[away] : 0;
        }
        sum += part;
    }
    return sum;
}

}  // namespace

TEST_CASE("LabTable gives the colours that CIE defines") {
    const ism::LabTable to_lab;
    double worst = 0;
    for (int r = 0; r <= 255; r += 15)
        for (int g = 0; g <= 255; g += 15)
            for (int b = 0; b <= 255; b += 15) {
                const auto expected = plain_lab(r, g, b);
                const ism::Lab lab = to_lab(float(r), float(g), float(b));
                for (std::size_t k = 0; k < 3; ++k) worst = std::max(worst, std::abs(lab[k] - expected[k]));
            }
    CHECK(worst < 0.5);
    CHECK(to_lab(255, 255, 255)[0] == Approx(255).margin(0.1));
    CHECK(to_lab(255, 0, 0)[1] > to_lab(0, 255, 0)[1]);
}

TEST_CASE("log_ratio is that of smoothed histograms, made bin by bin") {
    ism::Random random(4);
    std::vector<float> rgb, figure;
    for (int i = 0; i < 300; ++i) {  // also black, white and the strongest colours, at the ends of the range
        for (int k = 0; k < 3; ++k)
            rgb.push_back(i < 8 ? (i >> k & 1) * 255.0f
                                : float(random.uniform(i < 150 ? 90 : 0, i < 150 ? 140 : 255)));
        figure.push_back(float(random.uniform()));
    }
    const ism::LabTable to_lab;
    std::map<Bin, double> in, out;
    std::vector<Bin> bins;
    double all_in = 0, all_out = 0;
    for (std::size_t i = 0; i < figure.size(); ++i) {
        bins.push_back(plain_bin(to_lab(rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2])));
        in[bins[i]] += figure[i], out[bins[i]] += 1 - figure[i];
        all_in += figure[i], all_out += 1 - figure[i];
    }
    const std::vector<float> ratio = ism::ColorBins(rgb).log_ratio(figure, 2);
    REQUIRE(ratio.size() == figure.size());
    double worst = 0;
    for (std::size_t i = 0; i < figure.size(); ++i) {
        const double expected =
            std::log((near(in, bins[i]) / all_in + 1e-6) / (near(out, bins[i]) / all_out + 1e-6));
        worst = std::max(worst, std::abs(ratio[i] - std::clamp(expected, -2.0, 2.0)));
    }
    CHECK(worst < 1e-3);
    CHECK(*std::min_element(ratio.begin(), ratio.end()) < 0);
    CHECK(*std::max_element(ratio.begin(), ratio.end()) > 0);
}

TEST_CASE("a colour of the figure alone is told as figure, up to the limit") {
    std::vector<float> rgb, figure;
    for (int i = 0; i < 100; ++i) {
        const bool red = i < 40;
        rgb.insert(rgb.end(), {red ? 200.0f : 30.0f, 40.0f, red ? 30.0f : 180.0f});
        figure.push_back(red ? 1.0f : 0.0f);
    }
    const auto ratio = ism::ColorBins(rgb).log_ratio(figure, 3);
    CHECK(ratio.front() == 3);
    CHECK(ratio.back() == -3);
    for (const float all : {0.0f, 1.0f})  // an empty side says nothing that is not finite
        for (const float r : ism::ColorBins(rgb).log_ratio(std::vector<float>(100, all), 3))
            CHECK(std::isfinite(r));
    CHECK(ism::ColorBins({}).log_ratio({}, 3).empty());
    CHECK_THROWS_WITH(ism::ColorBins(rgb).log_ratio(std::vector<float>(99), 3),
                      "ColorBins::log_ratio: pixels: expected 100, got 99");
}
