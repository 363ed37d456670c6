// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/vote/cast.hpp"
#include "ism/vote/kernel.hpp"
#include "ism/vote/mean_shift.hpp"
#include "ism/vote/vote_space.hpp"

namespace {

// A feature twice as large as where it occurred, 1.5 m away.
const ism::Feature feature{.x = 100, .y = 50, .scale = 6, .depth_m = 1.5f};
const ism::Occurrence occurrence{.x = 20, .y = -10, .scale = 3, .class_index = 4};

ism::Shapes two_words() {
    ism::Shapes shapes;
    shapes.class_names = {"a", "b"};
    shapes.objects.resize(2);
    shapes.occurrences = {{.x = 1, .y = 2, .scale = 1, .weight = 0.25f, .class_index = 1},
                          {.x = 3, .y = 4, .scale = 2, .weight = 0.75f, .class_index = 0},
                          {.x = 5, .y = 6, .scale = 4, .weight = 1, .class_index = 1}};
    shapes.first = {0, 2, 3};
    return shapes;
}

template <std::size_t D>
std::vector<ism::Vote<D>> random_votes(std::size_t count, ism::Random& random) {
    std::vector<ism::Vote<D>> votes;
    for (std::size_t i = 0; i < count; ++i) {
        ism::Vote<D> vote{.at = {}, .weight = float(random.uniform(0.1, 1))};
        const double cluster = double(random.index(4));
        for (std::size_t k = 0; k < D; ++k) vote.at[k] = float(60 * cluster * (k < 2) + 12 * random.normal());
        vote.scale = float(0.5 + 0.25 * cluster + 0.05 * std::abs(random.normal()));
        votes.push_back(vote);
    }
    return votes;
}

/// Mean shift without grid or shortcuts, straight from the definition.
template <class K, std::size_t D>
ism::Mode<D> direct_mode(const std::vector<ism::Vote<D>>& votes, const ism::Bandwidth<D>& bandwidth,
                         ism::Mode<D> mode) {
    const auto sq_u = [&](const ism::Vote<D>& vote) {
        double sum = 0;
        for (std::size_t k = 0; k < D; ++k) {
            const double window =
                bandwidth.at_scale_1[k] * (bandwidth.growth[k] == ism::Growth::with_scale ? mode.scale : 1);
            sum += std::pow((vote.at[k] - mode.at[k]) / window, 2);
        }
        return sum;
    };
    for (int i = 0; i < 500; ++i) {
        ism::Mode<D> next{.at = {}, .scale = 0};
        double weight = 0;
        for (const auto& vote : votes) {
            const double w = vote.weight * K::shift(sq_u(vote));
            weight += w;
            next.scale += w * vote.scale;
            for (std::size_t k = 0; k < D; ++k) next.at[k] += w * vote.at[k];
        }
        if (weight == 0) break;
        next.scale /= weight;
        for (std::size_t k = 0; k < D; ++k) next.at[k] /= weight;
        mode.at = next.at, mode.scale = next.scale;
    }
    mode.score = 0;
    for (const auto& vote : votes) mode.score += vote.weight * K::profile(sq_u(vote));
    return mode;
}

}  // namespace

TEST_CASE("Eq 2: a vote of ISM is (x_f - x_i s_f/s_i, y_f - y_i s_f/s_i, s_f/s_i)") {
    static_assert(ism::Ism::dimension == 3 && !ism::Ism::has_label && !ism::Ism::needs_depth);
    CHECK(ism::Ism::position(feature, occurrence) == std::array{60.0f, 70.0f, 2.0f});
}

TEST_CASE("Eq 5: JISM adds the class") {
    static_assert(ism::Jism::dimension == 3 && ism::Jism::has_label && !ism::Jism::needs_depth);
    CHECK(ism::Jism::position(feature, occurrence) == std::array{60.0f, 70.0f, 2.0f});
    CHECK(ism::Jism::label(feature, occurrence) == 4);
}

TEST_CASE("Eq 6: JI3SM 1 adds the depth of the feature") {
    static_assert(ism::Ji3sm1::dimension == 4 && ism::Ji3sm1::has_label && ism::Ji3sm1::needs_depth);
    CHECK(ism::Ji3sm1::position(feature, occurrence) == std::array{60.0f, 70.0f, 2.0f, 1.5f});
}

TEST_CASE("Eq 7: JI3SM 2 has depth instead of scale") {
    static_assert(ism::Ji3sm2::dimension == 3 && ism::Ji3sm2::has_label && ism::Ji3sm2::needs_depth);
    CHECK(ism::Ji3sm2::position(feature, occurrence) == std::array{60.0f, 70.0f, 1.5f});
}

TEST_CASE("Eq 8: JI3SM 3 has depth times scale") {
    static_assert(ism::Ji3sm3::dimension == 3 && ism::Ji3sm3::has_label && ism::Ji3sm3::needs_depth);
    CHECK(ism::Ji3sm3::position(feature, occurrence) == std::array{60.0f, 70.0f, 3.0f});
}

TEST_CASE("votes carry p(word | feature) p(occurrence | word) and are ordered by class") {
    const std::vector<ism::Feature> features{feature, feature};
    const std::vector<ism::Match> matches{{0, 0, 0.5f}, {0, 1, 0.5f}, {1, 1, 1.0f}};
    const auto votes = ism::cast_votes<ism::Jism>(features, matches, two_words());
    REQUIRE(votes.size() == 4);
    CHECK(votes[0].label == 0);
    CHECK(votes[0].weight == Approx(0.375));
    CHECK(votes[1].weight == Approx(0.125));
    CHECK(votes[1].occurrence == 0);
    CHECK(votes[2].weight == Approx(0.5));
    CHECK(votes[3].feature == 1);
    CHECK(ism::cast_votes<ism::Jism>(features, matches, two_words(), {.min_weight = 0.2f}).size() == 3);
    CHECK(ism::cast_votes<ism::Jism>(features, matches, two_words(), {.max_scale = 2}).size() == 2);
    CHECK(ism::cast_votes<ism::Jism>(features, matches, two_words(), {.width = 93, .height = 99}).size() ==
          3);
}

TEST_CASE("a feature without a depth reading votes in flat spaces only") {
    std::vector<ism::Feature> features{feature};
    const std::vector<ism::Match> matches{{0, 0, 1.0f}};
    for (const float none : {ism::no_depth, 0.0f, -1.0f}) {
        features[0].depth_m = none;
        CHECK(ism::cast_votes<ism::Ism>(features, matches, two_words()).size() == 2);
        CHECK(ism::cast_votes<ism::Jism>(features, matches, two_words()).size() == 2);
        CHECK(ism::cast_votes<ism::Ji3sm1>(features, matches, two_words()).empty());
        CHECK(ism::cast_votes<ism::Ji3sm2>(features, matches, two_words()).empty());
        CHECK(ism::cast_votes<ism::Ji3sm3>(features, matches, two_words()).empty());
    }
}

TEMPLATE_TEST_CASE("the grid finds just the votes in the window", "", ism::FlatKernel, ism::GaussianKernel) {
    ism::Random random(5);
    const auto votes = random_votes<3>(800, random);
    const ism::Bandwidth<3> bandwidth{{10, 14, 9},
                                      {ism::Growth::with_scale, ism::Growth::with_scale, ism::Growth::none}};
    const ism::VoteGrid<3> grid(votes, bandwidth);
    for (int trial = 0; trial < 60; ++trial) {
        const std::array<double, 3> at{random.uniform(-60, 260), random.uniform(-60, 260),
                                       random.uniform(-30, 30)};
        const auto window = bandwidth.at(random.uniform(0.2, 8));
        std::vector<std::uint32_t> found, expected;
        grid.each_within(at, window, TestType::reach, [&](std::uint32_t i, double) { found.push_back(i); });
        for (std::uint32_t i = 0; i < votes.size(); ++i) {
            double sq_u = 0;
            for (std::size_t k = 0; k < 3; ++k) sq_u += std::pow((votes[i].at[k] - at[k]) / window[k], 2);
            if (sq_u <= TestType::reach * TestType::reach) expected.push_back(i);
        }
        std::sort(found.begin(), found.end());
        CHECK(found == expected);
    }
}

TEMPLATE_TEST_CASE("mean shift ends where the direct computation ends", "", ism::FlatKernel,
                   ism::EpanechnikovKernel, ism::GaussianKernel) {
    ism::Random random(11);
    const auto votes = random_votes<3>(600, random);
    const ism::Bandwidth<3> bandwidth{{20, 20, 20},
                                      {ism::Growth::with_scale, ism::Growth::with_scale, ism::Growth::none}};
    const ism::VoteGrid<3> grid(votes, bandwidth);
    for (std::size_t i = 0; i < 40; ++i) {
        ism::Mode<3> start{.at = {votes[i].at[0], votes[i].at[1], votes[i].at[2]}, .scale = votes[i].scale};
        const auto fast = ism::shift_to_mode<TestType>(grid, std::span<const ism::Vote<3>>(votes), bandwidth,
                                                       start, {.max_iterations = 500, .tolerance = 1e-9});
        const auto direct = direct_mode<TestType>(votes, bandwidth, start);
        for (std::size_t k = 0; k < 3; ++k) CHECK(fast.at[k] == Approx(direct.at[k]).margin(1e-4));
        CHECK(fast.score == Approx(direct.score).epsilon(1e-6));
    }
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
    const ism::Bandwidth<2> bandwidth{{10, 10}, {ism::Growth::with_scale, ism::Growth::with_scale}};
    const ism::VoteGrid<2> grid(votes, bandwidth);
    const auto modes =
        ism::find_modes<ism::EpanechnikovKernel>(grid, std::span<const ism::Vote<2>>(votes), bandwidth);
    REQUIRE(modes.size() == 3);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < 2; ++k) CHECK(modes[c].at[k] == Approx(centres[c][k]).margin(0.6));
    CHECK(modes[0].score > modes[1].score);
}

TEST_CASE("absurd bandwidths give an error or a result, never a hang") {
    ism::Random random(2);
    const auto votes = random_votes<2>(500, random);
    for (const double value : {1e-12, 1e12}) {
        const ism::Bandwidth<2> bandwidth{{value, value}, {ism::Growth::none, ism::Growth::none}};
        const ism::VoteGrid<2> grid(votes, bandwidth);
        CHECK_FALSE(
            ism::find_modes<ism::FlatKernel>(grid, std::span<const ism::Vote<2>>(votes), bandwidth).empty());
    }
    for (const double value : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
        const ism::Bandwidth<2> bandwidth{{value, 1}, {ism::Growth::none, ism::Growth::none}};
        CHECK_THROWS_AS(ism::check(bandwidth), ism::Error);
    }
}

TEST_CASE("kernels are 1 at their centre, fall, and end at their reach") {
    const auto falls = []<class K>(K) {
        CHECK(K::profile(0) == 1);
        for (double u = 0.05; u < 4; u += 0.1)
            CHECK(K::profile(u * u) <= K::profile((u - 0.05) * (u - 0.05)));
        CHECK(K::profile(1.001 * K::reach * K::reach) == 0);
        CHECK(K::shift(1.001 * K::reach * K::reach) == 0);
    };
    falls(ism::FlatKernel{});
    falls(ism::EpanechnikovKernel{});
    falls(ism::GaussianKernel{});
}
