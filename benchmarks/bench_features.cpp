// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// Time of each stage of the features by image size, one thread: blur, scale space, detection, orientation,
// description, and all of them together.
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "support/catch.hpp"
#include "support/our_features.hpp"

#include "ism/core/random.hpp"
#include "ism/feature/blur.hpp"
#include "ism/feature/extract.hpp"
#include "ism/feature/orientation.hpp"

namespace {

/// Noise at all scales, as photographs have it (synthetic).
ism::GrayImage cloud(int width, int height) {
    ism::Random random(1);
    ism::GrayImage image(width, height, 0.5f);
    for (int cell = 128; cell >= 2; cell /= 2) {
        ism::GrayImage grid(width / cell + 2, height / cell + 2);
        for (float& value : grid.pixels()) value = float(random.uniform(-0.08, 0.08));
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                image(x, y) +=
                    ism::sample_bilinear(grid.view(), float(x) / float(cell), float(y) / float(cell));
    }
    return image;
}

}  // namespace

TEST_CASE("features by stage", "[benchmark]") {
    for (const auto& [width, height] : {std::pair{320, 240}, {640, 480}, {1280, 960}}) {
        const std::string size = ism::join_text(" ", width, "x", height);
        const ism::GrayImage image = cloud(width, height);
        ism::GrayImage blurred(width, height);
        ism::Workspace workspace;
        ism::ScaleSpace space;
        space.build(image.view(), {}, workspace);
        const ism::DifferenceOfGaussians dog;
        const auto features = dog.detect(space, workspace);
        const auto oriented = ism::assign_orientations(space, features, workspace);
        const std::string count = ism::join_text(", ", oriented.size(), " features");
        const auto timed = [&](const auto& detector) {
            auto found = detector.detect(space, workspace);
            const std::size_t number = found.size();
            workspace.reuse(std::move(found));
            return number;
        };

        BENCHMARK("blur, sigma 1.6" + size) {
            ism::blur(image.view(), workspace.kernel(1.6), blurred.view(), workspace);
            return blurred(0, 0);
        };
        BENCHMARK("scale space" + size) {
            space.build(image.view(), {}, workspace);
            return space.octaves();
        };
        BENCHMARK("difference of Gaussians" + size) {
            return timed(dog);
        };
        BENCHMARK("Hessian-Laplace" + size) {
            return timed(ism::HessianLaplace{});
        };
        BENCHMARK("Harris-Laplace" + size) {
            return timed(ism::HarrisLaplace{});
        };
        BENCHMARK("orientation" + size + count) {
            auto found = ism::assign_orientations(space, features, workspace);
            const std::size_t number = found.size();
            workspace.reuse(std::move(found));
            return number;
        };
        ism::FeatureExtractor<ism::HessianLaplace, ism::RootSift> hessian;
        BENCHMARK("all of Hessian-Laplace and RootSIFT" + size) {
            return hessian.extract(image.view()).features.size();
        };
        ism::FeatureExtractor<ism::DifferenceOfGaussians, ism::Sift> blobs;
        BENCHMARK("all of difference of Gaussians and SIFT" + size) {
            return blobs.extract(image.view()).features.size();
        };
        std::vector<float> row(ism::Sift::dimension);
        const std::span<float, ism::Sift::dimension> out(row.data(), row.size());
        BENCHMARK("SIFT" + size + count) {
            for (const ism::Feature& f : oriented) ism::Sift{}.describe(space, f, out);
            return out[0];
        };
    }
}
