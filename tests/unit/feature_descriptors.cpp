// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "support/catch.hpp"
#include "support/noise.hpp"

#include "ism/core/random.hpp"
#include "ism/feature/dense_grid.hpp"
#include "ism/feature/gray_patch.hpp"
#include "ism/feature/orientation.hpp"
#include "ism/feature/sift.hpp"

using ism::test::noise;

namespace {

/// A smooth random pattern, known at every place of the plane, so that it can be turned and scaled exactly.
class Pattern {
public:
    explicit Pattern(std::uint64_t seed) {
        ism::Random random(seed);
        for (Wave& w : waves_) {
            const double length = random.uniform(9, 40), angle = random.uniform(0, 2 * std::numbers::pi);
            w = {2 * std::numbers::pi / length * std::cos(angle),
                 2 * std::numbers::pi / length * std::sin(angle), random.uniform(0, 6.28),
                 0.06 * random.uniform()};
        }
    }
    [[nodiscard]] double operator()(double x, double y) const {
        double value = 0.5;
        for (const Wave& w : waves_) value += w.height * std::cos(w.x * x + w.y * y + w.phase);
        return value;
    }
    /// The pattern turned by `angle` and magnified by `scale` around the middle of an image of odd side.
    [[nodiscard]] ism::GrayImage image(int side, double angle, double scale, double gain = 1,
                                       double offset = 0) const {
        ism::GrayImage out(side, side);
        const double c = side / 2, cosine = std::cos(angle) / scale, sine = std::sin(angle) / scale;
        for (int j = 0; j < side; ++j)
            for (int i = 0; i < side; ++i) {
                const double u = i - c, v = j - c;
                out(i, j) = float(offset + gain * (*this)(cosine * u + sine * v, cosine * v - sine * u));
            }
        return out;
    }

private:
    struct Wave {
        double x = 0, y = 0, phase = 0, height = 0;
    };
    std::array<Wave, 24> waves_;
};

template <ism::Descriptor D>
std::vector<double> describe(const ism::GrayImage& image, const ism::Feature& feature) {
    ism::ScaleSpace space;
    space.build(image.view());
    std::array<typename D::Scalar, D::dimension> row;
    D{}.describe(space, feature, row);
    return {row.begin(), row.end()};
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum);
}

double length(const std::vector<double>& a) {
    return distance(a, std::vector<double>(a.size()));
}

/// SIFT by the book: every pixel with four neighbours gives to every cell and direction, with hat functions
/// of distance.
std::vector<double> slow_sift(const ism::ScaleSpace& space, const ism::Feature& f) {
    const auto [image, pixel] = space.sampling(f.scale);
    const double step = double(pixel), cell = 3 * double(f.scale) / step;
    const double fx = double(f.x) / step, fy = double(f.y) / step;
    std::vector<double> out(128);
    const auto hat = [](double t) { return std::max(0.0, 1 - std::fabs(t)); };
    for (int y = 1; y < image.height() - 1; ++y)
        for (int x = 1; x < image.width() - 1; ++x) {
            const double gx = (double(image(x + 1, y)) - double(image(x - 1, y))) / 2;
            const double gy = (double(image(x, y + 1)) - double(image(x, y - 1))) / 2;
            const double dx = x - fx, dy = y - fy, c = std::cos(double(f.angle)),
                         s = std::sin(double(f.angle));
            const double u = (c * dx + s * dy) / cell, v = (c * dy - s * dx) / cell;
            const double weight = std::hypot(gx, gy) * std::exp(-(u * u + v * v) / 8);
            const double direction = (std::atan2(gy, gx) - double(f.angle)) / (2 * std::numbers::pi) * 8;
            for (int row = 0; row < 4; ++row)
                for (int column = 0; column < 4; ++column)
                    for (int bin = 0; bin < 8; ++bin)
                        out[std::size_t((row * 4 + column) * 8 + bin)] +=
                            weight * hat(u + 1.5 - column) * hat(v + 1.5 - row) *
                            hat(std::remainder(direction - bin, 8.0));
        }
    for (const double most : {0.2, 1.0}) {
        const double size = length(out);
        for (double& value : out) value = std::min(value / size, most);
    }
    return out;
}

}  // namespace

TEST_CASE("SIFT equals the sum over all pixels, cells and directions") {
    ism::ScaleSpace space;
    space.build(noise(71, 64, 11).view());
    for (const float angle : {0.0f, -2.9f, 3.1415927f})
        for (const float scale : {0.5f, 1.3f, 4.4f})
            for (const auto& [x, y] : {std::pair{35.0f, 32.0f}, {30.3f, 33.8f}, {4.2f, 60.9f}}) {
                CAPTURE(angle, scale, x, y);
                const ism::Feature feature{.x = x, .y = y, .scale = scale, .angle = angle};
                std::array<float, 128> row;
                ism::Sift{}.describe(space, feature, row);
                CHECK(distance({row.begin(), row.end()}, slow_sift(space, feature)) < 2e-4);
            }
}

TEST_CASE("SIFT is finite and not negative wherever a feature lies and however it is turned") {
    ism::ScaleSpace space;
    space.build(noise(90, 71, 11).view());
    ism::Random random(4);
    std::size_t wrong = 0;
    for (int i = 0; i < 20000; ++i) {
        const ism::Feature feature{.x = float(std::round(random.uniform(-5, 95) * 4) / 4),
                                   .y = float(std::round(random.uniform(-5, 76) * 4) / 4),
                                   .scale = float(std::exp2(random.uniform(-1, 4))),
                                   .angle = i % 2 == 0 ? 0.0f : float(random.uniform(-20, 20))};
        std::array<float, 128> row;
        ism::RootSift{}.describe(space, feature, row);
        for (const float value : row) wrong += value >= 0 && value <= 1 ? 0 : 1;
    }
    CHECK(wrong == 0);
}

TEST_CASE("SIFT and RootSIFT have unit length, and zeros where nothing is to see") {
    const auto image = noise(80, 60, 11);
    const ism::Feature feature{.x = 33, .y = 21, .scale = 2};
    const auto sift = describe<ism::Sift>(image, feature), root = describe<ism::RootSift>(image, feature);
    CHECK(length(sift) == Approx(1).epsilon(1e-5));
    CHECK(length(root) == Approx(1).epsilon(1e-5));
    double sum = 0;
    for (const double value : sift) sum += value;
    for (std::size_t i = 0; i < sift.size(); ++i)
        CHECK(root[i] == Approx(std::sqrt(sift[i] / sum)).margin(1e-6));
    const ism::GrayImage flat(80, 60, 0.3f);
    CHECK(length(describe<ism::Sift>(flat, feature)) == 0);
    CHECK(length(describe<ism::RootSift>(flat, feature)) == 0);
    CHECK(length(describe<ism::Sift>(image, {.x = -500, .y = 9000, .scale = 1})) == 0);
}

TEST_CASE("SIFT does not change with brightness and contrast") {
    const Pattern pattern(3);
    const ism::Feature feature{.x = 60, .y = 60, .scale = 2.5f};
    const auto base = describe<ism::Sift>(pattern.image(121, 0, 1), feature);
    CHECK(distance(base, describe<ism::Sift>(pattern.image(121, 0, 1, 0.4, 0.3), feature)) < 1e-3);
    const auto patch = describe<ism::GrayPatch>(pattern.image(121, 0, 1), feature);
    const auto other = describe<ism::GrayPatch>(pattern.image(121, 0, 1, 0.4, 0.3), feature);
    for (std::size_t i = 0; i < patch.size(); ++i) CHECK(std::fabs(patch[i] - other[i]) <= 1);
}

TEST_CASE("SIFT turns with Feature::angle and grows with Feature::scale") {
    double worst_turn = 0, worst_scale = 0, unlike = 1e9;
    for (const std::uint64_t seed : {1, 2, 3}) {
        const Pattern pattern(seed);
        const ism::Feature feature{.x = 75, .y = 75, .scale = 3};
        const auto base = describe<ism::Sift>(pattern.image(151, 0, 1), feature);
        for (const double angle : {0.3, 1.0, 1.5707963, -2.0}) {
            ism::Feature turned = feature;
            turned.angle = float(angle);
            worst_turn = std::max(worst_turn,
                                  distance(base, describe<ism::Sift>(pattern.image(151, angle, 1), turned)));
            unlike =
                std::min(unlike, distance(base, describe<ism::Sift>(pattern.image(151, angle, 1), feature)));
        }
        for (const double scale : {0.7, 1.3, 1.9}) {
            ism::Feature grown = feature;
            grown.scale *= float(scale);
            worst_scale = std::max(worst_scale,
                                   distance(base, describe<ism::Sift>(pattern.image(151, 0, scale), grown)));
        }
    }
    CHECK(worst_turn < 0.05);
    CHECK(worst_scale < 0.12);  // half a level of blur to one side or the other
    CHECK(unlike > 0.3);
}

TEST_CASE("a direction found in a turned image is turned by as much") {
    int found = 0;
    for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
        const Pattern pattern(seed);
        const std::vector<ism::Feature> features{{.x = 75, .y = 75, .scale = 3}};
        const auto directions = [&](double angle) {
            ism::ScaleSpace space;
            space.build(pattern.image(151, angle, 1).view());
            ism::Workspace workspace;
            return ism::assign_orientations(space, features, workspace);
        };
        const auto base = directions(0);
        REQUIRE(!base.empty());
        for (const double angle : {0.5, -1.2, 2.8}) {
            const auto turned = directions(angle);
            const double off =
                std::remainder(double(turned[0].angle) - double(base[0].angle) - angle, 2 * std::numbers::pi);
            found += std::fabs(off) < 0.05 ? 1 : 0;
        }
    }
    CHECK(found >= 17);  // of 18; two peaks of one height may change places
}

TEST_CASE("a ramp has the direction of its rise") {
    ism::Workspace workspace;
    for (const double angle : {0.0, 0.4, 1.9, -1.0, -2.7, 3.1}) {
        ism::GrayImage ramp(64, 64);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x)
                ramp(x, y) = float(0.5 + 0.005 * ((x - 32) * std::cos(angle) + (y - 32) * std::sin(angle)));
        ism::ScaleSpace space;
        space.build(ramp.view());
        const auto oriented = ism::assign_orientations(
            space, std::vector{ism::Feature{.x = 32, .y = 32, .scale = 2}}, workspace);
        REQUIRE(oriented.size() == 1);
        CHECK(double(oriented[0].angle) == Approx(angle).margin(0.01));
        CHECK(oriented[0].angle != 0);
    }
    ism::ScaleSpace space;
    space.build(ism::GrayImage(64, 64, 0.5f).view());
    const auto flat = ism::assign_orientations(space, std::vector{ism::Feature{.x = 32, .y = 32}}, workspace);
    REQUIRE(flat.size() == 1);
    CHECK(flat[0].angle == 0);
}

TEST_CASE("a grey patch holds the samples around the feature") {
    ism::GrayImage ramp(200, 200);
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 200; ++x) ramp(x, y) = float(x) / 200.0f;
    const ism::Feature feature{.x = 100, .y = 90, .scale = 4};
    const auto patch = describe<ism::GrayPatch>(ramp, feature);
    // columns −12 … 12 have the deviation √52
    for (int row = 0; row < 25; ++row)
        for (int column = 0; column < 25; ++column)
            CHECK(std::fabs(patch[std::size_t(row * 25 + column)] -
                            (128 + 42 * (column - 12) / std::sqrt(52.0))) <= 1);
    ism::Feature turned = feature;
    turned.angle = float(std::numbers::pi / 2);  // columns run along y now, rows against x
    const auto other = describe<ism::GrayPatch>(ramp, turned);
    for (int row = 0; row < 25; ++row)
        for (int column = 0; column < 25; ++column)
            CHECK(std::fabs(other[std::size_t(row * 25 + column)] -
                            (128 - 42 * (row - 12) / std::sqrt(52.0))) <= 1);
    for (const double value : describe<ism::GrayPatch>(ism::GrayImage(64, 64, 0.2f), feature))
        CHECK(value == 128);
}

TEST_CASE("directions are the same bits for any number of threads") {
    const auto image = noise(150, 131, 11);
    const auto directions = [&](unsigned threads) {
        ism::Workspace workspace(threads);
        ism::ScaleSpace space;
        space.build(image.view(), {}, workspace);
        return ism::assign_orientations(space, ism::DenseGrid{}.detect(space, workspace), workspace);
    };
    const auto one = directions(1);
    REQUIRE(one.size() > 200);
    const auto two = directions(2);
    REQUIRE(two.size() == one.size());
    bool same = true;
    for (std::size_t i = 0; i < one.size(); ++i)
        same = same && one[i].angle == two[i].angle && one[i].x == two[i].x;
    CHECK(same);
}

TEMPLATE_TEST_CASE("descriptors want a scale space", "", ism::Sift, ism::RootSift, ism::GrayPatch) {
    std::array<typename TestType::Scalar, TestType::dimension> row;
    CHECK_THROWS_AS(TestType{}.describe(ism::ScaleSpace{}, ism::Feature{}, row), ism::Error);
}
