// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/train/grow_codebook.hpp"

#include <cstdint>
#include <limits>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"

namespace {

using Points = ism::Descriptors<float, 2>;

Points points(const std::vector<float>& values) {
    Points result(values.size() / 2);
    std::copy(values.begin(), values.end(), result.values().begin());
    return result;
}

ism::Descriptors<float, 8> random_points(std::size_t count, ism::Random& random) {
    ism::Descriptors<float, 8> result(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double centre = 30 * double(random.index(7));
        for (float& value : result.row(i))
            value = float(std::clamp(centre + 9 * random.normal(), 0.0, 255.0));
    }
    return result;
}

template <class Words>
void check_equal(const Words& a, const Words& b) {
    REQUIRE(a.size() == b.size());
    CHECK(std::equal(a.words.values().begin(), a.words.values().end(), b.words.values().begin()));
    CHECK(a.mean_sq_length == b.mean_sq_length);
    CHECK(a.sizes == b.sizes);
    CHECK(a.group == b.group);
    CHECK(a.max_sq_distance == b.max_sq_distance);
}

}  // namespace

TEST_CASE("words take in new descriptors, others become words, by hand") {
    const auto present = ism::build_codebook(points({0, 0, 0, 1, 10, 0, 10, 1}), 2.0, 2, 3);
    REQUIRE(present.sizes == std::vector<std::uint32_t>{2, 2});
    // One beside the first word; a pair of its own; one alone, too small for a word.
    const auto [grown, word_now] = ism::grow_codebook(present, points({0, 0.5f, 20, 0, 20, 1, 40, 0}), 2);
    CHECK(word_now == std::vector<std::uint32_t>{0, 1});
    CHECK(grown.sizes == std::vector<std::uint32_t>{3, 2, 2});
    CHECK(grown.group == std::vector<std::uint32_t>{3, 3, 3});
    CHECK(grown.max_sq_distance == 2);
    CHECK(grown.words.row(0)[1] == Approx(0.5));
    CHECK(grown.mean_sq_length[0] == Approx(1.25 / 3));
    CHECK(grown.words.row(1)[0] == 10);
    CHECK(grown.words.row(2)[0] == 20);
    CHECK(grown.mean_sq_length[2] == Approx(400.5));
}

TEST_CASE("words of before stay however small, and may become one") {
    // 0 and 3 are words of one descriptor each, 9 apart in square; the pairs at 1.5 come between.
    const auto present = ism::build_codebook(points({0, 0, 3, 0, 50, 0}), 4.0, 1);
    REQUIRE(present.size() == 3);
    const auto [grown, word_now] = ism::grow_codebook(
        present, points({1.4f, 0, 1.4f, 0, 1.4f, 0, 1.4f, 0, 1.4f, 0, 1.4f, 0, 1.4f, 0, 1.4f, 0}), 5);
    CHECK(word_now == std::vector<std::uint32_t>{0, 0, 1});
    CHECK(grown.sizes == std::vector<std::uint32_t>{10, 1});
    CHECK(grown.words.row(0)[0] == Approx((3 + 8 * 1.4) / 10));
    CHECK(grown.words.row(1)[0] == 50);
}

TEST_CASE("without new descriptors a codebook stays bit for bit, also of bytes") {
    ism::Random random(4);
    const auto words = ism::build_codebook(random_points(300, random), 900, 2);
    REQUIRE(words.size() > 5);
    const auto [same, word_now] = ism::grow_codebook(words, ism::Descriptors<float, 8>(), 2);
    check_equal(same, words);
    for (std::uint32_t w = 0; w < words.size(); ++w) CHECK(word_now[w] == w);
    const auto bytes = ism::in_bytes(words);
    check_equal(ism::grow_codebook(bytes, ism::Descriptors<float, 8>(), 2).codebook, bytes);
}

TEST_CASE("a codebook grown from nothing is the one that is built; the same for 1 and 2 threads") {
    ism::Random random(5);
    const auto first = random_points(400, random), second = random_points(300, random);
    const auto built = ism::build_codebook(first, 900, 2);
    ism::Codebook<8> none;
    none.max_sq_distance = 900;
    check_equal(ism::grow_codebook(none, first, 2).codebook, built);

    const auto one = ism::grow_codebook(built, second, 2, 1), two = ism::grow_codebook(built, second, 2, 2);
    check_equal(one.codebook, two.codebook);
    CHECK(one.word_now == two.word_now);
    std::size_t descriptors = 0;
    for (const std::uint32_t size : one.codebook.sizes) descriptors += size;
    CHECK(descriptors > 500);
    CHECK(descriptors <= 700);
    const auto bytes = ism::grow_codebook(ism::in_bytes(built), second, 2).codebook;
    CHECK(bytes.size() > 0);
    CHECK(bytes.sizes.size() == bytes.size());
}

TEST_CASE("codebooks that cannot grow are refused") {
    auto words = ism::build_codebook(points({0, 0, 10, 0}), 2.0, 1);
    CHECK_THROWS_AS(ism::grow_codebook(words, points({std::numeric_limits<float>::quiet_NaN(), 0}), 2),
                    ism::Error);
    words.group = {0, 1};
    CHECK_THROWS_WITH(ism::grow_codebook(words, points({0, 0}), 2),
                      Catch::Contains("group of a word: expected 0, got 1"));
    words.group = {0, 0};
    words.sizes.clear();
    CHECK_THROWS_WITH(ism::grow_codebook(words, points({0, 0}), 2),
                      Catch::Contains("size and length are known: expected 2, got 0"));
}
