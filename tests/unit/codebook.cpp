// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/catch.hpp"

#include "ism/cluster/cluster.hpp"
#include "ism/codebook/build_codebook.hpp"
#include "ism/core/random.hpp"
#include "ism/train/information_gain.hpp"

TEST_CASE("a codebook holds the means of the clusters that are large enough") {
    const ism::Descriptors<float> descriptors(2, {0, 0, 10, 10, 0, 1, 10, 11, 50, 50});
    const auto codebook = ism::build_codebook(descriptors, 2.0, 2);
    REQUIRE(codebook.size() == 2);
    CHECK(codebook[0].mean[1] == Approx(0.5));
    CHECK(codebook[1].mean[0] == Approx(10));
    CHECK(ism::build_codebook(descriptors, 2.0, 1).size() == 3);
    CHECK_THROWS_WITH(ism::build_codebook(descriptors, 2.0, 3),
                      Catch::Contains("at least 3 features") && Catch::Contains("at most 2"));
}

TEST_CASE("words of several groups are added one after another, and some can be selected") {
    const ism::Descriptors<float> one(1, {0, 1, 10, 11}), two(1, {5, 5.5f, 5});
    ism::Codebook codebook(1, 2);
    ism::add_words(codebook, one, 2, 0);
    ism::add_words(codebook, two, 2, 3);
    REQUIRE(codebook.size() == 3);
    CHECK(codebook[2].group == 3);
    CHECK(codebook[2].size == 3);
    const std::vector<std::uint32_t> chosen{0, 2};
    const ism::Codebook some = codebook.select(chosen);
    REQUIRE(some.size() == 2);
    CHECK(some[1].mean[0] == codebook[2].mean[0]);
    CHECK(some[1].mean_sq_length == codebook[2].mean_sq_length);
    CHECK(some.max_sq_distance() == 2);
    CHECK_THROWS_WITH(ism::add_words(codebook, ism::Descriptors<float>(2, 4), 1),
                      Catch::Contains("dimension of descriptors: expected 1, got 2"));
}

TEST_CASE("information gain follows Eq 3 computed by hand") {
    // words × classes: w0 only class 0, w1 both alike
    const std::vector<double> counts{4, 0, 2, 2};
    const auto gain = ism::information_gain(counts, 2);
    REQUIRE(gain.size() == 2);
    CHECK(gain[0] == Approx(0.5 * (0.5 * std::log(0.5 / (0.5 * 0.75)))));
    CHECK(gain[1] ==
          Approx(0.5 * (0.25 * std::log(0.25 / (0.5 * 0.75)) + 0.25 * std::log(0.25 / (0.5 * 0.25)))));
    CHECK_THROWS_AS(ism::information_gain(std::vector<double>{1, -1}, 2), ism::Error);
    CHECK_THROWS_AS(ism::information_gain(std::vector<double>{1, 1, 1}, 2), ism::Error);
}
