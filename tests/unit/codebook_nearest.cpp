// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "support/catch.hpp"

#include "ism/codebook/nearest_words.hpp"
#include "ism/core/random.hpp"

namespace {

using ism::Neighbour;
using ism::WordRange;
using Rows = ism::Descriptors<float>;

constexpr double no_threshold = std::numeric_limits<double>::infinity();

/// By the definition of the distance, one pair after another; then all are sorted.
std::vector<Neighbour> sorted_neighbours(const ism::Codebook& words, const Rows& descriptors,
                                         std::size_t count, WordRange without) {
    std::vector<Neighbour> all;
    for (std::size_t i = 0; i < descriptors.size(); ++i) {
        std::vector<std::pair<double, std::uint32_t>> order;
        for (std::uint32_t w = 0; w < words.size(); ++w) {
            if (w >= without.first && w < without.end) continue;
            double distance = words[w].mean_sq_length;
            bool finite = true;
            for (std::size_t k = 0; k < words.dimension(); ++k) {
                const float d = descriptors.row(i)[k];
                finite = finite && std::isfinite(d);
                distance += double(d) * d - 2 * double(d) * double(words[w].mean[k]);
            }
            order.emplace_back(finite ? distance : no_threshold, finite ? w : ism::no_word);
        }
        std::sort(order.begin(), order.end());
        order.resize(std::min(order.size(), count));
        for (const auto& [distance, word] : order) all.push_back({word, float(distance)});
    }
    return all;
}

/// Every instruction set and numbers of threads against the definition: the distances too, where `exact`;
/// elsewhere the sums may be rounded in another order. All must have the same bits.
void check_against_sorted(const ism::Codebook& words, const Rows& descriptors, std::size_t count,
                          WordRange without, bool exact) {
    const auto expected = sorted_neighbours(words, descriptors, count, without);
    std::vector<Neighbour> before;
    for (const auto isa :
         {ism::InstructionSet::any, ism::InstructionSet::avx2, ism::InstructionSet::avx512_vnni}) {
        if (!ism::has_instruction_set(isa)) continue;
        const ism::WordIndex index(words, isa);
        for (const unsigned threads : {1u, 2u}) {
            ism::ThreadPool pool(threads);
            const auto found = ism::nearest_words(index, descriptors, count, pool, without);
            CAPTURE(int(isa), threads, words.size(), words.dimension(), descriptors.size(), count);
            REQUIRE(found.size() == expected.size());
            CHECK(found.size() == descriptors.size() * ism::neighbours_each(index, count, without));
            std::size_t wrong = 0;
            for (std::size_t i = 0; i < found.size(); ++i) {
                const float error = found[i].sq_distance - expected[i].sq_distance;  // NaN of two infinities
                wrong += found[i].word != expected[i].word || std::abs(error) > 1e-5f;
            }
            CHECK(wrong == 0);
            if (exact) CHECK(found == expected);
            if (before.empty()) before = found;
            CHECK(found == before);
        }
    }
}

/// Single descriptors as words.
ism::Codebook words_of(const Rows& rows, double max_sq_distance = no_threshold) {
    ism::Codebook words(rows.dimension(), max_sq_distance);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        double sq_length = 0;
        for (const float v : rows.row(i)) sq_length += double(v) * v;
        words.push_back({rows.row(i), float(sq_length)});
    }
    return words;
}

/// Few whole numbers, which give many equal distances.
Rows whole_rows(std::size_t dimension, std::size_t count, std::size_t levels, ism::Random& random) {
    Rows rows(dimension, count);
    for (float& v : rows.values()) v = float(random.index(levels)) - 1;
    return rows;
}

/// Somewhat as RootSIFT (synthetic).
Rows unit_rows(std::size_t count, ism::Random& random) {
    Rows rows(128, count);
    for (std::size_t i = 0; i < count; ++i) {
        double sum = 0;
        for (float& v : rows.row(i)) v = float(std::exp(1.2 * random.normal())), sum += double(v);
        for (float& v : rows.row(i)) v = float(std::sqrt(double(v) / sum));
    }
    return rows;
}

}  // namespace

TEST_CASE("nearest words are those of sorting all distances, the first of equally near ones first") {
    ism::Random random(1);
    for (const std::size_t dimension : {1u, 3u, 16u, 130u})
        for (const std::size_t words : {1u, 64u, 65u, 400u})
            for (const std::size_t descriptors : {1u, 100u}) {
                const auto codebook = words_of(whole_rows(dimension, words, 4, random));
                const Rows asked = whole_rows(dimension, descriptors, 4, random);
                const auto first = std::uint32_t(random.index(words));
                const auto end = first + std::uint32_t(random.index(200));
                check_against_sorted(codebook, asked, 1 + random.index(12), {}, true);
                check_against_sorted(codebook, asked, 64, {first, end}, true);
            }
}

TEST_CASE("nearest words of descriptors of unit length, whatever the order of the words and the threshold") {
    ism::Random random(2);
    Rows rows = unit_rows(1000, random);
    const Rows asked = unit_rows(50, random);
    for (std::size_t i = 100; i < 130; ++i)  // duplicates, also of what is asked
        std::copy(rows.row(i).begin(), rows.row(i).end(), rows.row(i * 7).begin());
    for (std::size_t i = 0; i < 20; ++i)
        std::copy(asked.row(i).begin(), asked.row(i).end(), rows.row(960 + i).begin());
    for (const double max_sq_distance : {0.0, 0.4, no_threshold})
        check_against_sorted(words_of(rows, max_sq_distance), asked, 9, {}, false);

    // each word nearer to what is asked than the one before, so that every one is on the list for a while
    Rows nearing(128);
    for (std::size_t i = 0; i < 500; ++i) {
        std::vector<float> row(128);
        const float part = 1 - float(i) / 600;
        for (std::size_t k = 0; k < 128; ++k) row[k] = (1 - part) * asked.row(0)[k] + part * rows.row(i)[k];
        nearing.push_back(row);
    }
    check_against_sorted(words_of(nearing), asked, 9, {}, false);
    check_against_sorted(words_of(nearing), asked, 9, {400, 500}, false);
}

TEST_CASE("nearest words of clusters, and of numbers far apart") {
    ism::Random random(3);
    Rows rows = whole_rows(16, 300, 50, random);
    ism::Codebook clusters(16, no_threshold);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        double sq_length = double(random.index(2000));
        for (const float v : rows.row(i)) sq_length += double(v) * v;
        clusters.push_back({rows.row(i), float(sq_length)});
    }
    Rows asked = whole_rows(16, 100, 50, random);
    check_against_sorted(clusters, asked, 9, {}, true);

    for (float& v : rows.row(7)) v = 30000;
    check_against_sorted(words_of(rows), asked, 9, {}, true);
    for (float& v : rows.row(7)) v = 1e18f;  // its squared length still is a float
    for (float& v : asked.row(3)) v = 1e19f;
    check_against_sorted(words_of(rows), asked, 9, {}, false);
}

TEST_CASE("a range of words is left out, and there may be fewer words than asked for") {
    ism::Random random(4);
    const Rows rows = whole_rows(8, 200, 3, random);
    const auto codebook = words_of(rows);
    for (const WordRange without :
         {WordRange{0, 200}, WordRange{0, 199}, WordRange{63, 65}, WordRange{64, 128}, WordRange{190, 900},
          WordRange{300, 900}, WordRange{50, 20}})
        for (const std::size_t count : {0u, 9u, 1000u})
            check_against_sorted(codebook, rows, count, without, true);
    ism::ThreadPool pool;
    const ism::WordIndex index(codebook), empty(ism::Codebook(8, 1));
    CHECK(ism::neighbours_each(index, 9, {0, 195}) == 5);
    const auto found = ism::nearest_words(index, rows, 5, pool, {20, 60});
    CHECK(std::none_of(found.begin(), found.end(),
                       [](const Neighbour& n) { return n.word >= 20 && n.word < 60; }));
    CHECK(ism::nearest_words(empty, rows, 5, pool).empty());
    CHECK(ism::nearest_words(index, Rows(8), 5, pool).empty());
    CHECK(ism::nearest_words(index, Rows(), 5, pool).empty());
    CHECK_THROWS_WITH(ism::nearest_words(index, Rows(9, 1), 5, pool),
                      Catch::Contains("dimension of descriptors: expected 8, got 9"));
}

TEST_CASE("descriptors that are not finite have no neighbours") {
    ism::Random random(5);
    const auto codebook = words_of(whole_rows(16, 100, 5, random));
    Rows asked = whole_rows(16, 110, 5, random);
    asked.row(0)[3] = asked.row(50)[15] = std::numeric_limits<float>::quiet_NaN();
    asked.row(1)[0] = std::numeric_limits<float>::infinity();
    asked.row(109)[7] = -std::numeric_limits<float>::infinity();
    check_against_sorted(codebook, asked, 3, {}, true);
    ism::ThreadPool pool;
    const auto found = ism::nearest_words(ism::WordIndex(codebook), asked, 3, pool);
    for (const std::size_t i : {0u, 1u, 50u, 109u}) CHECK(found[3 * i + 2] == Neighbour{});
    CHECK(found[3 * 2].word < 100);
}

TEST_CASE("without a threshold bytes are used unless one word is far from all others") {
    ism::Random random(6);
    Rows rows = unit_rows(200, random);
    CHECK(ism::WordIndex(words_of(rows)).uses_bytes() ==
          (ism::best_instruction_set() != ism::InstructionSet::any));
    rows.row(5)[0] = 1000;
    CHECK_FALSE(ism::WordIndex(words_of(rows)).uses_bytes());
}
