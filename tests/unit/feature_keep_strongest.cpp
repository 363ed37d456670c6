// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/feature/difference_of_gaussians.hpp"
#include "ism/feature/extract.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/keep_strongest.hpp"
#include "ism/feature/sift.hpp"

namespace {

std::vector<ism::Feature> kept(std::vector<ism::Feature> features, std::size_t count, int width, int height) {
    ism::Workspace workspace;
    ism::keep_strongest_evenly(features, count, width, height, workspace);
    return features;
}

}  // namespace

TEST_CASE("of features in cells of the image each cell gives its strongest in turn") {
    // 16 features of 160x80 pixels are 2 cells of 80x80: 12 strong features to the left, 20 weak ones right
    std::vector<ism::Feature> features;
    for (int i = 0; i < 32; ++i) {
        const bool left = i < 12;
        features.push_back({.x = left ? float(5 * i) : float(83 + 3 * (i - 12)),
                            .y = 40,
                            .scale = 2,
                            .strength = left ? 1000 - float(i) : 1 + float(i)});
    }
    const auto few = kept(features, 16, 160, 80);
    REQUIRE(few.size() == 16);
    std::vector<ism::Feature> expected(features.begin(), features.begin() + 8);  // the strongest left
    expected.insert(expected.end(), features.end() - 8, features.end());         // and right, in order
    CHECK(std::equal(few.begin(), few.end(), expected.begin(),
                     [](const auto& a, const auto& b) { return a.x == b.x && a.strength == b.strength; }));
}

TEST_CASE("the strongest are kept in the order they came in, as many as asked for, ties by order") {
    ism::Random random(4);
    std::vector<ism::Feature> features;
    for (int i = 0; i < 300; ++i)
        features.push_back({.x = float(random.uniform(-3, 103)),  // places outside count to the edge
                            .y = float(random.uniform(-3, 53)),
                            .strength = float(int(random.uniform(0, 20)))});
    for (const std::size_t count : {std::size_t(0), std::size_t(1), std::size_t(7), std::size_t(299)}) {
        const auto few = kept(features, count, 100, 50);
        REQUIRE(few.size() == count);
        std::size_t at = 0;
        for (const ism::Feature& f : few) {
            while (at < features.size() && (features[at].x != f.x || features[at].y != f.y)) ++at;
            REQUIRE(at < features.size());
            ++at;
        }
        const auto strongest =
            std::max_element(features.begin(), features.end(),
                             [](const auto& a, const auto& b) { return a.strength < b.strength; });
        if (count >= 7)
            CHECK(std::any_of(few.begin(), few.end(),
                              [&](const auto& f) { return f.strength == strongest->strength; }));
    }
    CHECK(kept(features, 300, 100, 50).size() == 300);
    CHECK(kept(features, 5000, 100, 50).size() == 300);
    CHECK(kept({}, 0, 100, 50).empty());
    CHECK(kept(features, 9, 1, 1).size() == 9);  // one cell
    const std::vector<ism::Feature> equal(20, {.x = 3, .y = 3, .strength = 1});
    CHECK(kept(equal, 5, 100, 50).size() == 5);
}

TEMPLATE_TEST_CASE("blobs at the border are found as far as the option border lets them, and described", "",
                   ism::DifferenceOfGaussians, ism::HessianLaplace) {
    for (const double at : {4.0, 9.0, 60.0, 111.0, 116.0})
        for (const bool along_x : {true, false}) {
            const double x = along_x ? at : 60, y = along_x ? 60 : at, sigma = 2.5;
            ism::GrayImage image(121, 121, 0.3f);
            for (int j = 0; j < 121; ++j)
                for (int i = 0; i < 121; ++i)
                    image(i, j) +=
                        float(0.5 * std::exp(-((i - x) * (i - x) + (j - y) * (j - y)) / (2 * sigma * sigma)));
            CAPTURE(x, y);
            const auto found_with = [&](int border) {
                ism::Extractor<TestType, ism::Sift> extractor;
                extractor.detector.border = border;
                const auto set = ism::extract(image.view(), extractor);
                std::size_t near = 0;
                for (std::size_t i = 0; i < set.features.size(); ++i) {
                    const ism::Feature& f = set.features[i];
                    near += std::hypot(f.x - x, f.y - y) < 1;
                    float squares = 0;
                    for (const float value : set.descriptors.row(i)) squares += value * value;
                    CHECK(squares == Approx(1).epsilon(1e-4));
                }
                return near;
            };
            CHECK(found_with(1) > 0);
            // 20 pixels of the octave of scale 2.5, where a pixel is one of the image, or half of one
            CHECK((found_with(20) > 0) == (at == 60));
        }
}
