// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/train/linear_svm.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"

namespace {

struct Examples {
    std::size_t dimension = 20;
    std::vector<float> rows;
    std::vector<std::uint8_t> positive;
};

/// Two clouds that overlap.
Examples clouds(std::size_t count, std::uint64_t seed) {
    ism::Random random(seed);
    Examples all;
    for (std::size_t i = 0; i < count; ++i) {
        all.positive.push_back(i % 3 == 0);
        for (std::size_t k = 0; k < all.dimension; ++k)
            all.rows.push_back(float(random.normal() + (all.positive.back() && k < 4 ? 0.8 : 0)));
    }
    return all;
}

/// ½ |w|² + Σ C max(0, 1 − y f(x))²; the bias counts as a weight of bias_scale.
double objective(const Examples& all, const ism::LinearClassifier& fit,
                 const ism::LinearSvmOptions& options) {
    double sum = 0.5 * fit.bias * fit.bias / (options.bias_scale * options.bias_scale);
    for (const float w : fit.weights) sum += 0.5 * w * w;
    for (std::size_t i = 0; i < all.positive.size(); ++i) {
        double f = fit.bias;
        for (std::size_t k = 0; k < all.dimension; ++k)
            f += double(fit.weights[k]) * all.rows[i * all.dimension + k];
        const double slack = std::max(0.0, 1 - (all.positive[i] ? f : -f));
        sum += options.cost * (all.positive[i] ? options.positive_cost : 1) * slack * slack;
    }
    return sum;
}

}  // namespace

TEST_CASE("no step from the fitted classifier lowers its objective") {
    const Examples all = clouds(300, 1);
    const ism::LinearSvmOptions options{.cost = GENERATE(0.01, 0.05, 1.0),
                                        .positive_cost = GENERATE(1.0, 3.0),
                                        .tolerance = 1e-6,
                                        .max_rounds = 5000};
    const auto fit =
        ism::fit_linear_svm(ism::row_starts(all.rows, all.dimension), all.dimension, all.positive, options);
    const double best = objective(all, fit, options);
    ism::Random random(2);
    for (int step = 0; step < 200; ++step) {
        auto other = fit;
        const double length = std::pow(10, random.uniform(-3, 0));
        for (float& w : other.weights) w += float(length * random.normal());
        other.bias += length * random.normal();
        CHECK(objective(all, other, options) > best * (1 - 1e-4));  // weights are floats
    }
    // and the gradient vanishes along each weight
    for (std::size_t k = 0; k < all.dimension; ++k) {
        auto more = fit, less = fit;
        more.weights[k] += 1e-3f, less.weights[k] -= 1e-3f;
        CHECK(std::abs(objective(all, more, options) - objective(all, less, options)) < 1e-4 * best);
    }
}

TEST_CASE("the default tolerance is near the optimum, and the same examples give the same bits") {
    const Examples all = clouds(400, 3);
    const auto quick =
        ism::fit_linear_svm(ism::row_starts(all.rows, all.dimension), all.dimension, all.positive);
    const auto exact = ism::fit_linear_svm(ism::row_starts(all.rows, all.dimension), all.dimension,
                                           all.positive, {.tolerance = 1e-7, .max_rounds = 10000});
    CHECK(objective(all, quick, {}) < 1.001 * objective(all, exact, {}));
    CHECK(
        ism::fit_linear_svm(ism::row_starts(all.rows, all.dimension), all.dimension, all.positive).weights ==
        quick.weights);
}

TEST_CASE("rows of whole numbers give the classifier of the numbers that they stand for") {
    Examples all = clouds(200, 5);
    std::vector<std::int16_t> whole;
    for (float& number : all.rows) {
        whole.push_back(std::int16_t(std::lround(number * 512)));
        number = float(whole.back()) / 512;
    }
    const auto fit =
        ism::fit_linear_svm(ism::row_starts(all.rows, all.dimension), all.dimension, all.positive);
    const auto of_whole = ism::fit_linear_svm<std::int16_t>(ism::row_starts(whole, all.dimension),
                                                            all.dimension, all.positive, {.unit = 1 / 512.0});
    CHECK(of_whole.bias == Approx(fit.bias).epsilon(1e-3));
    for (std::size_t k = 0; k < all.dimension; ++k)
        CHECK(of_whole.weights[k] == Approx(fit.weights[k]).epsilon(1e-3).margin(1e-4));
}

TEST_CASE("examples of one kind give a classifier that says so") {
    Examples all = clouds(50, 4);
    std::fill(all.positive.begin(), all.positive.end(), std::uint8_t(0));
    const auto fit =
        ism::fit_linear_svm(ism::row_starts(all.rows, all.dimension), all.dimension, all.positive);
    CHECK(fit.bias < -0.9);
    CHECK(ism::fit_linear_svm({}, 5, {}).weights == std::vector<float>(5, 0));
}
