// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include "support/catch.hpp"

#include "ism/cluster/cluster.hpp"
#include "ism/cluster/growing_clusters.hpp"
#include "ism/core/random.hpp"

namespace {

std::vector<float> random_points(std::size_t count, std::size_t dimension, ism::Random& random) {
    std::vector<float> values;
    for (std::size_t i = 0; i < count; ++i) {
        const double centre = double(random.index(6));
        for (std::size_t k = 0; k < dimension; ++k)
            values.push_back(float((centre == double(k % 6) ? 1.0 : 0.0) + 0.3 * random.normal()));
    }
    return values;
}

/// The closest two clusters merge, again and again, up to a distance; each is a list of numbers of starts.
std::vector<std::uint32_t> naive_labels(const ism::ClusterMoments& start, double max_sq_distance) {
    struct One {
        std::vector<double> mean;
        double mean_sq_length, size;
        std::vector<std::size_t> starts;
    };
    std::vector<One> clusters;
    for (std::size_t i = 0; i < start.size(); ++i) {
        const auto mean = start.means.subspan(i * start.dimension, start.dimension);
        clusters.push_back(
            {{mean.begin(), mean.end()}, start.mean_sq_lengths[i], double(start.sizes[i]), {i}});
    }
    while (clusters.size() > 1) {
        double best = std::numeric_limits<double>::infinity();
        std::size_t best_a = 0, best_b = 0;
        for (std::size_t a = 0; a < clusters.size(); ++a)
            for (std::size_t b = a + 1; b < clusters.size(); ++b) {
                const double dot = std::inner_product(clusters[a].mean.begin(), clusters[a].mean.end(),
                                                      clusters[b].mean.begin(), 0.0);
                const double d = clusters[a].mean_sq_length + clusters[b].mean_sq_length - 2 * dot;
                if (d < best) best = d, best_a = a, best_b = b;
            }
        if (best > max_sq_distance) break;
        One& a = clusters[best_a];
        const One& b = clusters[best_b];
        const double share = b.size / (a.size + b.size);
        for (std::size_t k = 0; k < a.mean.size(); ++k) a.mean[k] += share * (b.mean[k] - a.mean[k]);
        a.mean_sq_length += share * (b.mean_sq_length - a.mean_sq_length);
        a.size += b.size;
        a.starts.insert(a.starts.end(), b.starts.begin(), b.starts.end());
        clusters.erase(clusters.begin() + std::ptrdiff_t(best_b));
    }
    for (One& one : clusters) std::sort(one.starts.begin(), one.starts.end());
    std::sort(clusters.begin(), clusters.end(),
              [](const One& a, const One& b) { return a.starts.front() < b.starts.front(); });
    std::vector<std::uint32_t> label(start.size());
    for (std::uint32_t c = 0; c < clusters.size(); ++c)
        for (const std::size_t i : clusters[c].starts) label[i] = c;
    return label;
}

ism::Clusters with_points(ism::Clusters clusters, std::span<const float> values) {
    for (std::size_t at = 0; at < values.size(); at += clusters.dimension) {
        const auto point = values.subspan(at, clusters.dimension);
        clusters.means.insert(clusters.means.end(), point.begin(), point.end());
        clusters.mean_sq_lengths.push_back(
            std::inner_product(point.begin(), point.end(), point.begin(), 0.0f));
        clusters.sizes.push_back(1);
    }
    return clusters;
}

}  // namespace

TEST_CASE("clusters grow by average link from the present ones and the new points on") {
    ism::Random random(31);
    for (const std::size_t dimension : {6u, 60u}) {
        const double cut = 0.12 * double(dimension);
        ism::Clusters present{.dimension = dimension};
        std::size_t total = 0;
        for (const std::size_t count : {250u, 0u, 1u, 120u, 40u}) {
            const std::vector<float> points = random_points(count, dimension, random);
            const auto grown = ism::add_points(present, points, cut, 1);
            CHECK(grown.clustering.label == naive_labels(with_points(present, points).moments(), cut));
            CHECK(grown.clustering.count == grown.clusters.size());
            CHECK(ism::add_points(present, points, cut, 3).clusters.means == grown.clusters.means);
            total += count;
            CHECK(std::accumulate(grown.clusters.sizes.begin(), grown.clusters.sizes.end(), 0u) == total);
            if (present.size() == 0)
                CHECK(grown.clustering.label == ism::cluster_average_link(points, dimension, cut).label);
            present = grown.clusters;
        }
        CHECK(present.size() > 50);
        CHECK(present.size() < total - 20);
    }
}

TEST_CASE("settled clusters are not compared with each other") {
    // three blocks of them: that they do not merge although they could tells that nobody looked
    std::vector<float> apart;
    for (std::size_t i = 0; i < 400; ++i) apart.push_back(float(i));
    const ism::ClusterMoments start{1, apart, {}, {}};
    const auto merges = [&](std::size_t settled) {
        return ism::trace_average_link(start, {.max_sq_distance = 1.5, .settled = settled}).merges.size();
    };
    CHECK(merges(0) > 100);
    CHECK(merges(400) == 0);
    CHECK_THROWS_AS(merges(401), ism::Error);
}

TEST_CASE("a point that is there already joins its copies") {
    ism::Clusters present{.dimension = 3};
    const std::vector<float> points{0.1f, 0.2f, 0.3f, 7, 8, 9, 0.1f, 0.2f, 0.3f};
    for (int round = 1; round < 4; ++round) {
        present = ism::add_points(present, points, 0).clusters;
        REQUIRE(present.size() == 2);
        CHECK(present.sizes == std::vector<std::uint32_t>{2 * std::uint32_t(round), std::uint32_t(round)});
        CHECK(std::equal(present.means.begin(), present.means.end(), points.begin()));
    }
}

TEST_CASE("growing refuses what does not fit") {
    const std::vector<float> three{1, 2, 3};
    CHECK_THROWS_AS(ism::add_points({}, three, 1), ism::Error);
    CHECK_THROWS_AS(ism::add_points({.dimension = 2}, three, 1), ism::Error);
    CHECK_THROWS_AS(ism::add_points({.dimension = 3}, three, -1), ism::Error);
    CHECK_THROWS_AS(ism::join_clusters({1, three, {}, {}}, {{0, 0}, 1}), ism::Error);
    CHECK_THROWS_AS(ism::join_clusters({}, {}), ism::Error);
    CHECK_THROWS_AS(ism::join_clusters({1, three, {}, {}}, {{0, 1, 0}, 1}), ism::Error);
}
