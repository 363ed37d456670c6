// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/vote/kernel.hpp"
#include "ism/vote/mean_shift.hpp"
#include "ism/vote/strongest_modes.hpp"
#include "ism/vote/vote_tree.hpp"

namespace {

constexpr auto grows = ism::BandwidthScaling::with_scale, stays = ism::BandwidthScaling::none;

template <std::size_t D>
std::vector<ism::Vote<D>> random_votes(std::size_t count, ism::Random& random, std::uint32_t label = 0) {
    std::vector<ism::Vote<D>> votes;
    for (std::size_t i = 0; i < count; ++i) {
        ism::Vote<D> vote{.at = {}, .weight = float(random.uniform(0.1, 1)), .label = label};
        const double cluster = double(random.index(4));
        for (std::size_t k = 0; k < D; ++k) vote.at[k] = float(60 * cluster * (k < 2) + 12 * random.normal());
        vote.scale = float(0.5 + 0.25 * cluster + 0.05 * std::abs(random.normal()));
        votes.push_back(vote);
    }
    return votes;
}

template <std::size_t D>
ism::Bandwidth<D> mixed_bandwidth(double size) {
    ism::Bandwidth<D> bandwidth{};
    bandwidth.at_scale_1.fill(size);
    bandwidth.scaling.fill(stays);
    bandwidth.scaling[0] = grows;
    if (D > 1) bandwidth.scaling[1] = grows;
    return bandwidth;
}

/// Kernels by their definitions, in double.
double profile(ism::FlatKernel, double sq_u) {
    return sq_u <= 1 ? 1 : 0;
}
double profile(ism::EpanechnikovKernel, double sq_u) {
    return sq_u <= 1 ? 1 - sq_u : 0;
}
double profile(ism::GaussianKernel, double sq_u) {
    return sq_u <= 9 ? std::exp(-sq_u / 2) : 0;
}
double shift(ism::FlatKernel, double sq_u) {
    return sq_u <= 1 ? 1 : 0;
}
double shift(ism::EpanechnikovKernel, double sq_u) {
    return sq_u <= 1 ? 1 : 0;
}
double shift(ism::GaussianKernel kernel, double sq_u) {
    return profile(kernel, sq_u);
}

/// Mean shift without grid or shortcuts, straight from the definition, in double.
template <class K, std::size_t D>
ism::Mode<D> direct_mode(const std::vector<ism::Vote<D>>& votes, const ism::Bandwidth<D>& bandwidth,
                         ism::Mode<D> mode, const ism::MeanShiftOptions& options) {
    for (int i = 0; i < options.max_iterations; ++i) {
        const auto window = bandwidth.at(mode.scale);
        ism::Mode<D> next{.at = {}, .scale = 0};
        double weight = 0;
        for (const auto& vote : votes) {
            const double w = vote.weight * shift(K{}, ism::sq_windows(vote.at, mode.at, window));
            weight += w;
            next.scale += w * vote.scale;
            for (std::size_t k = 0; k < D; ++k) next.at[k] += w * vote.at[k];
        }
        if (weight == 0) break;
        next.scale /= weight;
        for (double& value : next.at) value /= weight;
        const double ratio = next.scale / mode.scale - 1;
        const double sq_step = ism::sq_windows(next.at, mode.at, window) + ratio * ratio;
        mode.at = next.at, mode.scale = next.scale;
        if (sq_step < options.tolerance * options.tolerance) break;
    }
    mode.score = 0;
    for (const auto& vote : votes)
        mode.score += vote.weight * profile(K{}, ism::sq_windows(vote.at, mode.at, bandwidth.at(mode.scale)));
    return mode;
}

/// All modes so, from all starts.
template <class K, std::size_t D>
std::vector<ism::Mode<D>> direct_modes(const std::vector<ism::Vote<D>>& votes,
                                       const ism::Bandwidth<D>& bandwidth,
                                       const ism::MeanShiftOptions& options) {
    ism::SeedBins<D> bins;
    std::vector<ism::Mode<D>> modes, apart;
    for (const auto& start : bins.find(std::span<const ism::Vote<D>>(votes), bandwidth, options.max_seeds,
                                       options.min_relative_weight))
        modes.push_back(direct_mode<K>(votes, bandwidth, start, options));
    std::stable_sort(modes.begin(), modes.end(),
                     [](const auto& a, const auto& b) { return a.score > b.score; });
    for (const auto& mode : modes)
        if (std::none_of(apart.begin(), apart.end(), [&](const auto& other) {
                return ism::sq_windows(mode.at, other.at, bandwidth.at(other.scale)) < 1;
            }))
            apart.push_back(mode);
    return apart;
}

template <class K, std::size_t D>
void check_against_direct(std::size_t count) {
    ism::Random random(11 + count);
    const auto votes = random_votes<D>(count, random);
    const auto bandwidth = mixed_bandwidth<D>(20);
    const std::span<const ism::Vote<D>> all(votes);
    const ism::MeanShiftOptions every{.max_seeds = 60,
                                      .min_relative_weight = 0,
                                      .max_iterations = 500,
                                      .tolerance = 1e-7,
                                      .merge_radius = 0};
    const auto direct = direct_modes<K>(votes, bandwidth, every);
    const auto modes = ism::find_modes<K>(all, bandwidth, every);
    REQUIRE(modes.size() == direct.size());
    for (std::size_t m = 0; m < modes.size(); ++m) {
        CHECK(std::sqrt(ism::sq_windows(modes[m].at, direct[m].at, bandwidth.at(direct[m].scale))) < 1e-4);
        CHECK(modes[m].scale == Approx(direct[m].scale).epsilon(1e-4));
        CHECK(modes[m].score == Approx(direct[m].score).epsilon(1e-4));
    }
    ism::MeanShiftMemory<D, ism::VoteTree<D>> memory;
    const auto by_tree = ism::find_modes<K>(all, bandwidth, every, memory);
    REQUIRE(by_tree.size() == direct.size());
    for (std::size_t m = 0; m < direct.size(); ++m) {
        CHECK(std::sqrt(ism::sq_windows(by_tree[m].at, direct[m].at, bandwidth.at(direct[m].scale))) < 1e-4);
        CHECK(by_tree[m].score == Approx(direct[m].score).epsilon(1e-4));
    }
    // what the merge radius leaves out is no mode of its own
    auto merging = every;
    merging.merge_radius = ism::MeanShiftOptions{}.merge_radius;
    const auto fewer = ism::find_modes<K>(all, bandwidth, merging);
    for (const auto& mode : direct)
        if (mode.score >= 0.2 * direct.front().score)
            CHECK(std::any_of(fewer.begin(), fewer.end(), [&](const auto& other) {
                return ism::sq_windows(mode.at, other.at, bandwidth.at(mode.scale)) < 0.1 &&
                       other.score > 0.95 * mode.score;
            }));
}

template <class A, class B>
bool same_bits(const std::vector<A>& a, const std::vector<B>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& m, const auto& n) {
        return m.at == n.at && m.scale == n.scale && m.score == n.score && m.label == n.label;
    });
}

}  // namespace

TEMPLATE_TEST_CASE("the grid and the tree find just the votes in the window", "", ism::FlatKernel,
                   ism::GaussianKernel) {
    ism::Random random(5);
    for (const std::size_t count : {1, 800, 3000}) {
        const auto votes = random_votes<3>(count, random);
        const ism::Bandwidth<3> bandwidth{{10, 14, 9}, {grows, grows, stays}};
        const ism::VoteGrid<3> grid(votes, bandwidth);
        REQUIRE(grid.size() == count);
        ism::VoteTree<3> tree;
        tree.assign(votes, bandwidth);
        for (int trial = 0; trial < 60; ++trial) {
            const std::array<double, 3> at{random.uniform(-60, 260), random.uniform(-60, 260),
                                           random.uniform(-30, 30)};
            const auto window = bandwidth.at(random.uniform(0.2, 8));
            std::vector<std::uint32_t> found, expected;
            grid.each_within(at, window, TestType::reach,
                             [&](std::uint32_t i, double) { found.push_back(i); });
            for (std::uint32_t i = 0; i < votes.size(); ++i)
                if (ism::sq_windows(votes[i].at, at, window) <= TestType::reach * TestType::reach)
                    expected.push_back(i);
            std::sort(found.begin(), found.end());
            CHECK(found == expected);
            found.clear();
            tree.each_within(at, window, TestType::reach,
                             [&](std::uint32_t i, double) { found.push_back(i); });
            CHECK(found == expected);
        }
    }
}

TEMPLATE_TEST_CASE("sums over a window are those of the definition", "", ism::FlatKernel,
                   ism::EpanechnikovKernel, ism::GaussianKernel) {
    ism::Random random(6);
    for (const std::size_t count : {5, 900, 20000}) {
        const auto votes = random_votes<5>(count, random);
        const auto bandwidth = mixed_bandwidth<5>(25);
        const ism::VoteGrid<5> grid(votes, bandwidth);
        for (int trial = 0; trial < 20; ++trial) {
            ism::Mode<5> mode{.at = {}, .scale = random.uniform(0.5, 2)};
            const auto& near = votes[random.index(count)];
            for (std::size_t k = 0; k < 5; ++k) mode.at[k] = near.at[k] + random.uniform(-5, 5);
            const auto window = bandwidth.at(mode.scale);
            double weight = 0, score = 0;
            std::array<double, 5> sum{};
            for (const auto& vote : votes) {
                const double sq_u = ism::sq_windows(vote.at, mode.at, window);
                score += vote.weight * profile(TestType{}, sq_u);
                const double w = vote.weight * shift(TestType{}, sq_u);
                weight += w;
                for (std::size_t k = 0; k < 5; ++k) sum[k] += w * vote.at[k];
            }
            const auto mean = ism::window_mean<TestType>(grid, mode.at, window);
            CHECK(mean.weight == Approx(weight).epsilon(1e-5).margin(1e-6));
            CHECK(ism::window_score<TestType>(grid, mode.at, window) ==
                  Approx(score).epsilon(1e-5).margin(1e-6));
            if (weight > 0)
                for (std::size_t k = 0; k < 5; ++k)
                    CHECK(std::abs(mean.at[k] - sum[k] / weight) < 1e-5 * window[k]);
        }
    }
}

TEMPLATE_TEST_CASE("mean shift ends where the direct computation ends", "", ism::FlatKernel,
                   ism::EpanechnikovKernel, ism::GaussianKernel) {
    check_against_direct<TestType, 1>(300);
    check_against_direct<TestType, 2>(500);
    check_against_direct<TestType, 3>(700);
    check_against_direct<TestType, 3>(1000);
    check_against_direct<TestType, 5>(700);
}

TEST_CASE("mean shift starts at the heaviest bins, and no bin is taken for another") {
    ism::Random random(4);
    std::vector<ism::Vote<2>> votes;
    for (int i = 0; i < 4000; ++i)
        votes.push_back({.at = {float(random.uniform(-90, 90)), float(random.uniform(-9, 9))},
                         .scale = float(std::exp2(random.uniform(-4, 4))),
                         .weight = float(random.uniform(0.1, 1))});
    const ism::Bandwidth<2> bandwidth{{16, 2}, {grows, stays}};
    std::map<std::array<int, 3>, ism::Mode<2>> bins;
    for (const auto& vote : votes) {
        int exponent = 0;
        const float part = std::frexp(vote.scale, &exponent);  // 0.5 ... 1
        const int quarter = int(std::floor(8 * part)) - 4;
        const double middle = std::ldexp((quarter + 4.5) / 8, exponent);
        const std::array<int, 3> key{4 * exponent + quarter, int(std::floor(vote.at[0] / (16 * middle))),
                                     int(std::floor(vote.at[1] / 2))};
        auto& bin = bins.try_emplace(key, ism::Mode<2>{.at = {}, .scale = 0}).first->second;
        for (std::size_t k = 0; k < 2; ++k) bin.at[k] += double(vote.weight) * vote.at[k];
        bin.scale += double(vote.weight) * vote.scale;
        bin.score += vote.weight;
    }
    std::vector<ism::Mode<2>> expected;
    for (const auto& [key, bin] : bins) expected.push_back(bin);
    std::sort(expected.begin(), expected.end(),
              [](const auto& a, const auto& b) { return a.score > b.score; });
    ism::SeedBins<2> finder;
    const auto found = finder.find(std::span<const ism::Vote<2>>(votes), bandwidth, 10000, 0);
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        CHECK(found[i].score == Approx(expected[i].score));
        CHECK(found[i].scale == Approx(expected[i].scale / expected[i].score));
        CHECK(found[i].at[0] == Approx(expected[i].at[0] / expected[i].score));
    }
    CHECK(finder.find(std::span<const ism::Vote<2>>(votes), bandwidth, 7, 0).size() == 7);
    const auto heavy = finder.find(std::span<const ism::Vote<2>>(votes), bandwidth, 10000, 0.5);
    CHECK(heavy.back().score >= 0.5 * heavy.front().score);
    CHECK(heavy.size() < expected.size());
    CHECK(expected[heavy.size()].score < 0.5 * heavy.front().score);
}

TEST_CASE("a place with many heavy bins takes no seeds from another where only peaks are seeds") {
    ism::Random random(3);
    std::vector<ism::Vote<2>> votes;
    for (int i = 0; i < 2000; ++i)  // a wide heap around the origin, thinner outwards
        votes.push_back({.at = {float(30 * random.normal()), float(30 * random.normal())}, .weight = 1});
    for (int i = 0; i < 20; ++i)
        votes.push_back({.at = {float(505 + random.normal()), float(505 + random.normal())}, .weight = 1});
    const ism::Bandwidth<2> bandwidth{{10, 10}, {ism::BandwidthScaling::none, ism::BandwidthScaling::none}};
    const auto finds_lone = [&](bool peaks_only) {
        const auto modes = ism::find_modes<ism::EpanechnikovKernel>(
            std::span<const ism::Vote<2>>(votes), bandwidth,
            {.max_seeds = 30, .min_relative_weight = 0, .peaks_only = peaks_only});
        return std::any_of(modes.begin(), modes.end(), [](const auto& mode) { return mode.at[0] > 400; });
    };
    CHECK_FALSE(finds_lone(false));
    CHECK(finds_lone(true));

    ism::SeedBins<2> all_bins, peak_bins;
    const std::span<const ism::Vote<2>> given(votes);
    const auto all = all_bins.find(given, bandwidth, 10000, 0);
    const auto peaks = peak_bins.find(given, bandwidth, 10000, 0, true);
    CHECK(peaks.size() < all.size() / 2);
    CHECK(peaks.front().score == all.front().score);  // the heaviest of all is a peak
    // none lies beside a heavier one
    for (const auto& a : peaks)
        for (const auto& b : peaks)
            if (a.score > b.score)
                CHECK((std::abs(std::floor(a.at[0] / 10) - std::floor(b.at[0] / 10)) > 1 ||
                       std::abs(std::floor(a.at[1] / 10) - std::floor(b.at[1] / 10)) > 1));
}

TEST_CASE("modes are found where votes gather, strongest first, each once") {
    ism::Random random(2);
    std::vector<ism::Vote<2>> votes;
    const std::array<std::array<double, 2>, 3> centres{{{0, 0}, {100, 0}, {0, 100}}};
    for (std::size_t c = 0; c < 3; ++c)
        for (int i = 0; i < 100 * (3 - int(c)); ++i)
            votes.push_back({.at = {float(centres[c][0] + 2 * random.normal()),
                                    float(centres[c][1] + 2 * random.normal())},
                             .scale = 1,
                             .weight = 1});
    const ism::Bandwidth<2> bandwidth{{10, 10}, {grows, grows}};
    const auto modes =
        ism::find_modes<ism::EpanechnikovKernel>(std::span<const ism::Vote<2>>(votes), bandwidth);
    REQUIRE(modes.size() == 3);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < 2; ++k) CHECK(modes[c].at[k] == Approx(centres[c][k]).margin(0.6));
    CHECK(modes[0].score > modes[1].score);
}

TEST_CASE("no vote has no mode, one vote is one, and so are many votes at one place") {
    const auto bandwidth = mixed_bandwidth<3>(10);
    CHECK(ism::find_modes<ism::EpanechnikovKernel>(std::span<const ism::Vote<3>>{}, bandwidth).empty());
    for (const std::size_t count : {1, 999, 5000}) {
        const std::vector<ism::Vote<3>> votes(count,
                                              {.at = {7, -8, 9}, .scale = 2, .weight = 0.5f, .label = 3});
        const auto modes =
            ism::find_modes<ism::EpanechnikovKernel>(std::span<const ism::Vote<3>>(votes), bandwidth);
        REQUIRE(modes.size() == 1);
        CHECK(modes[0].at == std::array{7.0, -8.0, 9.0});
        CHECK(modes[0].scale == 2);
        CHECK(modes[0].score == 0.5 * double(count));
        CHECK(modes[0].label == 3);
    }
    const std::vector<ism::Vote<3>> weightless(5, {.at = {7, -8, 9}, .scale = 2, .weight = 0});
    CHECK(ism::find_modes<ism::FlatKernel>(std::span<const ism::Vote<3>>(weightless), bandwidth).empty());
}

TEST_CASE("absurd bandwidths give an error or a result, never a hang") {
    ism::Random random(2);
    const auto votes = random_votes<3>(2000, random);
    const std::span<const ism::Vote<3>> all(votes);
    double total = 0;
    for (const auto& vote : votes) total += vote.weight;
    for (const double value : {1e-300, 1e-30, 1e-12}) {  // each vote for itself
        const auto modes = ism::find_modes<ism::FlatKernel>(all, mixed_bandwidth<3>(value));
        REQUIRE(modes.size() == ism::MeanShiftOptions{}.max_seeds);
        CHECK(modes.front().score ==
              std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
                  return a.weight < b.weight;
              })->weight);
    }
    for (const double value : {1e12, 1e30, 1e300}) {  // all together
        const auto modes = ism::find_modes<ism::FlatKernel>(all, mixed_bandwidth<3>(value));
        REQUIRE(modes.size() == 1);
        CHECK(modes.front().score == Approx(total).epsilon(1e-5));
    }
    for (const double value :
         {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        ism::Bandwidth<3> bandwidth = mixed_bandwidth<3>(1);
        bandwidth.at_scale_1[1] = value;
        CHECK_THROWS_AS(ism::find_modes<ism::FlatKernel>(all, bandwidth), ism::Error);
    }
}

TEST_CASE("votes and options that mean shift cannot take are errors") {
    const auto bandwidth = mixed_bandwidth<2>(1);
    const auto modes_of = [&](ism::Vote<2> vote, const ism::MeanShiftOptions& options = {}) {
        const std::vector<ism::Vote<2>> votes{vote};
        return ism::find_modes<ism::FlatKernel>(std::span<const ism::Vote<2>>(votes), bandwidth, options)
            .size();
    };
    const ism::Vote<2> good{.at = {1, 2}, .scale = 1, .weight = 1};
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    CHECK(modes_of(good) == 1);
    for (const float value : {nan, inf, -inf, 1e20f}) {
        auto bad = good;
        bad.at[1] = value;
        CHECK_THROWS_AS(modes_of(bad), ism::Error);
        bad = good, bad.scale = value;
        CHECK_THROWS_AS(modes_of(bad), ism::Error);
        bad = good, bad.weight = value;
        CHECK_THROWS_AS(modes_of(bad), ism::Error);
    }
    auto bad = good;
    bad.scale = 0;
    CHECK_THROWS_AS(modes_of(bad), ism::Error);
    bad = good, bad.weight = -1;
    CHECK_THROWS_AS(modes_of(bad), ism::Error);
    CHECK_THROWS_AS(modes_of(good, {.min_relative_weight = -1}), ism::Error);
    CHECK_THROWS_AS(modes_of(good, {.max_iterations = -1}), ism::Error);
    CHECK_THROWS_AS(modes_of(good, {.tolerance = nan}), ism::Error);
    CHECK_THROWS_AS(modes_of(good, {.merge_radius = 2}), ism::Error);
    CHECK(modes_of(good, {.max_seeds = 0}) == 0);
    CHECK(modes_of(good, {.max_iterations = 0}) == 1);
}

TEST_CASE("memory used again does not change modes") {
    ism::Random random(8);
    ism::MeanShiftMemory<3> memory;
    for (const std::size_t count : {2000, 10, 0, 5000, 300}) {
        const auto votes = random_votes<3>(count, random);
        const std::span<const ism::Vote<3>> all(votes);
        const auto bandwidth = mixed_bandwidth<3>(random.uniform(5, 30));
        CHECK(same_bits(ism::find_modes<ism::GaussianKernel>(all, bandwidth, {}, memory),
                        ism::find_modes<ism::GaussianKernel>(all, bandwidth)));
    }
}

TEST_CASE("the strongest modes of all labels are those of searching every label, for any number of threads") {
    ism::Random random(9);
    std::vector<ism::Vote<3>> votes;
    for (std::uint32_t label = 0; label < 200; ++label) {
        const std::size_t count = 1 + random.index(label % 50 == 0 ? 600 : 30);
        const auto part = random_votes<3>(count, random, 7 * label);
        votes.insert(votes.end(), part.begin(), part.end());
        if (label % 10 == 3)  // the same votes for another label: a tie
            for (auto vote : part) vote.label += 1, votes.push_back(vote);
    }
    const auto bandwidth = mixed_bandwidth<3>(15);
    const auto labels = ism::split_by_label(votes);
    CHECK(labels.size() == 220);
    std::vector<ism::Mode<3>> all;
    for (const auto& part : labels)
        for (const auto& mode : ism::find_modes<ism::EpanechnikovKernel>(part, bandwidth))
            all.push_back(mode);
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
    for (const std::size_t most : {std::size_t(0), std::size_t(1), std::size_t(40), all.size() + 1})
        for (const double keep : {0.0, 0.3, 1.0}) {
            std::vector<ism::Mode<3>> expected;
            for (const auto& mode : all)
                if (expected.size() < most && mode.score >= keep * all.front().score)
                    expected.push_back(mode);
            for (const unsigned threads : {1u, 2u, 3u}) {
                ism::ThreadPool pool(threads);
                CHECK(same_bits(expected, ism::strongest_modes<ism::EpanechnikovKernel>(labels, bandwidth, {},
                                                                                        most, keep, pool)));
            }
        }
    for (const double bad : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()})
        CHECK_THROWS_AS(ism::strongest_modes<ism::FlatKernel>(labels, bandwidth, {}, 40, bad, 1), ism::Error);
    CHECK(ism::strongest_modes<ism::FlatKernel, 3>({}, bandwidth, {}, 40, 0.05, 2).empty());
}

TEST_CASE("no label is left out that could have one of the strongest modes, however its votes lie") {
    ism::Random random(31);
    for (int round = 0; round < 60; ++round) {
        std::vector<ism::Vote<3>> votes;
        const std::size_t label_count = 2 + random.index(100);
        for (std::uint32_t label = 0; label < label_count; ++label) {
            const double spread = std::exp(random.uniform(1, 6));
            for (std::size_t k = 1 + random.index(30); k > 0; --k) {
                ism::Vote<3> vote{.at = {},
                                  .scale = float(std::exp(random.uniform(-0.3, 0.3))),
                                  .weight = float(random.uniform(0.1, 1)),
                                  .label = label};
                for (std::size_t axis = 0; axis < 2; ++axis)
                    vote.at[axis] = float(500 + spread * random.uniform(-1, 1));
                vote.at[2] = vote.scale;
                votes.push_back(vote);
            }
        }
        const auto bandwidth = mixed_bandwidth<3>(20);
        const auto labels = ism::split_by_label(votes);
        std::vector<ism::Mode<3>> all;
        for (const auto& part : labels)
            for (const auto& mode : ism::find_modes<ism::EpanechnikovKernel>(part, bandwidth))
                all.push_back(mode);
        std::stable_sort(all.begin(), all.end(),
                         [](const auto& a, const auto& b) { return a.score > b.score; });
        const std::size_t most = 1 + random.index(40);
        const double keep = random.uniform();
        std::vector<ism::Mode<3>> expected;
        for (const auto& mode : all)
            if (expected.size() < most && mode.score >= keep * all.front().score) expected.push_back(mode);
        ism::ThreadPool pool(1);
        CHECK(same_bits(expected, ism::strongest_modes<ism::EpanechnikovKernel>(labels, bandwidth, {}, most,
                                                                                keep, pool)));
    }
}

TEMPLATE_TEST_CASE("the support of a mode is what a scan of all votes of its label finds", "",
                   ism::FlatKernel, ism::EpanechnikovKernel, ism::GaussianKernel) {
    ism::Random random(12);
    std::vector<ism::Vote<3>> votes;
    for (const auto& [label, count] : {std::pair{2u, 3000u}, {5u, 40u}, {9u, 700u}}) {
        const auto part = random_votes<3>(count, random, label);
        votes.insert(votes.end(), part.begin(), part.end());
    }
    for (int i = -2; i <= 2; ++i)  // at the edge of a window, a last digit beside, for a label of its own
        votes.push_back({.at = {std::nextafter(15.0f, float(i) * 1e9f), 0, 0}, .weight = 1, .label = 11});
    votes.push_back({.at = {0, 0, 0}, .weight = 1e6f, .label = 11});
    const ism::Bandwidth<3> bandwidth{{15, 15, 15}, {grows, grows, stays}};
    const auto labels = ism::split_by_label(votes);
    ism::ThreadPool pool(2);
    const auto modes = ism::strongest_modes<TestType>(labels, bandwidth, {}, 200, 0, pool);
    REQUIRE(modes.size() > 8);
    for (const auto& mode : modes) {
        const auto own = *std::find_if(labels.begin(), labels.end(),
                                       [&](const auto& part) { return part.front().label == mode.label; });
        std::vector<ism::WindowVote> scanned;
        for (std::uint32_t i = 0; i < own.size(); ++i) {
            const double sq_u = ism::sq_windows(own[i].at, mode.at, bandwidth.at(mode.scale));
            if (const double kernel = TestType::profile(float(sq_u)); kernel > 0)
                scanned.push_back({i, kernel});
        }
        CHECK(mode.support == scanned);
        double score = 0;
        for (const auto& [i, kernel] : mode.support) score += double(own[i].weight) * kernel;
        CHECK(score == Approx(mode.score).epsilon(1e-4));
    }
}

TEST_CASE("the strongest modes by the tree are those by the grid") {
    ism::Random random(13);
    std::vector<ism::Vote<4>> votes;
    for (std::uint32_t label = 0; label < 20; ++label) {
        const auto part = random_votes<4>(200, random, label);
        votes.insert(votes.end(), part.begin(), part.end());
    }
    const auto bandwidth = mixed_bandwidth<4>(15);
    const auto labels = ism::split_by_label(votes);
    const auto grid = ism::strongest_modes<ism::EpanechnikovKernel>(labels, bandwidth, {}, 30, 0.1, 2);
    const auto tree =
        ism::strongest_modes<ism::EpanechnikovKernel, 4, ism::VoteTree<4>>(labels, bandwidth, {}, 30, 0.1, 2);
    REQUIRE(grid.size() == 30);
    REQUIRE(tree.size() == grid.size());
    for (std::size_t m = 0; m < grid.size(); ++m) {
        CHECK(tree[m].label == grid[m].label);
        CHECK(tree[m].score == Approx(grid[m].score).epsilon(1e-3));
    }
    STATIC_REQUIRE(ism::VoteSearch<ism::VoteGrid<4>, 4>);
    STATIC_REQUIRE(ism::VoteSearch<ism::VoteTree<4>, 4>);
    STATIC_REQUIRE(!ism::VoteSearch<ism::VoteTree<4>, 3>);
}

TEST_CASE("an option of mean shift that is out of range is named with its range and value") {
    const auto message = [](const ism::MeanShiftOptions& options) -> std::string {
        try {
            check(options);
        } catch (const ism::Error& error) {
            return error.what();
        }
        return "";
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(message({}) == "");
    CHECK(message({.min_relative_weight = 1.5}) ==
          "MeanShiftOptions::min_relative_weight: expected 0 to 1, got 1.5");
    CHECK(message({.min_relative_weight = nan}) ==
          "MeanShiftOptions::min_relative_weight: expected 0 to 1, got nan");
    CHECK(message({.max_iterations = -3}) == "MeanShiftOptions::max_iterations: expected 0 or more, got -3");
    CHECK(message({.tolerance = nan}) == "MeanShiftOptions::tolerance: expected 0 or more, finite, got nan");
    CHECK(message({.merge_radius = -1}) == "MeanShiftOptions::merge_radius: expected 0 to 1, got -1");
}

TEST_CASE("kernels are 1 at their centre, fall, and end at their reach") {
    const auto falls = []<class K>(K kernel) {
        CHECK(K::profile(0) == 1);
        for (float u = 0.05f; u < 4; u += 0.1f) {
            CHECK(K::profile(u * u) <= K::profile((u - 0.05f) * (u - 0.05f)));
            CHECK(K::profile(u * u) == Approx(profile(kernel, double(u) * u)).epsilon(2e-6));
            CHECK(K::shift(u * u) == Approx(shift(kernel, double(u) * u)).epsilon(2e-6));
        }
        CHECK(K::profile(float(1.001 * K::reach * K::reach)) == 0);
        CHECK(K::shift(float(1.001 * K::reach * K::reach)) == 0);
    };
    falls(ism::FlatKernel{});
    falls(ism::EpanechnikovKernel{});
    falls(ism::GaussianKernel{});
}
