// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <type_traits>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/feature/byte_sift.hpp"
#include "ism/feature/dense_grid.hpp"
#include "ism/feature/depth.hpp"
#include "ism/feature/difference_of_gaussians.hpp"
#include "ism/feature/extract.hpp"
#include "ism/feature/gray_patch.hpp"
#include "ism/feature/harris_laplace.hpp"
#include "ism/feature/hessian_laplace.hpp"

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

template <ism::DescriptorScalar T>
void check_same(const ism::FeatureSet<T>& a, const ism::FeatureSet<T>& b) {
    REQUIRE(a.features.size() == b.features.size());
    bool same = true;
    for (std::size_t i = 0; i < a.features.size(); ++i) {
        ism::Feature f = a.features[i], g = b.features[i];
        f.depth_m = g.depth_m = 0;
        same = same && f == g;
    }
    CHECK(same);
    CHECK(std::equal(a.descriptors.values().begin(), a.descriptors.values().end(),
                     b.descriptors.values().begin(), b.descriptors.values().end()));
}

using DogRoot = ism::Extractor<ism::DifferenceOfGaussians, ism::RootSift>;
using HarrisSift = ism::Extractor<ism::HarrisLaplace, ism::Sift>;
using HessianPatch = ism::Extractor<ism::HessianLaplace, ism::GrayPatch>;
using DenseBytes = ism::Extractor<ism::DenseGrid, ism::ByteSift>;

TEMPLATE_TEST_CASE("features are the same bits for any threads, and whatever was extracted before", "",
                   DogRoot, HarrisSift, HessianPatch, DenseBytes) {
    using Extractor =
        ism::FeatureExtractor<typename TestType::DetectorType, typename TestType::DescriptorType>;
    TestType settings;
    settings.options.oriented = true;
    settings.options.max_features = 150;
    const auto image = picture(173, 121);
    const auto own = ism::extract(image.view(), settings);
    REQUIRE(own.features.size() > 30);
    CHECK(own.descriptors.size() == own.features.size());
    for (const unsigned threads : {1u, 2u, 3u}) {
        Extractor extractor(settings, threads);
        (void)extractor.extract(picture(99, 203).view());
        check_same(own, extractor.extract(image.view()));
        check_same(own, extractor.extract(image.view()));
    }
}

// A copy would share the threads, and a workspace is for one frame at a time.
static_assert(!std::is_copy_constructible_v<ism::Workspace> && std::is_move_constructible_v<ism::Workspace>);

TEST_CASE("an image of 8 bits gives what its brightness gives") {
    ism::Image<std::uint8_t> bytes(101, 77);
    ism::Random random(3);
    for (auto& value : bytes.pixels()) value = std::uint8_t(random.uniform(0, 256));
    ism::FeatureExtractor<ism::DifferenceOfGaussians, ism::RootSift> extractor;
    check_same(extractor.extract(bytes.view()), ism::extract(ism::to_gray(bytes), dog));
    CHECK_THROWS_AS(extractor.extract(ism::Image<std::uint8_t>(15, 40).view()), ism::Error);
}

TEST_CASE("a region gives the features of the whole image that lie in it") {
    const auto image = picture(400, 340);
    ism::FeatureExtractor<ism::DifferenceOfGaussians, ism::RootSift> extractor(dog);
    for (const double upsampling : {1.0, 0.7, 1.3, 2.0})
        for (const bool oriented : {false, true}) {
            auto settings = dog;
            settings.options.upsampling = upsampling, settings.options.oriented = oriented;
            const auto whole = ism::extract(image.view(), settings);
            extractor = ism::FeatureExtractor(settings);
            for (const ism::Region& region :
                 {ism::Region{101, 77, 150, 120}, {0, 0, 64, 340}, {300, 290, 100, 50}, {0, 0, 400, 340}}) {
                CAPTURE(upsampling, oriented, region.x, region.y, region.width, region.height);
                const auto& part = extractor.extract(image.view(), region);
                std::size_t inside = 0, found = 0;
                for (std::size_t i = 0; i < whole.features.size(); ++i) {
                    const ism::Feature& f = whole.features[i];
                    if (f.scale > 8 || f.x < float(region.x) || f.y < float(region.y) ||
                        f.x >= float(region.x + region.width) || f.y >= float(region.y + region.height))
                        continue;
                    ++inside;
                    const auto same =
                        std::find_if(part.features.begin(), part.features.end(), [&](const auto& g) {
                            return std::hypot(g.x - f.x, g.y - f.y) < 1e-3f &&
                                   std::fabs(g.scale / f.scale - 1) < 1e-4f &&
                                   std::fabs(g.angle - f.angle) < 1e-3f;
                        });
                    if (same == part.features.end()) continue;
                    const auto row = part.descriptors.row(std::size_t(same - part.features.begin()));
                    float sq_distance = 0;
                    for (std::size_t k = 0; k < row.size(); ++k)
                        sq_distance += std::pow(row[k] - whole.descriptors.row(i)[k], 2.0f);
                    found += sq_distance < 1e-4f;
                }
                CHECK(inside >= 5);
                CHECK(found == inside);
                for (const ism::Feature& f : part.features) {
                    CHECK(f.x >= float(region.x) - 1e-3f);
                    CHECK(f.y < float(region.y + region.height) + 1e-3f);
                }
            }
        }
    extractor = ism::FeatureExtractor(dog);
    CHECK_THROWS_AS(extractor.extract(image.view(), ism::Region{390, 0, 20, 20}), ism::Error);
    CHECK_THROWS_WITH(extractor.extract(image.view(), ism::Region{0, 0, 20, 15}),
                      "image region size: expected at least 16x16, got 20x15");
    // The whole image, not the region, has to be large enough when it is resized.
    auto small = dog;
    small.options.upsampling = 1.0 / 16;
    extractor = ism::FeatureExtractor(small);
    CHECK_NOTHROW(extractor.extract(image.view(), ism::Region{100, 100, 60, 60}));
}

TEST_CASE("byte descriptors are SIFT times 512") {
    const auto image = picture(173, 121);
    const auto exact = ism::extract(image.view(), ism::Extractor<ism::DifferenceOfGaussians, ism::Sift>{});
    const auto bytes =
        ism::extract(image.view(), ism::Extractor<ism::DifferenceOfGaussians, ism::ByteSift>{});
    const auto root = ism::extract(image.view(), dog);
    const auto root_bytes =
        ism::extract(image.view(), ism::Extractor<ism::DifferenceOfGaussians, ism::ByteRootSift>{});
    REQUIRE(bytes.features.size() == exact.features.size());
    for (std::size_t i = 0; i < exact.descriptors.values().size(); ++i) {
        const float value = exact.descriptors.values()[i], rooted = root.descriptors.values()[i];
        CHECK(std::fabs(float(bytes.descriptors.values()[i]) - std::min(255.0f, 512 * value)) <= 0.501f);
        CHECK(std::fabs(float(root_bytes.descriptors.values()[i]) - std::min(255.0f, 512 * rooted)) <=
              0.501f);
    }
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
                      "image brightness at (3, 17): expected 0 to 1 (accepted: -4 to 4), got nan");
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
