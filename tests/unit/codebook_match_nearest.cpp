// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "support/catch.hpp"

#include "ism/codebook/match_nearest.hpp"

namespace {

/// (1, 0), (0, 1), (-1, 0), (0, -1).
ism::WordIndex four_words(std::size_t count = 4) {
    ism::Codebook words(2, 1);
    for (std::size_t w = 0; w < count; ++w) {
        const std::vector<float> mean{w == 0   ? 1.0f
                                      : w == 2 ? -1.0f
                                               : 0.0f,
                                      w == 1   ? 1.0f
                                      : w == 3 ? -1.0f
                                               : 0.0f};
        words.push_back({mean, 1});
    }
    return ism::WordIndex(words);
}

std::vector<ism::Match> matches_of(const ism::WordIndex& words, std::vector<float> numbers,
                                   std::size_t neighbours, ism::WordRange without = {}) {
    ism::ThreadPool pool(1);
    return match_nearest(words, ism::Descriptors<float>(2, std::move(numbers)), neighbours, pool, without);
}

using Matches = std::vector<ism::Match>;

}  // namespace

TEST_CASE("a neighbour weighs as much as it is nearer than the first that is left out") {
    const auto words = four_words();
    // Squared distances of (1, 0): 0, 2, 4, 2; of (0, 3): 10, 4, 10, 16.
    CHECK(matches_of(words, {1, 0}, 1) == Matches{{0, 0, 2, true}});
    CHECK(matches_of(words, {1, 0}, 2) ==
          Matches{{0, 0, 2, true}});  // the second is no nearer than the third
    CHECK(matches_of(words, {1, 0}, 3) == Matches{{0, 0, 4, true}, {0, 1, 2, false}, {0, 3, 2, false}});
    CHECK(matches_of(words, {1, 0, 0, 3}, 1) == Matches{{0, 0, 2, true}, {1, 1, 6, true}});
    CHECK(matches_of(words, {1, 0}, 0).empty());
    CHECK(matches_of(words, {}, 3).empty());
}

TEST_CASE("of fewer words than neighbours the furthest is the one left out") {
    CHECK(matches_of(four_words(), {1, 0}, 10) == matches_of(four_words(), {1, 0}, 3));
    CHECK(matches_of(four_words(), {1, 0}, 4) == matches_of(four_words(), {1, 0}, 3));
    CHECK(matches_of(four_words(2), {1, 0}, 5) == Matches{{0, 0, 2, true}});
    CHECK(matches_of(four_words(1), {1, 0}, 5).empty());  // nothing to compare with
}

TEST_CASE("words that are nobody's neighbours are passed over") {
    CHECK(matches_of(four_words(), {1, 0}, 2, {0, 1}) == Matches{{0, 1, 2, true}, {0, 3, 2, false}});
    CHECK(matches_of(four_words(), {1, 0}, 1, {0, 1}).empty());  // words 1 and 3 are equally near
    CHECK(matches_of(four_words(), {1, 0}, 2, {1, 4}).empty());
    CHECK(matches_of(four_words(), {1, 0}, 2, {0, 4}).empty());
}

TEST_CASE("a descriptor that is no numbers matches nothing, and those beside it as ever") {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), INFINITY})
        CHECK(matches_of(four_words(), {1, 0, bad, 0, 0, 3}, 1) == Matches{{0, 0, 2, true}, {2, 1, 6, true}});
    ism::ThreadPool pool(1);
    CHECK_THROWS_AS(match_nearest(four_words(), ism::Descriptors<float>(3, 1), 2, pool), ism::Error);
}
