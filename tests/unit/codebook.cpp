// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/codebook/codebook.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/catch.hpp"

#include "ism/codebook/cluster.hpp"
#include "ism/codebook/information_gain.hpp"
#include "ism/core/random.hpp"

namespace {

using Points = std::vector<std::vector<double>>;

Points random_points(std::size_t count, std::size_t dimension, std::size_t centres, ism::Random& random) {
    Points middle(centres, std::vector<double>(dimension)), points;
    for (auto& m : middle)
        for (double& v : m) v = random.normal();
    for (std::size_t i = 0; i < count; ++i) {
        points.push_back(middle[random.index(centres)]);
        for (double& v : points.back()) v += 0.4 * random.normal();
    }
    return points;
}

std::vector<float> flat(const Points& points) {
    std::vector<float> values;
    for (const auto& p : points) values.insert(values.end(), p.begin(), p.end());
    return values;
}

double mean_sq_distance(const Points& points, const std::vector<std::size_t>& a,
                        const std::vector<std::size_t>& b) {
    double sum = 0;
    for (const std::size_t i : a)
        for (const std::size_t j : b)
            for (std::size_t k = 0; k < points[i].size(); ++k)
                sum += (points[i][k] - points[j][k]) * (points[i][k] - points[j][k]);
    return sum / double(a.size() * b.size());
}

/// Merges the closest two of all clusters, again and again, by the mean over all pairs of their points.
std::vector<std::uint32_t> naive_labels(const Points& points, double max_sq_distance) {
    std::vector<std::vector<std::size_t>> clusters;
    for (std::size_t i = 0; i < points.size(); ++i) clusters.push_back({i});
    while (clusters.size() > 1) {
        double best = std::numeric_limits<double>::infinity();
        std::size_t bi = 0, bj = 0;
        for (std::size_t i = 0; i < clusters.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (const double d = mean_sq_distance(points, clusters[i], clusters[j]); d < best)
                    best = d, bi = i, bj = j;
        if (best > max_sq_distance) break;
        clusters[bj].insert(clusters[bj].end(), clusters[bi].begin(), clusters[bi].end());
        clusters.erase(clusters.begin() + std::ptrdiff_t(bi));
    }
    for (auto& c : clusters) std::sort(c.begin(), c.end());
    std::sort(clusters.begin(), clusters.end());
    std::vector<std::uint32_t> label(points.size());
    for (std::uint32_t c = 0; c < clusters.size(); ++c)
        for (const std::size_t i : clusters[c]) label[i] = c;
    return label;
}

}  // namespace

TEST_CASE("clustering gives the clusters of merging the closest pair again and again") {
    ism::Random random(7);
    for (int trial = 0; trial < 20; ++trial) {
        const Points points = random_points(20 + 4 * std::size_t(trial), 5, 8, random);
        const auto values = flat(points);
        for (const double cut : {0.3, 1.0, 2.5, 6.0, 100.0}) {
            const auto naive = naive_labels(points, cut);
            for (const unsigned threads : {1u, 2u}) {
                const auto fast = ism::cluster_average_link(values, 5, cut, threads);
                CHECK(fast.label == naive);
                CHECK(fast.count == *std::max_element(naive.begin(), naive.end()) + 1);
            }
        }
    }
}

TEST_CASE("clustering puts equal points together and leaves nothing out") {
    const std::vector<float> values{1, 1, 5, 5, 1, 1, 5, 5, 9, 9};
    CHECK(ism::cluster_average_link(values, 2, 0).label == std::vector<std::uint32_t>{0, 1, 0, 1, 2});
    CHECK(ism::cluster_average_link(values, 2, 1e9).count == 1);
    CHECK(ism::cluster_average_link({}, 2, 1).count == 0);
}

TEST_CASE("clustering refuses what it cannot cluster") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_AS(ism::cluster_average_link(std::vector<float>{1, nan}, 1, 1), ism::Error);
    CHECK_THROWS_AS(ism::cluster_average_link(std::vector<float>{1, 2, 3}, 2, 1), ism::Error);
    CHECK_THROWS_AS(ism::cluster_average_link(std::vector<float>{1, 2}, 2, -1), ism::Error);
    CHECK_THROWS_AS(ism::cluster_average_link(std::vector<float>{1, 2}, 2, double(nan)), ism::Error);
}

TEST_CASE("a codebook holds the means of the clusters that are large enough") {
    ism::Descriptors<float, 2> descriptors(5);
    const std::vector<float> values{0, 0, 10, 10, 0, 1, 10, 11, 50, 50};
    std::copy(values.begin(), values.end(), descriptors.values().begin());
    const auto codebook = ism::build_codebook(descriptors, 2.0, 2);
    REQUIRE(codebook.size() == 2);
    CHECK(codebook.words.row(0)[1] == Approx(0.5));
    CHECK(codebook.words.row(1)[0] == Approx(10));
    CHECK(ism::build_codebook(descriptors, 2.0, 1).size() == 3);
    CHECK_THROWS_WITH(ism::build_codebook(descriptors, 2.0, 3),
                      Catch::Contains("at least 3 features") && Catch::Contains("at most 2"));
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
