// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/hog/fisher_vector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/image.hpp"
#include "ism/core/random.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/hog/describe_cells.hpp"
#include "ism/hog/hog_pyramid.hpp"
#include "ism/train/fit_patch_classifier.hpp"
#include "ism/train/fit_patch_mixture.hpp"
#include "ism/train/pyramid_workers.hpp"

namespace {

constexpr std::size_t gaussians = ism::PatchMixture::gaussians, axes = ism::patch_axes;

std::vector<float> random_numbers(std::size_t count, ism::Random& random, double least, double most) {
    std::vector<float> numbers(count);
    for (float& number : numbers) number = float(random.uniform(least, most));
    return numbers;
}

ism::PatchMixture random_mixture(ism::Random& random) {
    ism::PatchMixture mixture{.mean = random_numbers(ism::patch_numbers, random, 0, 0.3),
                              .axes = random_numbers(ism::patch_numbers * axes, random, -0.2, 0.2),
                              .weights = random_numbers(gaussians, random, 0.5, 1.5),
                              .means = random_numbers(gaussians * axes, random, -0.2, 0.2),
                              .spreads = random_numbers(gaussians * axes, random, 0.2, 0.6)};
    float total = 0;
    for (const float weight : mixture.weights) total += weight;
    for (float& weight : mixture.weights) weight /= total;
    return mixture;
}

/// The Fisher vector as Perronnin, Sánchez and Mensink (2010) write it, patch by patch in doubles.
std::vector<double> fisher_vector(const ism::PatchMixture& m, const std::vector<float>& cells,
                                  const ism::BoxGrid& grid) {
    std::vector<double> vector;
    for (int part = 0; part < 4; ++part) {
        std::vector<double> sums(2 * gaussians * axes, 0);
        for (int j = 0; j + 1 < grid.all_rows(); ++j)
            for (int i = 0; i + 1 < grid.all_columns(); ++i) {
                if (part > 0 && j * 3 / (grid.all_rows() - 1) != part - 1) continue;
                std::array<double, axes> patch{};
                for (std::size_t k = 0; k < ism::patch_numbers; ++k) {
                    const auto cell =
                        std::size_t((j + int(k / (2 * ism::cell_numbers))) * grid.all_columns() + i);
                    const double number =
                        double(cells[cell * ism::cell_numbers + k % (2 * ism::cell_numbers)]);
                    for (std::size_t d = 0; d < axes; ++d)
                        patch[d] += (number - double(m.mean[k])) * double(m.axes[k * axes + d]);
                }
                std::array<double, gaussians> density{};
                double total = 0;
                for (std::size_t g = 0; g < gaussians; ++g) {
                    density[g] = double(m.weights[g]);
                    for (std::size_t d = 0; d < axes; ++d) {
                        const double spread = double(m.spreads[g * axes + d]),
                                     apart = (patch[d] - double(m.means[g * axes + d])) / spread;
                        density[g] *= std::exp(-apart * apart / 2) / spread;
                    }
                    total += density[g];
                }
                for (std::size_t g = 0; g < gaussians; ++g)
                    for (std::size_t d = 0; d < axes; ++d) {
                        const double apart = (patch[d] - double(m.means[g * axes + d])) /
                                             double(m.spreads[g * axes + d]),
                                     weight = double(m.weights[g]), share = density[g] / total;
                        sums[2 * g * axes + d] += share * apart / std::sqrt(weight);
                        sums[(2 * g + 1) * axes + d] += share * (apart * apart - 1) / std::sqrt(2 * weight);
                    }
            }
        double sq_length = 0;
        for (double& sum : sums) {
            sum = std::copysign(std::sqrt(std::abs(sum)), sum);
            sq_length += sum * sum;
        }
        for (const double sum : sums) vector.push_back(sum / std::sqrt(4 * sq_length));
    }
    return vector;
}

/// Stripes (synthetic) that run down (class 0) or across (class 1), in a place of their own within the box.
ism::RgbImage stripes(std::uint32_t class_index, const ism::Box& box, ism::Random& random) {
    const auto gray = [](double value) {
        const auto v = std::uint8_t(value);
        return ism::Rgb{v, v, v};
    };
    ism::RgbImage image(120, 90);
    for (ism::Rgb& pixel : image.pixels()) pixel = gray(random.uniform(120, 136));
    const int left = int(box.x + random.uniform(0, 40)), top = int(box.y + random.uniform(0, 30));
    for (int y = top; y < top + 30; ++y)
        for (int x = left; x < left + 40; ++x)
            image(x, y) = gray((class_index == 0 ? x : y) / 4 % 2 == 0 ? 40 : 220);
    return image;
}

}  // namespace

TEST_CASE("a box of any aspect is cut into about as many square cells for patches") {
    for (const double aspect : {0.05, 0.2, 0.5, 1.0, 1.7, 3.0, 20.0, 1000.0}) {
        const ism::BoxGrid grid = ism::patch_grid({3, 4, 100 * aspect, 100});
        CAPTURE(aspect, grid.columns, grid.rows);
        CHECK(grid.columns >= 3);
        CHECK(grid.rows >= 3);
        CHECK(grid.columns * grid.rows >= 190);
        CHECK(grid.columns * grid.rows <= 260);
        if (aspect >= 0.2 && aspect <= 3)
            CHECK(double(grid.columns) / grid.rows == Approx(aspect).epsilon(0.15));
        CHECK(grid.ring);
    }
}

TEST_CASE("Fisher vectors of patches are those of the textbook") {
    ism::Random random(1);
    const ism::PatchMixture mixture = random_mixture(random);
    const ism::FisherEncoder encoder(mixture);
    for (const ism::Box& box : {ism::Box{0, 0, 40, 40}, {0, 0, 90, 30}, {0, 0, 4, 300}}) {
        const ism::BoxGrid grid = ism::patch_grid(box);
        const auto cells = random_numbers(grid.cells() * ism::cell_numbers, random, 0, 0.4);
        const auto vector = encoder.encode(cells, grid);
        const auto expected = fisher_vector(mixture, cells, grid);
        REQUIRE(vector.size() == ism::PatchMixture::vector_numbers);
        REQUIRE(expected.size() == vector.size());
        double sq_length = 0, most_apart = 0;
        for (std::size_t k = 0; k < vector.size(); ++k) {
            sq_length += double(vector[k]) * double(vector[k]);
            most_apart = std::max(most_apart, std::abs(double(vector[k]) - expected[k]));
        }
        CHECK(sq_length == Approx(1).epsilon(1e-5));
        CHECK(most_apart < 2e-3);  // shares below 1/1000 are left out
    }
}

TEST_CASE("eigenvectors of a symmetric matrix, that of most variance first") {
    constexpr std::size_t size = 20;
    ism::Random random(2);
    std::vector<double> matrix(size * size);
    for (std::size_t i = 0; i < size; ++i)
        for (std::size_t j = 0; j <= i; ++j) matrix[i * size + j] = matrix[j * size + i] = random.normal();
    const auto vectors = ism::detail::eigenvectors(matrix, size);
    REQUIRE(vectors.size() == size * size);
    double before = 1e9;
    for (std::size_t v = 0; v < size; ++v) {
        const double* vector = &vectors[v * size];
        std::vector<double> image(size, 0);
        double value = 0;
        for (std::size_t i = 0; i < size; ++i) {
            for (std::size_t j = 0; j < size; ++j) image[i] += matrix[i * size + j] * vector[j];
            value += vector[i] * image[i];
        }
        for (std::size_t i = 0; i < size; ++i) CHECK(std::abs(image[i] - value * vector[i]) < 1e-8);
        CHECK(value <= before);
        before = value;
        for (std::size_t w = 0; w <= v; ++w) {
            double product = 0;
            for (std::size_t i = 0; i < size; ++i) product += vector[i] * vectors[w * size + i];
            CHECK(std::abs(product - (v == w ? 1 : 0)) < 1e-9);
        }
    }
    CHECK(ism::detail::eigenvectors({1, 0, 0, 2}, 2) == std::vector<double>{0, 1, 1, 0});
}

TEST_CASE("each group of patches gets Gaussians of its own") {
    // three groups of patches, one of them twice as often as each other
    ism::Random random(3);
    std::vector<std::vector<float>> centres;
    for (int c = 0; c < 3; ++c) centres.push_back(random_numbers(ism::patch_numbers, random, 0, 0.4));
    std::vector<float> patches;
    constexpr std::size_t count = 2000;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < ism::patch_numbers; ++k)
            patches.push_back(centres[i % 4 % 3][k] + float(0.02 * random.normal()));
    const ism::PatchMixture mixture = ism::fit_patch_mixture(patches);
    const ism::PatchPlacer place(mixture);
    double total = 0;
    for (const float weight : mixture.weights) total += double(weight);
    CHECK(total == Approx(1).epsilon(1e-5));
    std::array<std::array<double, gaussians>, 3> shares{};  // of each group, its patches' in each Gaussian
    for (std::size_t i = 0; i < count; ++i) {
        const auto at = place(ism::reduce_patch(
            mixture, {patches.data() + i * ism::patch_numbers, ism::patch_numbers}, 2, 0, 0));
        for (std::size_t g = 0; g < gaussians; ++g) shares[i % 4 % 3][g] += double(at.share[g]);
    }
    std::array<double, 3> weights{};
    for (std::size_t g = 0; g < gaussians; ++g) {
        // a Gaussian that has patches has those of one group
        const double sum = shares[0][g] + shares[1][g] + shares[2][g];
        if (sum < 5) continue;
        const std::size_t group = shares[0][g] > sum / 2 ? 0 : shares[1][g] > sum / 2 ? 1 : 2;
        CHECK(shares[group][g] > 0.99 * sum);
        weights[group] += double(mixture.weights[g]);
    }
    CHECK(weights[0] == Approx(0.5).margin(0.02));
    CHECK(weights[1] == Approx(0.25).margin(0.02));
    CHECK(weights[2] == Approx(0.25).margin(0.02));
    CHECK(ism::fit_patch_mixture(patches) == mixture);
    CHECK_THROWS_WITH(ism::fit_patch_mixture({}), "patches to fit a mixture to: expected 1 or more, got 0");
    const ism::PatchMixture one = ism::fit_patch_mixture({patches.data(), ism::patch_numbers});
    for (const float spread : one.spreads) CHECK(spread > 0);  // one patch does for a mixture, if a poor one
}

TEST_CASE("patches tell classes apart wherever in the box they lie") {
    ism::Random random(4);
    const ism::Box box{20, 10, 80, 60}, other{60, 40, 40, 30}, corner{2, 2, 30, 20};
    std::vector<ism::RgbImage> pixels;
    std::vector<ism::TemplateImage> images;
    for (std::uint32_t i = 0; i < 16; ++i) pixels.push_back(stripes(i % 2, box, random));
    for (std::uint32_t i = 0; i < 16; ++i)
        images.push_back({.color = pixels[i], .labels = {{i % 2, box}}, .proposals = {{1 - i % 2, box}}});
    ism::PyramidWorkers one(1), two(2);
    const auto mixture = ism::fit_patch_mixture(ism::detail::sampled_patches(images, one));
    const auto fitted = [&](ism::PyramidWorkers& workers) {
        const ism::detail::PatchDescriber describer(mixture, images, 2);
        std::vector<ism::detail::PatchRows> parts(2 * images.size());
        workers.for_each(images.size(), [&](std::size_t i, ism::HogPyramid& pyramid) {
            ism::ThreadPool single(1);
            pyramid.assign(pixels[i], ism::HogPyramid::finest, single);
            parts[2 * i] = describer.objects(i, pyramid);
            parts[2 * i + 1] = describer.others(i, std::vector{other, corner}, 1, pyramid);
        });
        std::vector<const ism::detail::PatchRows*> rows;
        for (const auto& part : parts) rows.push_back(&part);
        return ism::detail::fit_patch_classifier(rows, mixture, 2, workers.pool());
    };
    const ism::PatchClassifier classifier = fitted(one);
    const ism::FisherEncoder encoder(classifier.mixture);
    ism::CellScratch scratch;
    ism::ThreadPool pool(1);
    for (std::uint32_t i = 0; i < 8; ++i) {
        const ism::HogPyramid pyramid(stripes(i % 2, box, random), ism::HogPyramid::finest, pool);
        const auto vector = encoder.encode(pyramid, box, scratch);
        const double own = classifier.margin(i % 2, vector);
        CHECK(own > classifier.margin(1 - i % 2, vector) + 0.5);
        CHECK(own > classifier.margin(i % 2, encoder.encode(pyramid, corner, scratch)) + 0.5);
    }
    CHECK(mixture == ism::fit_patch_mixture(ism::detail::sampled_patches(images, two)));
    CHECK(classifier == fitted(two));
}
