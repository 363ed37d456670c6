// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "support/catch.hpp"

#include "ism/vote/cast.hpp"
#include "ism/vote/vote_space.hpp"

namespace {

// A feature twice as large as where it occurred, 1.5 m away.
const ism::Feature feature{.x = 100, .y = 50, .scale = 6, .depth_m = 1.5f};
const ism::Occurrence occurrence{.x = 20, .y = -10, .scale = 3, .class_index = 4};

const ism::TrainingObject training_object{.width = 200, .height = 200};

ism::VoteSource source() {
    return {feature, occurrence, training_object, nullptr, ism::placement(feature, occurrence)};
}

ism::ShapeModel two_words() {
    ism::ShapeModel shapes;
    shapes.class_names = {"a", "b"};
    shapes.objects.resize(2);
    const std::vector<ism::Occurrence> all = {{.x = 1, .y = 2, .scale = 1, .weight = 0.25f, .class_index = 1},
                                              {.x = 3, .y = 4, .scale = 2, .weight = 0.75f, .class_index = 0},
                                              {.x = 5, .y = 6, .scale = 4, .weight = 1, .class_index = 1}};
    shapes.occurrences = {all, {0, 2, 3}};
    return shapes;
}

}  // namespace

TEST_CASE("Eq 2: a vote of ISM is (x_f - x_i s_f/s_i, y_f - y_i s_f/s_i, s_f/s_i)") {
    static_assert(ism::Ism::dimension == 3 && !ism::Ism::has_label && !ism::Ism::needs_depth);
    CHECK(ism::Ism::position(source()) == std::array{60.0f, 70.0f, 2.0f});
}

TEST_CASE("Eq 5: JISM adds the class") {
    static_assert(ism::Jism::dimension == 3 && ism::Jism::has_label && !ism::Jism::needs_depth);
    CHECK(ism::Jism::position(source()) == std::array{60.0f, 70.0f, 2.0f});
    CHECK(ism::Jism::label(source()) == 4);
}

TEST_CASE("Eq 6: JI3SM 1 adds the depth of the feature") {
    static_assert(ism::Ji3sm1::dimension == 4 && ism::Ji3sm1::has_label && ism::Ji3sm1::needs_depth);
    CHECK(ism::Ji3sm1::position(source()) == std::array{60.0f, 70.0f, 2.0f, 1.5f});
}

TEST_CASE("Eq 7: JI3SM 2 has depth instead of scale") {
    static_assert(ism::Ji3sm2::dimension == 3 && ism::Ji3sm2::has_label && ism::Ji3sm2::needs_depth);
    CHECK(ism::Ji3sm2::position(source()) == std::array{60.0f, 70.0f, 1.5f});
}

TEST_CASE("Eq 8: JI3SM 3 has depth times scale") {
    static_assert(ism::Ji3sm3::dimension == 3 && ism::Ji3sm3::has_label && ism::Ji3sm3::needs_depth);
    CHECK(ism::Ji3sm3::position(source()) == std::array{60.0f, 70.0f, 3.0f});
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
    CHECK(ism::cast_votes<ism::Jism>(features, matches, two_words(), nullptr, {.min_weight = 0.2f}).size() ==
          3);
    CHECK(ism::cast_votes<ism::Jism>(features, matches, two_words(), nullptr, {.max_scale = 2}).size() == 2);
    CHECK(ism::cast_votes<ism::Jism>(features, matches, two_words(), nullptr, {.width = 93, .height = 99})
              .size() == 3);
}

TEST_CASE("objects left out cast no votes, and the others of a word have its whole weight") {
    ism::ShapeModel shapes;
    shapes.class_names = {"only"};
    shapes.objects.resize(3);
    std::vector<ism::Occurrence> all;
    for (const auto& [number, weight] : {std::pair(0u, 0.5f), {1u, 0.25f}, {2u, 0.25f}, {0u, 1.0f}})
        all.push_back({.weight = weight, .object = number});
    shapes.occurrences = {all, {0, 3, 4}};
    const std::vector<ism::Feature> features{{.x = 1, .y = 1}};
    const std::vector<ism::Match> matches{{0, 0, 1.0f}, {0, 1, 1.0f}};
    const auto votes = ism::cast_votes<ism::Jism>(features, matches, shapes, nullptr,
                                                  {.without_first = 0, .without_end = 1});
    REQUIRE(votes.size() == 2);  // nobody else has seen the second word
    CHECK(votes[0].occurrence == 1);
    CHECK(votes[0].weight == 0.5f);
    CHECK(votes[1].weight == 0.5f);
    CHECK(
        ism::cast_votes<ism::Jism>(features, matches, shapes, nullptr, {.without_first = 1, .without_end = 1})
            .size() == 4);
}

TEST_CASE("votes of a label keep the order of features, words and occurrences, few labels or far ones") {
    for (const std::uint32_t step : {1u, 1000000u}) {
        std::vector<ism::Vote<2>> votes;
        for (std::uint32_t i = 0; i < 200; ++i)
            votes.push_back({.at = {}, .label = step * (i * i % 17), .feature = i});
        auto expected = votes;
        std::stable_sort(expected.begin(), expected.end(),
                         [](const auto& a, const auto& b) { return a.label < b.label; });
        ism::detail::sort_by_label(votes);
        CHECK(std::equal(votes.begin(), votes.end(), expected.begin(), [](const auto& a, const auto& b) {
            return a.label == b.label && a.feature == b.feature;
        }));
    }
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
