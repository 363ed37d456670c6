// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <type_traits>
#include <utility>
#include <vector>

#include "support/catch.hpp"

#include "ism/codebook/match.hpp"
#include "ism/core/random.hpp"

namespace {

using ism::Codebook;
using ism::Descriptors;
using ism::InstructionSet;
using ism::Match;

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();

std::vector<InstructionSet> instruction_sets_here() {
    std::vector<InstructionSet> units;
    for (const InstructionSet isa : {InstructionSet::any, InstructionSet::avx2, InstructionSet::avx512_vnni})
        if (ism::has_instruction_set(isa)) units.push_back(isa);
    return units;
}

/// All matches by the definition of the distance, one pair after another.
std::vector<Match> naive_matches(const Codebook& codebook, const Descriptors<float>& descriptors) {
    std::vector<Match> all;
    for (std::uint32_t i = 0; i < descriptors.size(); ++i) {
        std::map<std::uint32_t, std::vector<std::pair<double, std::uint32_t>>> of_group;
        std::vector<std::uint32_t> hits;
        for (std::uint32_t w = 0; w < codebook.size(); ++w) {
            const ism::Word word = codebook[w];
            double distance = word.mean_sq_length;
            for (std::size_t k = 0; k < codebook.dimension(); ++k) {
                const double d = descriptors.row(i)[k];
                distance += d * d - 2 * d * double(word.mean[k]);
            }
            if (!(distance <= codebook.max_sq_distance())) continue;
            of_group[word.group].emplace_back(distance, w);
            hits.push_back(w);
        }
        for (const std::uint32_t w : hits) {
            const auto& own = of_group[codebook[w].group];
            all.push_back(
                {i, w, 1.0f / float(own.size()), std::min_element(own.begin(), own.end())->second == w});
        }
    }
    return all;
}

/// Every instruction set and numbers of threads against the definition.
std::size_t check_against_naive(const Codebook& codebook, const Descriptors<float>& descriptors) {
    const auto all = naive_matches(codebook, descriptors);
    for (const InstructionSet isa : instruction_sets_here()) {
        CAPTURE(int(isa), codebook.size(), codebook.max_sq_distance(), codebook.dimension());
        const ism::WordIndex index(codebook, isa);
        for (const unsigned threads : {1u, 2u}) {
            ism::ThreadPool pool(threads);
            CHECK(ism::match(index, descriptors, pool) == all);
        }
    }
    CHECK(ism::match(codebook, descriptors) == all);
    return all.size();
}

/// Words that stand for descriptors a little around them, in `groups` groups, and descriptors near some.
struct RandomScene {
    std::size_t dimension = 0;
    double max_sq_distance = 0;
    std::vector<std::vector<float>> means;
    std::vector<float> mean_sq_lengths;
    std::vector<std::uint32_t> groups;
    Descriptors<float> descriptors;

    [[nodiscard]] Codebook codebook() const {
        Codebook words(dimension, max_sq_distance);
        for (std::size_t w = 0; w < means.size(); ++w)
            words.push_back({means[w], mean_sq_lengths[w], 1, groups[w]});
        return words;
    }
};

RandomScene random_scene(std::size_t dimension, std::size_t words, std::size_t descriptors,
                         std::uint32_t groups, double max_sq_distance, ism::Random& random) {
    RandomScene scene;
    scene.dimension = dimension, scene.max_sq_distance = max_sq_distance;
    scene.descriptors = Descriptors<float>(dimension);
    for (std::size_t w = 0; w < words; ++w) {
        double sq_length = random.uniform(0, 0.2);
        scene.means.emplace_back(dimension);
        for (float& v : scene.means[w]) {
            v = float(std::abs(random.normal()) / std::sqrt(double(dimension)));
            sq_length += double(v) * v;
        }
        scene.mean_sq_lengths.push_back(float(sq_length));
        scene.groups.push_back(std::uint32_t(w) % groups);
    }
    for (std::size_t i = 0; i < descriptors; ++i) {
        std::vector<float> row(dimension, 0.1f);
        if (words > 0) {
            const auto& word = scene.means[random.index(words)];
            for (std::size_t k = 0; k < dimension; ++k)
                row[k] = word[k] + float(0.4 * random.normal() / std::sqrt(double(dimension)));
        }
        scene.descriptors.push_back(row);
    }
    return scene;
}

Codebook two_numbers(const std::vector<float>& values, double max_sq_distance) {
    Codebook codebook(2, max_sq_distance);
    for (std::size_t i = 0; i < values.size(); i += 2)
        codebook.push_back(
            {std::span(values).subspan(i, 2), values[i] * values[i] + values[i + 1] * values[i + 1]});
    return codebook;
}

void check_random_scenes(std::size_t dimension, ism::Random& random) {
    std::size_t found = 0;
    for (const std::size_t words : {1u, 63u, 64u, 65u, 500u})
        for (const std::size_t descriptors : {1u, 5u, 96u, 97u, 230u})
            for (const double max_sq_distance : {0.15, 0.4, 1.0}) {
                const auto scene = random_scene(dimension, words, descriptors,
                                                1 + std::uint32_t(descriptors) % 3, max_sq_distance, random);
                found += check_against_naive(scene.codebook(), scene.descriptors);
            }
    CHECK(found > 10000);
}

}  // namespace

TEST_CASE("matching finds all words within the threshold, whatever the processor offers") {
    ism::Random random(3);
    check_random_scenes(1, random);
    check_random_scenes(7, random);
    check_random_scenes(128, random);
}

TEST_CASE("matching of descriptors that are whole numbers finds all words within the threshold") {
    ism::Random random(4);
    auto scene = random_scene(128, 700, 200, 2, 150000, random);
    for (auto& mean : scene.means)
        for (float& v : mean) v *= 512;
    for (float& v : scene.mean_sq_lengths) v *= 512 * 512;
    for (float& v : scene.descriptors.values()) v = std::floor(std::clamp(512 * v + 0.5f, 0.0f, 255.0f));
    CHECK(check_against_naive(scene.codebook(), scene.descriptors) > 200);
    for (auto& mean : scene.means)
        for (float& v : mean) v = std::floor(std::min(v, 255.0f));
    CHECK(check_against_naive(scene.codebook(), scene.descriptors) > 200);
}

TEST_CASE("equal words and exact ties are matched alike, and the first is the nearest") {
    // all distances are whole numbers, many at the threshold itself
    const auto codebook = two_numbers({3, 0, 0, 0, 3, 0, 0, 4, 5, 5, 0, 0}, 9);
    const Descriptors<float> descriptors(2, {0, 0, 3, 0, 0, 1, 3, 4});
    const float third = 1.0f / 3, quarter = 0.25f, half = 0.5f;
    const std::vector<Match> expected{{0, 0, quarter, false}, {0, 1, quarter, true},  {0, 2, quarter, false},
                                      {0, 5, quarter, false}, {1, 0, quarter, true},  {1, 1, quarter, false},
                                      {1, 2, quarter, false}, {1, 5, quarter, false}, {2, 1, third, true},
                                      {2, 3, third, false},   {2, 5, third, false},   {3, 3, half, false},
                                      {3, 4, half, true}};
    ism::ThreadPool pool(1);
    for (const InstructionSet isa : instruction_sets_here())
        CHECK(ism::match(ism::WordIndex(codebook, isa), descriptors, pool) == expected);

    // the same in bytes: a lattice whose points are all at the same few distances
    ism::Random random(5);
    Codebook lattice(8, 40);
    for (std::size_t w = 0; w < 1000; ++w) {
        float sq_length = 0;
        std::vector<float> mean(8);
        for (float& v : mean) v = float(random.index(8)), sq_length += v * v;
        lattice.push_back({mean, sq_length});
    }
    Descriptors<float> asked(8, 300);
    for (float& v : asked.values()) v = float(random.index(8));
    CHECK(check_against_naive(lattice, asked) > 1000);
}

TEST_CASE("a descriptor that is not finite matches nothing and disturbs no other") {
    ism::Random random(6);
    auto scene = random_scene(16, 300, 200, 2, 0.6, random);
    scene.descriptors.row(0)[3] = not_a_number;
    scene.descriptors.row(70)[0] = infinite;
    scene.descriptors.row(71)[5] = -infinite;
    scene.descriptors.row(199)[15] = not_a_number;
    CHECK(check_against_naive(scene.codebook(), scene.descriptors) > 100);
    for (const Match& m : ism::match(scene.codebook(), scene.descriptors))
        CHECK((m.feature != 0 && m.feature != 70 && m.feature != 71 && m.feature != 199));
    for (float& v : scene.descriptors.values()) v = not_a_number;
    CHECK(check_against_naive(scene.codebook(), scene.descriptors) == 0);
}

TEST_CASE("numbers of any size are matched exactly") {
    ism::Random random(7);
    for (const float scale : {1e-30f, 1e-12f, 1e6f, 1e12f, 1e17f}) {
        auto scene = random_scene(8, 200, 120, 1, 0.5 * double(scale) * double(scale), random);
        for (auto& mean : scene.means)
            for (float& v : mean) v *= scale;
        for (float& v : scene.mean_sq_lengths) v *= scale * scale;
        for (float& v : scene.descriptors.values()) v *= scale;
        CAPTURE(scale);
        check_against_naive(scene.codebook(), scene.descriptors);
        // one that is far larger or smaller than the words
        for (const float other : {1e-36f, 1e-18f, 1e18f, 3e38f}) {
            scene.descriptors.row(7)[2] = other;
            check_against_naive(scene.codebook(), scene.descriptors);
        }
    }
}

TEST_CASE("numbers that are large beside their differences are matched exactly") {
    ism::Random random(8);
    auto scene = random_scene(8, 300, 120, 1, 40, random);
    for (std::size_t w = 0; w < 300; ++w) {
        double sq_length = 0;
        for (float& v : scene.means[w]) v = 1000 + std::floor(10 * v), sq_length += double(v) * v;
        scene.mean_sq_lengths[w] = float(sq_length);
    }
    for (float& v : scene.descriptors.values()) v = 1000 + std::floor(10 * v);
    CHECK(check_against_naive(scene.codebook(), scene.descriptors) > 100);
}

TEST_CASE("thresholds that match nothing or everything, and codebooks without words") {
    ism::Random random(9);
    auto scene = random_scene(16, 130, 100, 3, 0, random);
    CHECK(check_against_naive(scene.codebook(), scene.descriptors) == 0);
    for (const double all : {1e3, 1e300, std::numeric_limits<double>::infinity()}) {
        scene.max_sq_distance = all;
        CHECK(check_against_naive(scene.codebook(), scene.descriptors) == 130 * 100);
    }
    CHECK(ism::match(scene.codebook(), Descriptors<float>(16)).empty());
    CHECK(ism::match(scene.codebook(), Descriptors<float>()).empty());
    CHECK(ism::match(Codebook(16, 1), scene.descriptors).empty());
    CHECK(ism::match(Codebook(16, 1), Descriptors<float>(16)).empty());

    const auto constant = two_numbers({0, 0, 0, 0}, 0);
    CHECK(ism::match(constant, Descriptors<float>(2, 1)).size() == 2);
}

TEST_CASE("matching refuses what it cannot match") {
    ism::Random random(10);
    const auto scene = random_scene(4, 10, 100, 1, 1e9, random);
    using Catch::Contains;
    const ism::WordIndex index(scene.codebook());
    for (const unsigned threads : {1u, 2u}) {
        ism::ThreadPool pool(threads);
        CHECK(ism::match(index, scene.descriptors, pool, 1000).size() == 1000);
        CHECK_THROWS_WITH(ism::match(index, scene.descriptors, pool, 999),
                          Contains("number of matches") && Contains("at most 999"));
        CHECK_THROWS_WITH(ism::match(index, Descriptors<float>(5, 1), pool),
                          Contains("dimension of descriptors: expected 4, got 5"));
    }
    auto bad = scene;
    bad.max_sq_distance = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(ism::match(bad.codebook(), scene.descriptors), Contains("largest squared distance"));
    bad.max_sq_distance = -1;
    CHECK_THROWS_AS(ism::match(bad.codebook(), scene.descriptors), ism::Error);
    bad = scene;
    bad.means[3][1] = not_a_number;
    CHECK_THROWS_WITH(ism::match(bad.codebook(), scene.descriptors), Contains("words"));
    bad = scene;
    bad.mean_sq_lengths[3] = infinite;
    CHECK_THROWS_AS(ism::match(bad.codebook(), scene.descriptors), ism::Error);
    Codebook words(4, 1);
    CHECK_THROWS_WITH(words.push_back({std::vector<float>(3), 0}), Contains("expected 4, got 3"));
}

TEST_CASE("groups may have any numbers") {
    ism::Random random(11);
    auto scene = random_scene(16, 400, 60, 1, 0.7, random);
    for (std::uint32_t& group : scene.groups)
        group = std::uint32_t(random.index(50)) * 85899345u;  // up to 2³²
    CHECK(check_against_naive(scene.codebook(), scene.descriptors) > 500);
    CHECK(ism::WordIndex(scene.codebook()).group_count() == 50);
}

TEST_CASE("filters drop most of what is out of reach, and bytes are used where they can be") {
    ism::Random random(12);
    const auto scene = random_scene(128, 640, 96, 1, 0.35, random);
    const std::size_t hits = naive_matches(scene.codebook(), scene.descriptors).size();
    REQUIRE(hits > 50);
    std::vector<double> sq_lengths;
    const ism::WordIndex any(scene.codebook(), InstructionSet::any);
    for (std::size_t i = 0; i < 96; ++i) sq_lengths.push_back(any.sq_length(scene.descriptors.row(i).data()));
    for (const InstructionSet isa : instruction_sets_here()) {
        CAPTURE(int(isa));
        const ism::WordIndex index(scene.codebook(), isa);
        CHECK(index.uses_bytes() == (isa != InstructionSet::any));
        std::size_t candidates = 0;
        const auto count = [&](const auto& filter) {
            typename std::decay_t<decltype(filter)>::Block block;
            filter.prepare(scene.descriptors.values(), sq_lengths, 0.35, block);
            std::vector<std::uint64_t> masks(96);
            for (std::size_t group = 0; group < 10; ++group) {
                filter.masks(block, group, masks);
                for (const std::uint64_t mask : masks) candidates += std::size_t(std::popcount(mask));
            }
        };
        index.uses_bytes() ? count(index.byte_filter()) : count(index.float_filter());
        CHECK(candidates >= hits);
        CHECK(candidates <= 2 * hits + 100);
    }
}

TEST_CASE("byte kernels add up exactly, at the ends of their ranges too") {
    ism::Random random(13);
    for (const InstructionSet isa : instruction_sets_here()) {
        auto* const kernel = ism::detail::byte_kernel(isa);
        if (kernel == nullptr) continue;
        const int levels = ism::detail::byte_levels(isa);
        for (const std::size_t quads : {2u, 6u, 32u})
            for (const int pattern : {0, 1, 2}) {  // least, largest, random
                const auto draw = [&] {
                    const auto at = pattern == 2 ? random.index(std::size_t(levels)) : 0;
                    return pattern == 1 ? levels - 1 : int(at);
                };
                std::vector<std::uint8_t> queries(12 * quads * 4);
                for (auto& byte : queries) byte = std::uint8_t(pattern == 0 ? levels - 1 : draw());
                std::vector<std::int8_t> words(64 * quads * 4);
                for (auto& byte : words) byte = std::int8_t(draw() - levels / 2);
                std::vector<std::int32_t> bias(64), limits(12);
                for (auto& value : bias) value = std::int32_t(random.index(2000)) - 1000;
                for (std::size_t i = 0; i < 12; ++i) {
                    // a limit that word 5 just misses, or just exceeds
                    int sum = bias[5] - int(i % 2);
                    for (std::size_t k = 0; k < quads * 4; ++k)
                        sum += int(queries[i * quads * 4 + k]) * words[k / 4 * 256 + 5 * 4 + k % 4];
                    limits[i] = sum;
                }
                std::vector<std::uint64_t> masks(12), expected(12, 0);
                for (std::size_t i = 0; i < 12; ++i)
                    for (std::size_t j = 0; j < 64; ++j) {
                        int sum = bias[j];
                        for (std::size_t k = 0; k < quads * 4; ++k)
                            sum += int(queries[i * quads * 4 + k]) * words[k / 4 * 256 + j * 4 + k % 4];
                        expected[i] |= std::uint64_t(sum > limits[i]) << j;
                    }
                kernel({queries.data(), 12, quads, limits.data(), words.data(), bias.data(), masks.data()});
                CAPTURE(int(isa), quads, pattern);
                CHECK(masks == expected);
                CHECK(((expected[0] >> 5 & 1) == 0 && (expected[1] >> 5 & 1) == 1));
            }
    }
}
