// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "support/catch.hpp"

#include "ism/cluster/cluster.hpp"
#include "ism/core/random.hpp"

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Points {
    std::size_t dimension = 0;
    std::vector<float> values;
    [[nodiscard]] std::size_t size() const { return values.size() / dimension; }
    [[nodiscard]] ism::ClusterMoments moments() const {
        return {.dimension = dimension, .means = values, .mean_sq_lengths = {}, .sizes = {}};
    }
    [[nodiscard]] double sq_distance(std::size_t i, std::size_t j) const {
        double sum = 0;
        for (std::size_t k = 0; k < dimension; ++k) {
            const double d = double(values[i * dimension + k]) - double(values[j * dimension + k]);
            sum += d * d;
        }
        return sum;
    }
};

/// Points around some centres, all around `offset`; every tenth is a copy of an earlier one.
Points random_points(std::size_t count, std::size_t dimension, std::size_t centres, ism::Random& random,
                     double offset = 0) {
    std::vector<double> middle(centres * dimension);
    for (double& v : middle) v = offset + random.normal();
    Points points{dimension, {}};
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t centre = random.index(centres), copied = random.index(std::max<std::size_t>(i, 1));
        for (std::size_t k = 0; k < dimension; ++k)
            points.values.push_back(i % 10 == 9
                                        ? points.values[copied * dimension + k]
                                        : float(middle[centre * dimension + k] + 0.4 * random.normal()));
    }
    return points;
}

/// Those of the machine that runs this.
std::vector<ism::InstructionSet> instruction_sets() {
    std::vector<ism::InstructionSet> sets;
    for (const auto isa :
         {ism::InstructionSet::any, ism::InstructionSet::avx2, ism::InstructionSet::avx512_vnni})
        if (ism::has_instruction_set(isa)) sets.push_back(isa);
    return sets;
}

struct Naive {
    std::vector<double> heights;
    std::vector<std::vector<std::uint32_t>> labels;  ///< after so many merges
};

/// The mean of all distances between two clusters, kept in a matrix: the closest two merge, again and again.
Naive merge_closest(const Points& points) {
    const std::size_t n = points.size();
    std::vector<std::vector<double>> distance(n, std::vector<double>(n, infinity));
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            if (i != j) distance[i][j] = points.sq_distance(i, j);
    std::vector<double> size(n, 1);
    std::vector<std::uint32_t> cluster(n);
    for (std::size_t i = 0; i < n; ++i) cluster[i] = std::uint32_t(i);
    const auto numbered = [&] {
        std::map<std::uint32_t, std::uint32_t> number;
        std::vector<std::uint32_t> label;
        for (const std::uint32_t c : cluster) label.push_back(number.emplace(c, number.size()).first->second);
        return label;
    };
    Naive result{{}, {numbered()}};
    while (result.heights.size() + 1 < n) {
        std::size_t a = 0, b = 1;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = i + 1; j < n; ++j)
                if (distance[i][j] < distance[a][b]) a = i, b = j;
        result.heights.push_back(distance[a][b]);
        for (std::size_t i = 0; i < n; ++i)
            if (i != a && i != b)
                distance[a][i] = distance[i][a] =
                    (size[a] * distance[a][i] + size[b] * distance[b][i]) / (size[a] + size[b]);
        for (std::size_t i = 0; i < n; ++i) distance[b][i] = distance[i][b] = infinity;
        size[a] += size[b];
        std::replace(cluster.begin(), cluster.end(), std::uint32_t(b), std::uint32_t(a));
        result.labels.push_back(numbered());
    }
    return result;
}

ism::MergeTrace trace(const Points& points, double max_sq_distance = infinity, unsigned threads = 1) {
    return ism::trace_average_link(points.moments(), {.max_sq_distance = max_sq_distance}, threads);
}

/// Whether every merge of a full trace is of clusters no further apart than any others then are, at the
/// distance it tells: what is asked of a dendrogram where equal distances leave a choice.
void check_dendrogram(const Points& points, const ism::MergeTrace& trace) {
    REQUIRE(trace.points == points.size());
    REQUIRE(trace.merges.size() + 1 == std::max<std::size_t>(points.size(), 1));
    std::map<std::uint32_t, std::vector<std::size_t>> clusters;
    for (std::uint32_t i = 0; i < trace.points; ++i) clusters[i] = {i};
    const auto distance = [&](const std::vector<std::size_t>& a, const std::vector<std::size_t>& b) {
        double sum = 0;
        for (const std::size_t i : a)
            for (const std::size_t j : b) sum += points.sq_distance(i, j);
        return sum / double(a.size() * b.size());
    };
    std::uint32_t made = trace.points;
    for (const ism::Merge& merge : trace.merges) {
        double least = infinity;
        for (auto a = clusters.begin(); a != clusters.end(); ++a)
            for (auto b = std::next(a); b != clusters.end(); ++b)
                least = std::min(least, distance(a->second, b->second));
        REQUIRE(merge.first < merge.second);
        REQUIRE(clusters.count(merge.first) == 1);
        REQUIRE(clusters.count(merge.second) == 1);
        std::vector<std::size_t> both = clusters[merge.first];
        const std::vector<std::size_t> second = clusters[merge.second];
        const double own = distance(both, second);
        CHECK(own <= least + 1e-5 * (1 + least));
        CHECK(merge.sq_distance == Approx(own).epsilon(1e-5).margin(1e-6));
        both.insert(both.end(), second.begin(), second.end());
        CHECK(merge.size == both.size());
        clusters.erase(merge.first), clusters.erase(merge.second);
        clusters[made++] = both;
    }
}

}  // namespace

TEST_CASE("clustering gives the dendrogram of merging the closest pair again and again") {
    ism::Random random(7);
    for (const std::size_t dimension : {1u, 3u, 32u, 33u, 64u, 128u, 131u})
        for (const std::size_t count : {3u, 40u, 200u}) {
            const Points points = random_points(count, dimension, 8, random);
            const Naive naive = merge_closest(points);
            const ism::MergeTrace full = trace(points);
            REQUIRE(full.merges.size() + 1 == count);
            for (std::size_t t = 0; t + 1 < count; ++t) {
                CHECK(full.merges[t].sq_distance == Approx(naive.heights[t]).epsilon(1e-5).margin(1e-6));
                if (t + 2 < count && naive.heights[t + 1] < 1.0001 * naive.heights[t] + 1e-6) continue;
                const double height = t + 2 < count ? (naive.heights[t] + naive.heights[t + 1]) / 2 : 1e9;
                CHECK(ism::cut(full, height).label == naive.labels[t + 1]);
                if (t % 16 != 0) continue;
                const auto clusters = ism::cluster_average_link(points.values, dimension, height, 2);
                CHECK(clusters.label == naive.labels[t + 1]);
                CHECK(clusters.count == count - t - 1);
            }
        }
}

TEST_CASE("clustering far from the origin loses no more digits than the numbers have") {
    ism::Random random(3);
    const Points points = random_points(100, 40, 5, random, 1000);
    const Naive naive = merge_closest(points);
    const ism::MergeTrace full = trace(points);
    for (std::size_t t = 0; t < naive.heights.size(); ++t)
        CHECK(full.merges[t].sq_distance == Approx(naive.heights[t]).epsilon(1e-4));
}

TEST_CASE("a trace is the same for any number of threads, and stops where it is told to") {
    ism::Random random(5);
    for (const std::size_t dimension : {4u, 128u}) {
        const Points points = random_points(700, dimension, 30, random);
        const ism::MergeTrace one = trace(points, infinity, 1);
        CHECK(trace(points, infinity, 2).merges == one.merges);
        CHECK(trace(points, infinity, 5).merges == one.merges);
        for (const std::size_t merges : {0u, 1u, 300u, 650u}) {
            const double height = merges == 0 ? 0 : one.merges[merges - 1].sq_distance;
            const ism::MergeTrace lower = trace(points, height, 2);
            CHECK(lower.max_sq_distance == height);
            CHECK(std::all_of(lower.merges.begin(), lower.merges.end(),
                              [&](const ism::Merge& m) { return m.sq_distance <= height; }));
            CHECK(ism::cut(lower, height).label == ism::cut(one, height).label);
            CHECK_THROWS_AS(ism::cut(lower, height + 0.1), ism::Error);
        }
    }
}

TEST_CASE("equal distances are merged in some order of a dendrogram") {
    Points line{1, {}}, grid{2, {}}, corners{20, {}}, same{3, std::vector<float>(3 * 150, 4.5f)};
    for (int i = 0; i < 60; ++i) line.values.push_back(float(i));
    for (int i = 0; i < 49; ++i) grid.values.insert(grid.values.end(), {float(i % 7), float(i / 7)});
    for (std::size_t i = 0; i < 60; ++i)
        for (std::size_t k = 0; k < 20; ++k) corners.values.push_back(i % 20 == k ? 1.0f : 0.0f);
    for (const Points* points : {&line, &grid, &corners, &same}) {
        check_dendrogram(*points, trace(*points));
        CHECK(trace(*points, infinity, 3).merges == trace(*points).merges);
    }
    CHECK(ism::cluster_average_link(same.values, 3, 0).count == 1);
    CHECK(ism::cluster_average_link(corners.values, 20, 0).count == 20);
}

TEST_CASE("many equal points are no burden") {
    const Points same{16, std::vector<float>(16 * 3000, 0.25f)};
    CHECK(ism::cluster_average_link(same.values, 16, 0).count == 1);
    CHECK(trace(same).merges.back().sq_distance == 0);
}

TEST_CASE("clustering can start from clusters") {
    ism::Random random(11);
    const Points points = random_points(400, 40, 12, random);
    const ism::MergeTrace full = trace(points);
    const std::size_t done = 250;
    const double height = full.merges[done - 1].sq_distance;
    const ism::Clustering start = ism::cut(full, height);
    REQUIRE(start.count == points.size() - done);
    std::vector<float> means(start.count * points.dimension), squares(start.count);
    std::vector<std::uint32_t> sizes(start.count);
    for (const std::uint32_t label : start.label) ++sizes[label];
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t k = 0; k < points.dimension; ++k) {
            const float value = points.values[i * points.dimension + k], size = float(sizes[start.label[i]]);
            means[start.label[i] * points.dimension + k] += value / size;
            squares[start.label[i]] += value * value / size;
        }
    const ism::ClusterMoments moments{points.dimension, means, squares, sizes};
    const ism::MergeTrace rest = ism::trace_average_link(moments);
    REQUIRE(rest.merges.size() + 1 == start.count);
    CHECK(rest.merges.back().size == points.size());
    for (std::size_t t = 0; t < rest.merges.size(); ++t) {
        CHECK(rest.merges[t].sq_distance == Approx(full.merges[done + t].sq_distance).epsilon(1e-5));
        CHECK(rest.merges[t].size == full.merges[done + t].size);
    }
    const double later = full.merges[330].sq_distance * (1 + 1e-5);
    const auto from_clusters = ism::cut(rest, later), from_points = ism::cut(full, later);
    for (std::size_t i = 0; i < points.size(); ++i)
        CHECK(from_clusters.label[start.label[i]] == from_points.label[i]);
}

TEST_CASE("clustering puts equal points together and leaves nothing out") {
    const std::vector<float> values{1, 1, 5, 5, 1, 1, 5, 5, 9, 9};
    CHECK(ism::cluster_average_link(values, 2, 0).label == std::vector<std::uint32_t>{0, 1, 0, 1, 2});
    CHECK(ism::cluster_average_link(values, 2, 1e9).count == 1);
    CHECK(ism::cluster_average_link(values, 2, infinity).count == 1);
    CHECK(ism::cluster_average_link({}, 2, 1).count == 0);
    CHECK(ism::cluster_average_link(std::vector<float>{3, 4}, 2, 1).label == std::vector<std::uint32_t>{0});
    CHECK(trace({2, {}}).merges.empty());
    CHECK(trace({2, {3, 4}}).merges.empty());
    CHECK(trace({2, {3, 4, 0, 0}}).merges == std::vector<ism::Merge>{{0, 1, 2, 25}});
}

TEST_CASE("clustering refuses what it cannot cluster") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto cluster = [](const std::vector<float>& values, std::size_t dimension, double max_sq_distance) {
        return ism::cluster_average_link(values, dimension, max_sq_distance);
    };
    CHECK_THROWS_AS(cluster({1, nan}, 1, 1), ism::Error);
    CHECK_THROWS_AS(cluster({1, std::numeric_limits<float>::infinity()}, 1, 1), ism::Error);
    CHECK_THROWS_AS(cluster({1, 1e30f}, 1, 1), ism::Error);
    CHECK_THROWS_AS(cluster({1, 2, 3}, 2, 1), ism::Error);
    CHECK_THROWS_AS(cluster({1, 2, 3}, 0, 1), ism::Error);
    CHECK_THROWS_AS(cluster({1, 2}, 1, -1), ism::Error);
    CHECK_THROWS_AS(cluster({1, 2}, 1, double(nan)), ism::Error);

    const std::vector<float> means{1, 2}, squares{1, 4}, small{1, 3}, one{1};
    const std::vector<std::uint32_t> sizes{1, 2}, empty{1, 0}, huge{1, 4294967295u};
    using ism::trace_average_link;
    CHECK(trace_average_link({1, means, squares, sizes}).merges.size() == 1);
    CHECK_THROWS_AS(trace_average_link({1, means, small, sizes}), ism::Error);
    CHECK_THROWS_AS(trace_average_link({1, means, one, sizes}), ism::Error);
    CHECK_THROWS_AS(trace_average_link({1, means, std::vector<float>{1, nan}, sizes}), ism::Error);
    CHECK_THROWS_AS(trace_average_link({1, means, squares, empty}), ism::Error);
    CHECK_THROWS_AS(trace_average_link({1, means, squares, huge}), ism::Error);
    CHECK_THROWS_AS(trace_average_link({1, means, squares, std::span(sizes).first(1)}), ism::Error);
    CHECK_THROWS_AS(ism::cut({}, -1), ism::Error);
    CHECK_THROWS_AS(ism::cut({}, double(nan)), ism::Error);
    CHECK(ism::cut({}, 1).count == 0);
}

TEST_CASE("a search finds the nearest of all pairs that it is asked for") {
    using namespace ism::detail;
    ism::Random random(21);
    // so many that groups have several blocks, and few; without others, and with
    for (const auto& [count, asked] :
         {std::pair{6500u, 6500u}, {1000u, 5u}, {500u, 300u}, {17u, 17u}, {2u, 1u}}) {
        const Points points = random_points(count, 6, 40, random);
        for (const unsigned threads : {1u, 3u}) {
            ism::ThreadPool pool(threads);
            const ActiveClusters clusters(points.moments(), pool);
            NeighbourLists lists(count, 0.5f);
            std::vector<std::uint32_t> all = clusters.spatial_order();
            const std::span<const std::uint32_t> asking = std::span(all).first(asked);
            NeighbourSearch(clusters, lists, asking, std::span(all).subspan(asked)).run(pool);
            std::size_t wrong = 0;
            for (const std::uint32_t i : asking.first(std::min(asked, 500u))) {
                std::vector<float> distances;
                for (std::uint32_t j = 0; j < count; ++j)
                    if (const float d = clusters.sq_distance(i, j); j != i && d < 0.5f)
                        distances.push_back(d);
                std::sort(distances.begin(), distances.end());
                const std::size_t fit = std::min(distances.size(), NeighbourLists::capacity);
                wrong += lists.of(i).size() != fit;
                wrong += lists.sq_radius(i) != (fit < distances.size() ? distances[fit] : 0.5f);
                for (std::size_t k = 0; k < fit && k < lists.of(i).size(); ++k) {
                    wrong += lists.of(i)[k].sq_distance != distances[k];
                    wrong += lists.of(i)[k].sq_distance != clusters.sq_distance(i, lists.of(i)[k].cluster);
                }
            }
            CHECK(wrong == 0);
            for (const std::uint32_t j : std::span(all).subspan(asked)) CHECK(lists.of(j).empty());
        }
    }
}

TEST_CASE("pruning lets pass what is near, whatever processor it runs on") {
    using namespace ism::detail;
    ism::Random random(9);
    const auto normal = [&](std::size_t count) {
        std::vector<float> numbers(count);
        for (float& value : numbers) value = float(random.normal());
        return numbers;
    };
    const auto strip = normal(tile_rows * projected_dimension),
               panel = normal(tile_columns * projected_dimension);
    auto row_norm = normal(tile_rows), column_norm = normal(tile_columns);
    const auto row_cutoff = normal(tile_rows), column_cutoff = normal(tile_columns);
    row_norm[1] = column_norm[7] = std::numeric_limits<float>::infinity();
    TileRows rows{{}, row_norm.data(), row_cutoff.data()};
    for (std::size_t r = 0; r < tile_rows; ++r) rows.numbers[r] = strip.data() + r * projected_dimension;
    const TileColumns columns{panel.data(), column_norm.data(), column_cutoff.data()};
    const DistanceKernels kernels(ism::best_instruction_set());
    const TileMask passed = kernels.prune_tile(rows, columns), plain = prune_tile_any(rows, columns);
    std::size_t compared = 0;
    for (std::size_t r = 0; r < tile_rows; ++r)
        for (std::size_t c = 0; c < tile_columns; ++c) {
            double sum = -double(row_norm[r]) - double(column_norm[c]);
            for (std::size_t k = 0; k < projected_dimension; ++k)
                sum += double(strip[r * projected_dimension + k]) * double(panel[k * tile_columns + c]);
            const double above = sum - double(std::min(row_cutoff[r], column_cutoff[c]));
            if (std::abs(above) < 1e-4) continue;
            ++compared;
            CHECK((passed[r] >> c & 1) == (above > 0));
            CHECK((plain[r] >> c & 1) == (above > 0));
        }
    CHECK(compared > 90);
}

TEST_CASE("squared differences are the same bits for every instruction set") {
    using namespace ism::detail;
    ism::Random random(10);
    for (const std::size_t count : {8u, 16u, 24u, 128u, 1000u})
        for (const double size : {1e-22, 1.0, 1e15}) {
            std::vector<float> a(count), b(count);
            for (float& value : a) value = float(size * (1 + 0.1 * random.normal()));
            for (float& value : b) value = float(size * (1 + 0.1 * random.normal()));
            double sum = 0;
            for (std::size_t k = 0; k < count; ++k)
                sum += (double(a[k]) - double(b[k])) * (double(a[k]) - double(b[k]));
            const float exact =
                DistanceKernels(ism::InstructionSet::any).sq_difference(a.data(), b.data(), count);
            CHECK(exact == Approx(sum).epsilon(1e-6).margin(1e-45));
            for (const ism::InstructionSet isa : instruction_sets()) {
                const DistanceKernels kernels(isa);
                CHECK(kernels.sq_difference(a.data(), b.data(), count) == exact);
                CHECK(kernels.sq_difference(b.data(), a.data(), count) == exact);
                const float rough = kernels.rough_sq_difference(a.data(), b.data(), count);
                CHECK(std::abs(rough - exact) <= rough_error(count) * exact + float(count) * 0x1p-126f);
            }
        }
}

TEST_CASE("a dendrogram is the same bits for every instruction set, near ties and all") {
    ism::Random random(17);
    std::vector<Points> sets{random_points(900, 128, 30, random), random_points(600, 40, 8, random, 1000),
                             random_points(600, 6, 8, random)};
    // all squared differences about 1, which float sums round one way or the other: each distance a near tie
    Points corners{128, {}}, tiny = random_points(300, 50, 5, random), grid{3, {}}, ulps{64, {}};
    for (std::size_t i = 0; i < 400 * 128; ++i)
        corners.values.push_back(float((random.index(2) == 0 ? -0.5 : 0.5) + 1e-7 * random.normal()));
    for (float& value : tiny.values) value *= 1e-22f;  // squares below the smallest normal float
    for (int i = 0; i < 343; ++i)
        grid.values.insert(grid.values.end(), {float(i % 7), float(i / 7 % 7), float(i / 49)});
    for (std::size_t i = 0; i < 300 * 64; ++i)  // a last digit apart
        ulps.values.push_back(1 + float(random.index(3)) * 0x1p-23f);
    sets.insert(sets.end(), {corners, tiny, grid, ulps});
    for (const Points& points : sets)
        for (const double part : {0.3, 1.0}) {
            const double height =
                trace(points).merges[std::size_t(part * double(points.size() - 2))].sq_distance;
            const ism::AverageLinkOptions options{.max_sq_distance = part < 1 ? height : infinity,
                                                  .isa = ism::InstructionSet::any};
            const ism::MergeTrace plain = ism::trace_average_link(points.moments(), options);
            CAPTURE(points.size(), points.dimension, part);
            REQUIRE(plain.merges.size() > points.size() / 10);
            for (const ism::InstructionSet isa : instruction_sets())
                for (const unsigned threads : {1u, 2u}) {
                    ism::AverageLinkOptions other = options;
                    other.isa = isa;
                    CHECK((ism::trace_average_link(points.moments(), other, threads).merges == plain.merges));
                }
        }
}

TEST_CASE("merges are told in one order, whatever order they were made in") {
    // two pairs, a third, and what joins the first two; all at distance 1
    ism::MergeTrace made{.points = 6, .merges = {{4, 5, 2, 1}, {2, 3, 2, 1}, {0, 1, 2, 1}, {7, 8, 4, 1}}};
    ism::MergeTrace again{.points = 6, .merges = {{0, 1, 2, 1}, {2, 3, 2, 1}, {6, 7, 4, 0.5}, {4, 5, 2, 1}}};
    ism::detail::sort_merges(made);
    ism::detail::sort_merges(again);
    CHECK(made.merges == std::vector<ism::Merge>{{0, 1, 2, 1}, {2, 3, 2, 1}, {4, 5, 2, 1}, {6, 7, 4, 1}});
    CHECK(again.merges == made.merges);
}
