// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// Prints a number that changes with every bit of what is computed from a picture (synthetic): its features,
// and the cells of a box with their Fisher vector.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>
#include <vector>

#include "ism/core/image.hpp"
#include "ism/core/random.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/feature/extract.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"
#include "ism/hog/describe_cells.hpp"
#include "ism/hog/fisher_vector.hpp"
#include "ism/hog/hog_pyramid.hpp"
#include "ism/model_file/tensor_checksum.hpp"

namespace {

[[nodiscard]] ism::RgbImage blots(int width, int height, ism::Random& random) {
    ism::RgbImage picture(width, height);
    for (int blot = 0; blot < 200; ++blot) {
        const auto x0 = int(random.index(std::uint64_t(width))),
                   y0 = int(random.index(std::uint64_t(height))), side = 4 + int(random.index(40));
        const auto level = std::uint8_t(random.index(256)), tint = std::uint8_t(random.index(256));
        for (int y = y0; y < std::min(y0 + side, height); ++y)
            for (int x = x0; x < std::min(x0 + side, width); ++x) picture(x, y) = {level, tint, level};
    }
    return picture;
}

}  // namespace

int main() {
    ism::Random random(1);
    const ism::RgbImage picture = blots(160, 120, random);
    ism::detail::Checksum sum;
    const auto add = [&](std::span<const float> values) { sum.add(values.data(), values.size_bytes()); };

    ism::FeatureExtractor<ism::HessianLaplace, ism::RootSift> extractor({}, 1);
    const auto& set = extractor.extract(ism::to_gray(picture).view());
    for (std::size_t i = 0; i < set.features.size(); ++i) {
        const ism::Feature& f = set.features[i];
        add(std::array{f.x, f.y, f.scale});
        add(set.descriptors.row(i));
    }

    ism::PatchMixture mixture;
    const auto fill = [&](std::vector<float>& numbers, std::size_t count, double low, double high) {
        for (std::size_t i = 0; i < count; ++i) numbers.push_back(float(random.uniform(low, high)));
    };
    constexpr std::size_t gaussians = ism::PatchMixture::gaussians, axes = ism::patch_axes;
    fill(mixture.mean, ism::patch_numbers, 0, 0.2);
    fill(mixture.axes, ism::patch_numbers * axes, -0.1, 0.1);
    fill(mixture.weights, gaussians, 0.5, 1);
    fill(mixture.means, gaussians * axes, -0.1, 0.1);
    fill(mixture.spreads, gaussians * axes, 0.1, 0.2);
    ism::ThreadPool pool(1);
    ism::HogPyramid pyramid;
    pyramid.assign(picture, 0, pool);
    ism::CellScratch scratch;
    add(ism::FisherEncoder(mixture).encode(pyramid, {13.3, 7.1, 101.7, 88.9}, scratch));
    add(scratch.cells);

    std::printf("%zu features, %s\n", set.features.size(), sum.text().c_str());
}
