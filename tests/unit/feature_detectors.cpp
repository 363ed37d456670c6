// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/feature/dense_grid.hpp"
#include "ism/feature/difference_of_gaussians.hpp"
#include "ism/feature/harris_laplace.hpp"
#include "ism/feature/hessian_laplace.hpp"

namespace {

struct Blob {
    double x = 0, y = 0, sigma = 1, height = 0.5;
};

ism::GrayImage blobs(int width, int height, const std::vector<Blob>& list) {
    ism::GrayImage image(width, height, 0.5f);
    for (const Blob& b : list)
        for (int j = 0; j < height; ++j)
            for (int i = 0; i < width; ++i)
                image(i, j) += float(b.height * std::exp(-((i - b.x) * (i - b.x) + (j - b.y) * (j - b.y)) /
                                                         (2 * b.sigma * b.sigma)));
    return image;
}

/// Smooth structure of all sizes.
ism::GrayImage texture(int width, int height) {
    ism::Random random(7);
    std::vector<Blob> list;
    for (int i = 0; i < 400; ++i)
        list.push_back({random.uniform(0, width), random.uniform(0, height),
                        std::exp(random.uniform(0.2, 1.5)), random.uniform(-0.4, 0.4)});
    return blobs(width, height, list);
}

/// A white square with its middle at (x, y), each pixel the mean over its area; corner points exact.
ism::GrayImage square(int size, double x, double y, double half) {
    const auto cover = [](double from, double to, int pixel) {
        return std::max(0.0, std::min(to, pixel + 0.5) - std::max(from, pixel - 0.5));
    };
    ism::GrayImage image(size, size, 0.2f);
    for (int j = 0; j < size; ++j)
        for (int i = 0; i < size; ++i)
            image(i, j) += float(0.6 * cover(x - half, x + half, i) * cover(y - half, y + half, j));
    return image;
}

template <ism::Detector D>
std::vector<ism::Feature> detect(const ism::GrayImage& image, const D& detector = {}, unsigned threads = 1) {
    ism::Workspace workspace(threads);
    ism::ScaleSpace space;
    space.build(image.view(), {}, workspace);
    return detector.detect(space, workspace);
}

const ism::Feature* strongest_at(const std::vector<ism::Feature>& features, double x, double y,
                                 double within) {
    const ism::Feature* best = nullptr;
    for (const ism::Feature& f : features)
        if (std::hypot(f.x - x, f.y - y) <= within && (best == nullptr || f.strength > best->strength))
            best = &f;
    return best;
}

}  // namespace

TEMPLATE_TEST_CASE("blob detectors find blobs at their place and scale", "", ism::DifferenceOfGaussians,
                   ism::HessianLaplace) {
    // The image is taken to carry a blur of 0.5, so a blob of deviation t acts like √(t² − 0.25).
    const double factor = std::is_same_v<TestType, ism::DifferenceOfGaussians> ? std::exp2(-1 / 6.0) : 1.0;
    for (const double sigma : {1.8, 2.2, 3.0, 4.3, 6.1, 8.0})
        for (const double height : {0.4, -0.4})
            for (const auto& [x, y] : {std::pair{60.0, 59.0}, {60.5, 59.5}, {60.27, 59.81}}) {
                CAPTURE(sigma, height, x, y);
                const auto features = detect<TestType>(blobs(121, 120, {{x, y, sigma, height}}));
                const ism::Feature* f = strongest_at(features, x, y, 1);
                REQUIRE(f != nullptr);
                CHECK(f->x == Approx(x).margin(0.03 * sigma));
                CHECK(f->y == Approx(y).margin(0.03 * sigma));
                CHECK(f->scale == Approx(factor * std::sqrt(sigma * sigma - 0.25)).epsilon(0.06));
            }
}

TEST_CASE("a small blob on a large one is a feature beside it") {
    const auto features =
        detect<ism::HessianLaplace>(blobs(161, 160, {{80, 80, 12, 0.3}, {80.3, 80.2, 2, -0.4}}));
    const auto has_scale = [&](float least, float most) {
        return std::any_of(features.begin(), features.end(), [&](const ism::Feature& f) {
            return std::hypot(f.x - 80, f.y - 80) < 2 && f.scale > least && f.scale < most;
        });
    };
    CHECK(has_scale(1.5f, 2.6f));
    CHECK(has_scale(9, 15));
}

TEST_CASE("Harris-Laplace finds the four corners of a square") {
    for (const double half : {6.0, 9.3, 14.0}) {
        const double x = 50.4, y = 47.8;
        const auto features = detect<ism::HarrisLaplace>(square(100, x, y, half));
        for (const double sx : {-1.0, 1.0})
            for (const double sy : {-1.0, 1.0}) {
                CAPTURE(half, sx, sy);
                // blur draws a corner's maximum inwards along the diagonal by about its scale
                CHECK(std::any_of(features.begin(), features.end(), [&](const ism::Feature& f) {
                    const double in_x = half - sx * (double(f.x) - x), in_y = half - sy * (double(f.y) - y);
                    return std::fabs(in_x - in_y) < 0.1 && in_x > 0 && in_x < 1.3 * double(f.scale) &&
                           in_x < 0.6 * half;
                }));
            }
        // and nothing in the middle of a side
        for (const auto& [mx, my] : {std::pair{x - half, y}, {x + half, y}, {x, y - half}, {x, y + half}})
            CHECK(strongest_at(features, mx, my, 0.3 * half) == nullptr);
    }
}

TEST_CASE("edges and flat images give no features") {
    ism::GrayImage edge(96, 80, 0.2f);
    for (int y = 0; y < 80; ++y)
        for (int x = 48; x < 96; ++x) edge(x, y) = 0.8f;
    CHECK(detect<ism::DifferenceOfGaussians>(edge).empty());
    CHECK(detect<ism::HarrisLaplace>(edge).empty());
    CHECK(detect<ism::HessianLaplace>(edge).empty());
    const ism::GrayImage flat(64, 64, 0.5f);
    CHECK(detect<ism::DifferenceOfGaussians>(flat).empty());
    CHECK(detect<ism::HarrisLaplace>(flat).empty());
    CHECK(detect<ism::HessianLaplace>(flat).empty());
}

TEST_CASE("what lies along an edge is refused, by the ratio of curvatures that is asked for") {
    // A bright line that is a little brighter at every twelfth pixel.
    ism::GrayImage line(160, 80, 0.2f);
    for (int y = 0; y < 80; ++y)
        for (int x = 0; x < 160; ++x)
            line(x, y) += float((0.5 + 0.06 * std::cos(x * 2 * std::numbers::pi / 12)) *
                                std::exp(-(y - 40.0) * (y - 40.0) / (2 * 2.5 * 2.5)));
    CHECK(detect(line, ism::DifferenceOfGaussians{.edge_ratio = 1e6f}).size() >= 8);
    CHECK(detect(line, ism::DifferenceOfGaussians{.edge_ratio = 4}).empty());
}

TEMPLATE_TEST_CASE("detectors give the same bits for any number of threads, within the image", "",
                   ism::DifferenceOfGaussians, ism::HarrisLaplace, ism::HessianLaplace, ism::DenseGrid) {
    for (const auto& [width, height] : {std::pair{16, 16}, {203, 17}, {181, 157}}) {
        const auto image = texture(width, height);
        const auto one = detect<TestType>(image, {}, 1);
        const auto two = detect<TestType>(image, {}, 2), three = detect<TestType>(image, {}, 3);
        REQUIRE(one.size() == two.size());
        REQUIRE(one.size() == three.size());
        if (width == 181) CHECK(one.size() > 20);
        bool same = true, inside = true;
        for (std::size_t i = 0; i < one.size(); ++i) {
            const auto equal = [](const ism::Feature& a, const ism::Feature& b) {
                return a.x == b.x && a.y == b.y && a.scale == b.scale && a.strength == b.strength;
            };
            same = same && equal(one[i], two[i]) && equal(one[i], three[i]);
            inside = inside && one[i].x >= 0 && one[i].y >= 0 && one[i].x <= float(width - 1) &&
                     one[i].y <= float(height - 1) && one[i].scale > 0 && one[i].strength >= 0;
        }
        CHECK(same);
        CHECK(inside);
    }
}

TEMPLATE_TEST_CASE("features move with a shifted and a mirrored image", "", ism::DifferenceOfGaussians,
                   ism::HarrisLaplace, ism::HessianLaplace) {
    const auto image = texture(200, 160);
    const auto part = [&](int x0, int y0) {
        ism::GrayImage copy(160, 128);
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 160; ++x) copy(x, y) = image(x0 + x, y0 + y);
        return copy;
    };
    ism::GrayImage mirrored = part(0, 0);
    for (int y = 0; y < 128; ++y) std::reverse(mirrored.row(y).begin(), mirrored.row(y).end());

    const auto base = detect<TestType>(part(0, 0)), moved = detect<TestType>(part(13, 7)),
               flipped = detect<TestType>(mirrored);
    int inner = 0, found_moved = 0, found_flipped = 0;
    for (const ism::Feature& f : base) {
        const float room = 8 * f.scale;
        if (f.x < 13 + room || f.y < 7 + room || f.x > 159 - room || f.y > 127 - room) continue;
        ++inner;
        const auto matches = [&](const std::vector<ism::Feature>& list, double x, double y) {
            return std::any_of(list.begin(), list.end(), [&](const ism::Feature& g) {
                return std::hypot(double(g.x) - x, double(g.y) - y) < 0.1 * double(f.scale) &&
                       std::fabs(std::log(g.scale / f.scale)) < 0.1f;
            });
        };
        found_moved += matches(moved, double(f.x) - 13, double(f.y) - 7) ? 1 : 0;
        found_flipped += matches(flipped, 159 - double(f.x), double(f.y)) ? 1 : 0;
    }
    CHECK(inner >= 15);
    CHECK(found_moved >= 0.9 * inner);
    CHECK(found_flipped >= 0.9 * inner);
}

TEST_CASE("a dense grid is regular and centred") {
    ism::Workspace workspace;
    ism::ScaleSpace space;
    space.build(ism::GrayImage(101, 61).view());
    const ism::DenseGrid grid{.spacing = 5, .margin = 3, .first_scale = 2, .scale_count = 1};
    const auto features = grid.detect(space, workspace);
    // room 100 − 12 = 88 and 60 − 12 = 48 pixels for steps of 10: 9 × 5 points
    REQUIRE(features.size() == 45);
    CHECK(features.front().x == 10);
    CHECK(features.front().y == 10);
    CHECK(features.back().x == 90);
    CHECK(features.back().y == 50);
    CHECK_THROWS_AS((ism::DenseGrid{.spacing = 0}.detect(space, workspace)), ism::Error);
}

TEST_CASE("detectors refuse options out of range") {
    ism::Workspace workspace;
    ism::ScaleSpace space;
    space.build(ism::GrayImage(32, 32).view());
    CHECK_THROWS_AS((ism::DifferenceOfGaussians{.edge_ratio = 0}.detect(space, workspace)), ism::Error);
    CHECK_THROWS_AS((ism::DifferenceOfGaussians{.contrast_threshold = NAN}.detect(space, workspace)),
                    ism::Error);
    CHECK_THROWS_AS((ism::HarrisLaplace{.alpha = 0.5f}.detect(space, workspace)), ism::Error);
    CHECK_THROWS_AS((ism::HessianLaplace{.scale_tolerance = 0}.detect(space, workspace)), ism::Error);
}
