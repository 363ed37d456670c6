// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/feature/byte_sift.hpp"
#include "ism/feature/dense_grid.hpp"
#include "ism/feature/difference_of_gaussians.hpp"
#include "ism/feature/extract.hpp"
#include "ism/feature/gray_patch.hpp"
#include "ism/feature/harris_laplace.hpp"
#include "ism/feature/hessian_laplace.hpp"

namespace {

/// Noise of all scales from 3 pixels on.
ism::GrayImage texture(int width, int height, std::uint64_t seed) {
    ism::Random random(seed);
    ism::GrayImage image(width, height, 0.5f);
    for (int cell = 48; cell >= 3; cell /= 2) {
        ism::GrayImage grid(width / cell + 2, height / cell + 2);
        for (float& value : grid.pixels()) value = float(random.uniform(-0.25, 0.25));
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                image(x, y) +=
                    ism::sample_bilinear(grid.view(), float(x) / float(cell), float(y) / float(cell));
    }
    return image;
}

template <class Set>
bool same_bits(const Set& a, const Set& b) {
    const auto equal = [](const ism::Feature& f, const ism::Feature& g) {
        return f.x == g.x && f.y == g.y && f.scale == g.scale && f.angle == g.angle &&
               f.strength == g.strength;
    };
    return std::equal(a.features.begin(), a.features.end(), b.features.begin(), b.features.end(), equal) &&
           std::equal(a.descriptors.values().begin(), a.descriptors.values().end(),
                      b.descriptors.values().begin(), b.descriptors.values().end());
}

}  // namespace

TEST_CASE("the rows of a scale space made in bands are those of the whole") {
    const auto image = texture(61, 700, 1);
    for (const bool doubled : {true, false})
        for (const unsigned threads : {1u, 3u})
            for (const std::size_t bytes : {std::size_t(1), std::size_t(400000), std::size_t(1000000)}) {
                CAPTURE(doubled, threads, bytes);
                const ism::ScaleSpaceOptions options{.double_first_octave = doubled};
                ism::ScaleSpace whole, bands;
                whole.build(image.view(), options);
                ism::Workspace workspace(threads);
                bands.begin(image.view(), options, workspace, bytes);
                REQUIRE(bands.octaves() == whole.octaves());
                REQUIRE(bands.banded_octaves() > 0);
                for (int round = 0; round < 2; ++round) {
                    std::vector<int> seen(std::size_t(whole.octaves()), 0);
                    int calls = 0;
                    bool same = true;
                    for (; bands.advance(workspace); ++calls)
                        for (int o = 0; o < bands.octaves(); ++o) {
                            const int ready = bands.rows_ready(o);
                            for (int& y = seen[std::size_t(o)]; y < ready; ++y)
                                for (int i = 0; i < whole.levels(); ++i) {
                                    const auto a = whole.level(o, i).row(y), b = bands.level(o, i).row(y);
                                    same = same && std::equal(a.begin(), a.end(), b.begin());
                                    if (i < 1 || i > whole.levels_per_octave() || y % 2 != 0) continue;
                                    const auto c = whole.halved(o, i).row(y / 2),
                                               d = bands.halved(o, i).row(y / 2);
                                    same = same && std::equal(c.begin(), c.end(), d.begin());
                                }
                            bands.forget(o, ready);
                        }
                    CHECK(same);
                    CHECK(calls >= 2);
                    for (int o = 0; o < whole.octaves(); ++o)
                        CHECK(seen[std::size_t(o)] == whole.level_height(o));
                    bands.rewind();
                }
            }
}

using DogSift = ism::Extractor<ism::DifferenceOfGaussians, ism::Sift>;
using HessianRoot = ism::Extractor<ism::HessianLaplace, ism::RootSift>;
using HessianBytes = ism::Extractor<ism::HessianLaplace, ism::ByteRootSift>;
using HarrisPatch = ism::Extractor<ism::HarrisLaplace, ism::GrayPatch>;
using DenseSift = ism::Extractor<ism::DenseGrid, ism::Sift>;

TEMPLATE_TEST_CASE("an image in bands gives the same bits as the whole", "", DogSift, HessianRoot,
                   HessianBytes, HarrisPatch, DenseSift) {
    using Extractor =
        ism::FeatureExtractor<typename TestType::DetectorType, typename TestType::DescriptorType>;
    const auto tall = texture(60, 400, 2), wide = texture(200, 140, 3);
    TestType plain, other;
    other.options = {.upsampling = 1.3, .oriented = true, .max_features = 200};
    other.options.scale_space.levels_per_octave = 2;
    if constexpr (requires { other.detector.scale_tolerance; }) other.detector.scale_tolerance = 1;
    for (const TestType& settings : {plain, other}) {
        std::array<Extractor, 2> extractors{Extractor(settings, 1, 1),
                                            Extractor(settings, 3, std::size_t(4) << 20)};
        for (const ism::GrayImage* image : {&tall, &wide, &tall}) {
            const auto whole = ism::extract(image->view(), settings);
            CHECK(whole.features.size() > 60);
            for (Extractor& extractor : extractors) CHECK(same_bits(whole, extractor.extract(image->view())));
        }
        const ism::Region region{5, 120, 50, 240};
        Extractor once(settings);
        const auto part = once.extract(tall.view(), region);
        CHECK(part.features.size() > 20);
        for (Extractor& extractor : extractors)
            CHECK(same_bits(part, extractor.extract(tall.view(), region)));
    }
}

TEMPLATE_TEST_CASE("bands give the same bits whatever the options", "", DogSift, HessianRoot, HarrisPatch) {
    ism::Random random(11);
    std::size_t found = 0;
    for (int round = 0; round < 12; ++round) {
        TestType settings;
        auto& space = settings.options.scale_space;
        space.levels_per_octave = 1 + int(random.uniform(0, 4));
        space.base_sigma = float(random.uniform(0.7, 3));
        space.double_first_octave = random.uniform() < 0.7;
        space.smallest_side = 3 + int(random.uniform(0, 12));
        settings.options.oriented = random.uniform() < 0.5;
        if constexpr (requires { settings.detector.scale_tolerance; })
            settings.detector.scale_tolerance = float(random.uniform(0.1, 1)), settings.detector.border = 0;
        const auto image =
            texture(16 + int(random.uniform(0, 60)), 150 + int(random.uniform(0, 350)), std::uint64_t(round));
        const auto bytes = std::size_t(random.uniform(1, 4e6));
        CAPTURE(round, image.width(), image.height(), bytes);
        ism::FeatureExtractor<typename TestType::DetectorType, typename TestType::DescriptorType> bands(
            settings, 2, bytes);
        const auto whole = ism::extract(image.view(), settings);
        CHECK(same_bits(whole, bands.extract(image.view())));
        found += whole.features.size();
    }
    CHECK(found > 500);
}
