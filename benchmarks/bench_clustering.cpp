// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// Time of average-link clustering by number of points, one thread: the whole dendrogram, and cut where most
// points have found others, and points added to clusters.
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "support/catch.hpp"

#include "ism/cluster/cluster.hpp"
#include "ism/cluster/growing_clusters.hpp"
#include "ism/core/random.hpp"

namespace {

/// Points around centres that lie in a few of many dimensions, much as descriptors do (synthetic).
std::vector<float> synthetic_points(std::size_t count, std::size_t dimension) {
    ism::Random random(1);
    std::vector<float> values;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < dimension; ++k) values.push_back(float(random.normal() / double(k + 4)));
    return values;
}

}  // namespace

TEST_CASE("clustering by size", "[benchmark]") {
    constexpr std::size_t dimension = 128;
    for (const std::size_t count : {500u, 2000u, 8000u}) {
        const std::vector<float> all = synthetic_points(count + 500, dimension);
        const auto values = std::span(all).first(count * dimension);
        const ism::ClusterMoments points{dimension, values, {}, {}};
        const ism::MergeTrace trace = ism::trace_average_link(points, {}, 1);
        const double cut = trace.merges[trace.merges.size() * 3 / 4].sq_distance;
        const std::string size = " of " + std::to_string(count) + " points";
        BENCHMARK("full dendrogram" + size) {
            return ism::trace_average_link(points, {}, 1).merges.size();
        };
        BENCHMARK("three quarters of the merges" + size) {
            return ism::trace_average_link(points, {.max_sq_distance = cut}, 1).merges.size();
        };
        BENCHMARK("cutting a trace" + size) {
            return ism::cut(trace, cut).count;
        };
        const ism::Clusters clusters = ism::add_points({.dimension = dimension}, values, cut, 1).clusters;
        BENCHMARK("adding 500 points to " + std::to_string(clusters.size()) + " clusters") {
            return ism::add_points(clusters, std::span(all).subspan(count * dimension), cut, 1)
                .clusters.size();
        };
    }
}
