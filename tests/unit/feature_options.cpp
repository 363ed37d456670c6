// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/noise.hpp"

#include "ism/core/random.hpp"
#include "ism/feature/byte_sift.hpp"
#include "ism/feature/dense_grid.hpp"
#include "ism/feature/difference_of_gaussians.hpp"
#include "ism/feature/extract.hpp"
#include "ism/feature/gray_patch.hpp"
#include "ism/feature/harris_laplace.hpp"
#include "ism/feature/hessian_laplace.hpp"

using ism::test::noise;

namespace {

template <class T>
T next_below(T value) {
    if constexpr (std::is_integral_v<T>) return value - 1;
    return T(std::nextafter(value, -std::numeric_limits<T>::infinity()));
}
template <class T>
T next_above(T value) {
    if constexpr (std::is_integral_v<T>) return value + 1;
    return T(std::nextafter(value, std::numeric_limits<T>::infinity()));
}

template <class Options>
std::string refusal(const Options& options) {
    try {
        check(options);
    } catch (const ism::Error& error) {
        return error.what();
    }
    return "";
}

/// The two ends of a field's range pass; the next values outside, NaN and the infinities are refused by name.
template <class Options, class T>
void check_field(T Options::*field, const std::string& name, T low, T high, Options options = {}) {
    CAPTURE(name);
    CHECK(refusal(options) == "");
    const auto with = [&](T value) {
        Options other = options;
        other.*field = value;
        return refusal(other);
    };
    CHECK(with(low) == "");
    CHECK(with(high) == "");
    std::vector<T> outside{next_below(low), next_above(high), std::numeric_limits<T>::max(),
                           std::numeric_limits<T>::lowest()};
    if constexpr (std::is_floating_point_v<T>)
        for (const T value : {std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::infinity(),
                              -std::numeric_limits<T>::infinity()})
            outside.push_back(value);
    for (const T value : outside) {
        CAPTURE(value);
        CHECK(with(value) == ism::join_text(name, ": expected ", low, " to ", high, ", got ", value));
    }
}

}  // namespace

TEST_CASE("every option has a range, and what lies outside is refused by name") {
    using Space = ism::ScaleSpaceOptions;
    check_field(&Space::levels_per_octave, "levels_per_octave", 1, 32);
    check_field(&Space::base_sigma, "base_sigma (pixels)", 0.5f, 16.0f);
    check_field(&Space::input_sigma, "input_sigma (pixels)", 0.0f, 16.0f);
    check_field(&Space::max_octaves, "max_octaves", 1, 32);
    check_field(&Space::smallest_side, "smallest_side (pixels)", 3, 65536);
    check_field(&ism::ExtractOptions::upsampling, "upsampling", 0.0625, 16.0);
    using Orientation = ism::OrientationOptions;
    check_field(&Orientation::window, "orientation window (scales)", 0.1f, 16.0f);
    check_field(&Orientation::peak_ratio, "orientation peak_ratio", 0.01f, 1.0f);
    check_field(&Orientation::max_peaks, "orientation max_peaks", 1, 18);
    using Dog = ism::DifferenceOfGaussians;
    check_field(&Dog::contrast_threshold, "contrast_threshold", 0.0f, 1e6f);
    check_field(&Dog::edge_ratio, "edge_ratio", 1.0f, 1e9f);
    check_field(&Dog::border, "border (pixels)", 1, 65536);
    using Hessian = ism::HessianLaplace;
    check_field(&Hessian::threshold, "Hessian threshold", 0.0f, 1e6f);
    check_field(&Hessian::least_laplacian, "least_laplacian", 0.0f, 1e6f);
    check_field(&Hessian::scale_tolerance, "scale_tolerance (octaves)", 0.01f, 1.0f);
    check_field(&Hessian::border, "border (pixels)", 0, 65536);
    using Harris = ism::HarrisLaplace;
    check_field(&Harris::threshold, "Harris threshold", 0.0f, 1e6f);
    check_field(&Harris::alpha, "Harris alpha", 0.0f, 0.25f);
    check_field(&Harris::least_laplacian, "least_laplacian", 0.0f, 1e6f);
    check_field(&Harris::scale_tolerance, "scale_tolerance (octaves)", 0.01f, 1.0f);
    check_field(&Harris::border, "border (pixels)", 0, 65536);
    using Grid = ism::DenseGrid;
    check_field(&Grid::spacing, "grid spacing (scales)", 0.01f, 1000.0f, {.first_scale = 100});
    check_field(&Grid::margin, "grid margin (scales)", 0.0f, 1000.0f);
    check_field(&Grid::first_scale, "first_scale (pixels)", 0.1f, 10000.0f, {.spacing = 6});
    check_field(&Grid::scale_factor, "scale_factor", 1.01f, 16.0f);
    check_field(&Grid::scale_count, "scale_count", 1, 64);
    CHECK(refusal(Grid{.spacing = 0.1f, .first_scale = 2}) ==
          "grid spacing at the first scale (pixels): expected 0.5 or more, got 0.2");
}

namespace mine {

struct Corner {  // without a check of its own
    static constexpr std::string_view name = "corner";
    [[nodiscard]] std::vector<ism::Feature> detect(const ism::ScaleSpace&, ism::Workspace&) const {
        return {{.x = 9, .y = 9, .scale = 2}};
    }
};

struct Weighed : ism::Sift {
    float weight = 1;
    friend void check(const Weighed& options) {
        ism::expect(options.weight > 0, "weight", "above 0", options.weight);
    }
};

}  // namespace mine

TEST_CASE("an extractor is validated as a whole; own types need no check but may have one") {
    ism::Extractor<mine::Corner, mine::Weighed> extractor;
    CHECK(refusal(extractor) == "");
    CHECK(ism::extract(noise(20, 20, 1).view(), extractor).features.size() == 1);
    extractor.options.scale_space.base_sigma = NAN;
    CHECK(refusal(extractor) == "base_sigma (pixels): expected 0.5 to 16, got nan");
    extractor.options.scale_space = {};
    extractor.descriptor.weight = 0;
    CHECK(refusal(extractor) == "weight: expected above 0, got 0");
    CHECK_THROWS_WITH(ism::extract(noise(20, 20, 1).view(), extractor), "weight: expected above 0, got 0");
    CHECK(refusal(ism::Extractor<ism::DenseGrid, ism::GrayPatch>{.detector = {.margin = -1}}) ==
          "grid margin (scales): expected 0 to 1000, got -1");
}

TEMPLATE_TEST_CASE("the widest search over scale stays within the octaves", "", ism::HessianLaplace,
                   ism::HarrisLaplace) {
    ism::Workspace workspace;
    ism::ScaleSpace space;
    const auto image = noise(70, 60, 5);
    for (const int levels : {1, 2, 3, 7}) {
        space.build(image.view(), {.levels_per_octave = levels}, workspace);
        TestType detector;
        detector.scale_tolerance = 1, detector.threshold = 0, detector.border = 0;
        CAPTURE(levels);
        const auto found = detector.detect(space, workspace);
        CHECK(!found.empty());
        for (const ism::Feature& f : found) {
            REQUIRE(std::isfinite(f.scale));
            CHECK(f.scale > 0.2f);
            CHECK(f.scale < 200);
        }
    }
}

TEMPLATE_TEST_CASE("a border wider than the image leaves no features", "", ism::DifferenceOfGaussians,
                   ism::HessianLaplace, ism::HarrisLaplace) {
    ism::Workspace workspace;
    ism::ScaleSpace space;
    const auto image = noise(70, 60, 5);
    space.build(image.view(), {}, workspace);
    TestType detector;
    for (const int border : {60, 70, 65536}) {
        detector.border = border;
        CHECK(detector.detect(space, workspace).empty());
    }
    detector.border = std::numeric_limits<int>::max();
    CHECK_THROWS_WITH(
        detector.detect(space, workspace),
        "border (pixels): expected " + std::to_string(TestType::name == "dog") + " to 65536, got 2147483647");
}

TEST_CASE("brightness of another unit is refused with its place, by extractor and scale space") {
    auto image = noise(40, 30, 6);
    for (const float value : {3e38f, -3e38f, 4.1f, INFINITY, NAN}) {
        image(7, 29) = value;
        const std::string message =
            ism::join_text("image brightness at (7, 29): expected 0 to 1 (accepted: -4 to 4), got ", value);
        CHECK_THROWS_WITH((ism::extract(image.view(), ism::Extractor<ism::HessianLaplace, ism::Sift>{})),
                          message);
        CHECK_THROWS_WITH(ism::ScaleSpace().build(image.view()), message);
    }
    image(7, 29) = 4, image(8, 29) = -4;
    CHECK_NOTHROW(ism::extract(image.view(), ism::Extractor<ism::HessianLaplace, ism::Sift>{}));
}

TEST_CASE("a feature that is nowhere has a descriptor of zeros") {
    ism::ScaleSpace space;
    space.build(noise(40, 40, 2).view());
    std::array<float, 128> row;
    for (const float value : {NAN, INFINITY, -INFINITY, 3e38f, -3e38f})
        for (float ism::Feature::*field : {&ism::Feature::x, &ism::Feature::y, &ism::Feature::scale}) {
            ism::Feature f{.x = 20, .y = 20, .scale = 2};
            f.*field = value;
            if (field == &ism::Feature::scale && value < 0) continue;
            row.fill(1);
            ism::Sift{}.describe(space, f, row);
            CHECK(std::count(row.begin(), row.end(), 0.0f) == 128);
        }
    ism::Sift{}.describe(space, {.x = 20, .y = 20, .scale = 2, .angle = NAN}, row);
    CHECK(std::count(row.begin(), row.end(), 0.0f) == 128);
}

TEST_CASE("resized images have a largest size") {
    ism::Workspace workspace;
    const ism::GrayImage wide(65536, 16, 0.5f);
    CHECK_THROWS_WITH(ism::resized(wide.view(), 16, 0.5f, workspace),
                      "pixels of the resized image: expected at most 1.34218e+08, got 1.04856e+06x241");
    CHECK(ism::resized(noise(256, 256, 1).view(), 1.0 / 16, 16, workspace).width() == 16);
    for (const double factor : {1e-9, 0.06, 16.1, 1e9, double(NAN)})
        CHECK_THROWS_WITH(ism::resized(wide.view(), factor, 0.5f, workspace),
                          ism::join_text("resize factor: expected 0.0625 to 16, got ", factor));
}

namespace {

/// An image of one of the kinds that are hard on a detector.
ism::GrayImage hard_image(ism::Random& random) {
    const int width = 16 + int(random.uniform(0, 64)), height = 16 + int(random.uniform(0, 64));
    ism::GrayImage image(width, height, float(random.uniform(0, 1)));
    const int kind = int(random.uniform(0, 5));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            float& value = image(x, y);
            if (kind == 1) value = float((x / 3 + y / 3) % 2);
            if (kind == 2) value = (x + y) % 2 == 0 ? ism::max_brightness : -ism::max_brightness;
            if (kind == 3) value = float(random.uniform());
            if (kind == 4) value = x == width / 2 && y == height / 2 ? ism::max_brightness : 1e-40f;
        }
    return image;
}

template <class D>
void randomise(ism::Random& random, D& detector) {
    const auto one_of = [&](float a, float b, float c) {
        const double k = random.uniform(0, 3);
        return k < 1 ? a : k < 2 ? b : c;
    };
    if constexpr (requires { detector.threshold; }) {
        detector.threshold = one_of(0, 1e-6f, 1);
        detector.scale_tolerance = one_of(0.01f, 0.5f, 1);
        detector.least_laplacian = one_of(0, 0.005f, 1e6f);
    }
    if constexpr (requires { detector.edge_ratio; }) {
        detector.contrast_threshold = one_of(0, 0.01f, 1);
        detector.edge_ratio = one_of(1, 10, 1e9f);
    }
    if constexpr (requires { detector.alpha; }) detector.alpha = one_of(0, 0.06f, 0.25f);
    if constexpr (requires { detector.border; }) detector.border = int(one_of(1, 2, 30));
    if constexpr (requires { detector.spacing; }) {
        detector.spacing = one_of(3, 9, 1000), detector.margin = one_of(0, 2, 1000);
        detector.first_scale = one_of(1.5f, 4, 10000), detector.scale_factor = one_of(1.3f, 2, 16);
        detector.scale_count = int(one_of(1, 3, 64));
    }
}

}  // namespace

using GridPatch = ism::Extractor<ism::DenseGrid, ism::GrayPatch>;
using DogBytes = ism::Extractor<ism::DifferenceOfGaussians, ism::ByteSift>;
using HessianRoot = ism::Extractor<ism::HessianLaplace, ism::RootSift>;
using HarrisPatch = ism::Extractor<ism::HarrisLaplace, ism::GrayPatch>;

TEMPLATE_TEST_CASE("options within their ranges and any image give finite features of that image", "",
                   GridPatch, DogBytes, HessianRoot, HarrisPatch) {
    ism::Random random(17);
    std::size_t found = 0;
    for (int round = 0; round < 60; ++round) {
        TestType extractor;
        randomise(random, extractor.detector);
        auto& space = extractor.options.scale_space;
        space.levels_per_octave = 1 + int(random.uniform(0, 5));
        space.base_sigma = float(random.uniform(0.5, 4));
        space.input_sigma = float(random.uniform(0, 2));
        space.double_first_octave = random.uniform() < 0.5;
        space.smallest_side = 3 + int(random.uniform(0, 20));
        extractor.options.oriented = random.uniform() < 0.5;
        extractor.options.upsampling = random.uniform() < 0.5 ? 1 : random.uniform(1, 2);
        if (random.uniform() < 0.3) extractor.options.max_features = 10;
        const ism::GrayImage image = hard_image(random);
        CAPTURE(round, image.width(), image.height());
        const auto set = ism::extract(image.view(), extractor);
        REQUIRE(set.descriptors.size() == set.features.size());
        bool fine = true;
        for (const ism::Feature& f : set.features)
            fine = fine && f.x > -1 && f.y > -1 && f.x < float(image.width()) &&
                   f.y < float(image.height()) && f.scale > 0 && f.scale < 1e4f &&
                   std::fabs(f.angle) < 3.2f && f.strength >= 0 && std::isfinite(f.strength);
        for (const auto value : set.descriptors.values()) fine = fine && std::isfinite(float(value));
        CHECK(fine);
        found += set.features.size();
    }
    CHECK(found > 50);
}
