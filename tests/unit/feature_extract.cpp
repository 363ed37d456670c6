// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/feature/dense_grid.hpp"
#include "ism/feature/depth.hpp"
#include "ism/feature/difference_of_gaussians.hpp"
#include "ism/feature/extract.hpp"
#include "ism/feature/gray_patch.hpp"
#include "ism/feature/harris_laplace.hpp"

namespace {

/// Blobs on a jittered grid, stronger towards the left.
ism::GrayImage picture(int width, int height) {
    ism::Random random(5);
    ism::GrayImage image(width, height, 0.5f);
    for (int by = 12; by < height; by += 20)
        for (int bx = 12; bx < width; bx += 20) {
            const double x = bx + random.uniform(-3, 3), y = by + random.uniform(-3, 3);
            const double sigma = random.uniform(2.0, 3.5);
            const double height_of = (random.uniform() < 0.5 ? -0.4 : 0.4) * (1.2 - double(bx) / width);
            for (int j = std::max(0, by - 20); j < std::min(height, by + 20); ++j)
                for (int i = std::max(0, bx - 20); i < std::min(width, bx + 20); ++i)
                    image(i, j) += float(
                        height_of * std::exp(-((i - x) * (i - x) + (j - y) * (j - y)) / (2 * sigma * sigma)));
        }
    return image;
}

const ism::Extractor<ism::DifferenceOfGaussians, ism::RootSift> dog;

}  // namespace

TEST_CASE("extract gives each feature a descriptor, whatever the workspace held before") {
    const auto image = picture(173, 121);
    const auto own = ism::extract(image.view(), dog);
    REQUIRE(own.features.size() > 30);
    CHECK(own.descriptors.size() == own.features.size());
    ism::ScaleSpace workspace;
    (void)ism::extract(picture(99, 203).view(), dog, workspace);
    const auto lent = ism::extract(image.view(), dog, workspace, 2);
    REQUIRE(lent.features.size() == own.features.size());
    for (std::size_t i = 0; i < own.features.size(); ++i) {
        CHECK(lent.features[i].x == own.features[i].x);
        CHECK(lent.features[i].scale == own.features[i].scale);
    }
    CHECK(std::equal(own.descriptors.values().begin(), own.descriptors.values().end(),
                     lent.descriptors.values().begin()));
}

TEST_CASE("upsampling gives positions and scales in pixels of the image given") {
    const auto image = picture(140, 100);
    const auto base = ism::extract(image.view(), dog);
    for (const double factor : {0.6, 1.5, 2.0}) {
        auto resized = dog;
        resized.options.upsampling = factor;
        const auto other = ism::extract(image.view(), resized);
        std::size_t again = 0, asked = 0;
        for (const ism::Feature& f : base.features) {
            if (f.x < 15 || f.y < 15 || f.x > 124 || f.y > 84 || f.scale < 1.6f || f.scale > 3.2f) continue;
            ++asked;
            again += std::any_of(other.features.begin(), other.features.end(), [&](const ism::Feature& g) {
                return std::hypot(g.x - f.x, g.y - f.y) < 0.15f && std::fabs(g.scale / f.scale - 1) < 0.1f;
            });
        }
        CAPTURE(factor, asked, again);
        CHECK(asked > 8);
        CHECK(double(again) >= 0.9 * double(asked));
    }
}

TEST_CASE("max_features keeps the strongest of every part of the image, in order") {
    const auto image = picture(400, 240);
    auto few = dog;
    few.options.max_features = 60;
    const auto all = ism::extract(image.view(), dog);
    const auto kept = ism::extract(image.view(), few);
    REQUIRE(all.features.size() > 100);
    REQUIRE(kept.features.size() == 60);
    std::size_t right = 0, at = 0;
    for (const ism::Feature& f : kept.features) {
        right += f.x > 200;
        while (at < all.features.size() && (all.features[at].x != f.x || all.features[at].y != f.y)) ++at;
    }
    CHECK(at < all.features.size());  // a subsequence
    CHECK(right >= 20);               // although the right half is weak
    const auto strongest =
        std::max_element(all.features.begin(), all.features.end(),
                         [](const auto& a, const auto& b) { return a.strength < b.strength; });
    CHECK(std::any_of(kept.features.begin(), kept.features.end(),
                      [&](const ism::Feature& f) { return f.strength == strongest->strength; }));
}

TEST_CASE("oriented features keep their place and may multiply") {
    auto oriented = dog;
    oriented.options.oriented = true;
    const auto image = picture(173, 121);
    const auto upright = ism::extract(image.view(), dog), turned = ism::extract(image.view(), oriented);
    CHECK(turned.features.size() >= upright.features.size());
    std::set<std::pair<float, float>> places;
    for (const ism::Feature& f : upright.features) {
        CHECK(f.angle == 0);
        places.insert({f.x, f.y});
    }
    for (const ism::Feature& f : turned.features) {
        CHECK(places.count({f.x, f.y}) == 1);
        CHECK(f.angle != 0);
    }
}

TEST_CASE("extract refuses what is not an image") {
    CHECK_THROWS_WITH(ism::extract(ism::GrayImage(40, 15).view(), dog),
                      "image size: expected at least 16x16, got 40x15");
    auto image = picture(40, 40);
    image(3, 17) = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_WITH(ism::extract(image.view(), dog),
                      "image brightness at (3, 17): expected a finite value, got nan");
    image(3, 17) = std::numeric_limits<float>::infinity();
    CHECK_THROWS_AS(ism::extract(image.view(), dog), ism::Error);
    auto wrong = dog;
    wrong.options.upsampling = 0;
    CHECK_THROWS_AS(ism::extract(picture(40, 40).view(), wrong), ism::Error);
    wrong.options.upsampling = 0.2;
    CHECK_THROWS_WITH(ism::extract(picture(40, 40).view(), wrong),
                      "image size after upsampling: expected at least 16x16, got 8x8");
}

TEST_CASE("the smallest images pass through every combination") {
    const auto image = picture(16, 17);
    CHECK_NOTHROW(ism::extract(image.view(), ism::Extractor<ism::HarrisLaplace, ism::Sift>{}));
    const auto dense = ism::extract(image.view(), ism::Extractor<ism::DenseGrid, ism::GrayPatch>{});
    CHECK(dense.features.size() == dense.descriptors.size());
    CHECK(!dense.features.empty());
}

TEST_CASE("depth at a place is the median of the readings around it") {
    ism::DepthMap depth_m(20, 20, 0.0f);
    CHECK(std::isnan(ism::depth_at(depth_m.view(), 10, 10, 3)));
    // five pixels within a radius of 1: of 2 of 5 readings the nearer
    depth_m(10, 10) = 2.0f, depth_m(11, 10) = 1.0f;
    CHECK(ism::depth_at(depth_m.view(), 10, 10, 1) == 1.0f);
    depth_m(10, 11) = 3.0f;
    CHECK(ism::depth_at(depth_m.view(), 10, 10, 1) == 2.0f);
    // 3 of the 29 pixels within a radius of 3 are too few
    CHECK(std::isnan(ism::depth_at(depth_m.view(), 10, 10, 3)));
    // NaN and infinity are no readings
    depth_m(10, 10) = NAN, depth_m(11, 10) = std::numeric_limits<float>::infinity();
    CHECK(std::isnan(ism::depth_at(depth_m.view(), 10, 10, 1)));
    // the nearest pixel counts however small the radius
    CHECK(ism::depth_at(depth_m.view(), 10.4f, 10.6f, 0) == 3.0f);
    CHECK(std::isnan(ism::depth_at(depth_m.view(), -1, 10, 5)));
    CHECK(std::isnan(ism::depth_at(depth_m.view(), 10, NAN, 5)));
    CHECK(std::isnan(ism::depth_at(depth_m.view(), 25, 10, 50)));
}

TEST_CASE("features get the depth of their neighbourhood or stay without") {
    ism::DepthMap depth_m(40, 30, 0.0f);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 20; ++x) depth_m(x, y) = 1.5f;
    const auto features =
        ism::with_depth({{.x = 8, .y = 9, .scale = 100}, {.x = 33, .y = 9, .scale = 2}}, depth_m.view());
    REQUIRE(features.size() == 2);
    CHECK(features[0].depth_m == 1.5f);
    CHECK(std::isnan(features[1].depth_m));
    CHECK_THROWS_AS(ism::with_depth({}, ism::DepthMap().view()), ism::Error);
}
