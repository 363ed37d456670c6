// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/train/grow_appearance.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/train/remembered_boxes.hpp"

namespace {

using ism::Appearance;
using ism::AppearanceSample;
using ism::BinValue;

/// Boxes of `classes` classes, each with its own word in most, and of background taken for each.
std::vector<AppearanceSample> random_samples(std::uint32_t classes, std::size_t words) {
    ism::Random random(3);
    std::vector<AppearanceSample> samples;
    for (std::uint32_t i = 0; i < 90; ++i) {
        const bool background = i % 4 == 3;
        const auto c = std::uint32_t(random.index(classes)), other = std::uint32_t(random.index(words));
        AppearanceSample sample{
            .box = {}, .shows = background ? AppearanceSample::background : c, .taken_for = c};
        sample.box.push_back({background ? other : c, 0.7f});
        sample.box.push_back({std::uint32_t(words * (1 + random.index(4))) + other, 0.7f});
        samples.push_back(sample);
    }
    return samples;
}

}  // namespace

TEST_CASE("judges move with their words, by hand") {
    Appearance before;
    for (const float bias : {0.5f, -1.0f}) {
        std::vector<BinValue> weights;  // the second class has learnt nothing of word 2
        for (std::uint32_t bin = 0; bin < Appearance::cells * 3; ++bin)
            if (bias > 0 || bin % 3 != 2) weights.push_back({bin, float(bin)});
        before.push_back(weights, bias);
    }
    // words 0 and 2 are one now, word 1 is the second of four
    const std::vector<std::uint32_t> word_now = {0, 1, 0};
    const Appearance now = ism::moved_appearance(before, word_now, 4);
    CHECK(now.bias == before.bias);
    for (std::size_t c = 0; c < 2; ++c) {
        REQUIRE(now.of_class(c).size() == Appearance::cells * 2);
        for (std::uint32_t cell = 0; cell < Appearance::cells; ++cell) {
            const BinValue *own = now.of_class(c).data() + cell * 2, first = {cell * 3, float(cell * 3)};
            CHECK(own[0] == BinValue{cell * 4, c == 0 ? first.value + 1 : first.value / 2});
            CHECK(own[1] == BinValue{cell * 4 + 1, first.value + 1});
        }
    }
    CHECK(ism::moved_appearance({}, word_now, 4).empty());
    CHECK_THROWS_WITH(ism::moved_appearance(before, std::vector<std::uint32_t>{0}, 4),
                      "judge of boxes: bin: expected below 5, got 5");
    CHECK_THROWS_WITH(ism::moved_appearance(before, {}, 4), Catch::Contains("words of before"));
    CHECK_THROWS_WITH(ism::moved_appearance(before, word_now, 1), Catch::Contains("word now"));
}

TEST_CASE("new judges are those that would be fitted to all classes, present ones stay") {
    const std::size_t words = 6;
    const auto samples = random_samples(4, words);
    const Appearance all = ism::fit_appearance(samples, words, 4, {}, 1);
    Appearance present;
    present.push_back(std::vector<BinValue>{{1, 0.25f}, {7, 0.5f}}, 1);
    present.push_back(std::vector<BinValue>{{3, 2}}, 2);
    const Appearance grown = ism::with_new_judges(present, samples, words, 4, {}, 1);
    REQUIRE(grown.classes() == 4);
    for (std::size_t c = 0; c < 4; ++c) {
        const Appearance& expected = c < 2 ? present : all;
        CHECK(grown.bias[c] == expected.bias[c]);
        CHECK(std::ranges::equal(grown.of_class(c), expected.of_class(c)));
    }
    CHECK(ism::with_new_judges(present, samples, words, 4, {}, 2).weights == grown.weights);
    CHECK(ism::with_new_judges(present, samples, words, 2).weights == present.weights);
    CHECK_THROWS_AS(ism::with_new_judges(present, samples, words, 1), ism::Error);
    CHECK_THROWS_AS(ism::with_new_judges(present, samples, words - 1, 4), ism::Error);
}

TEST_CASE("boxes are remembered from occurrences, by hand") {
    ism::Shapes shapes;
    shapes.class_names = {"a", "b"};
    for (const std::uint32_t c : {0u, 1u, 1u}) {
        ism::TrainingObject object;
        object.class_index = c, object.width = 100, object.height = 50;
        shapes.objects.push_back(object);
    }
    const auto seen = [](std::uint32_t object, std::uint32_t feature, float x, float y) {
        ism::Occurrence o;
        o.object = object, o.feature = feature, o.x = x, o.y = y;
        return o;
    };
    // Feature 1 of object 0 is at both words, feature 0 at the first; object 2 is at no word.
    shapes.occurrences = {seen(1, 2, 10, 10), seen(0, 0, -10, -5), seen(0, 1, 20, 5), seen(0, 1, 20, 5)};
    shapes.first = {0, 3, 4};
    const auto boxes = ism::remembered_boxes(shapes);
    REQUIRE(boxes.size() == 2);
    CHECK((boxes[0].shows == 0 && boxes[0].taken_for == 0 && boxes[1].shows == 1));
    // of two features, each counted in the box and in a quarter: 1 + 1/2 and 1/2 of 4
    const std::vector<std::pair<std::uint32_t, double>> expected = {
        {0, 1.5 / 4}, {1, 0.5 / 4}, {2, 1.0 / 4}, {8, 0.5 / 4}, {9, 0.5 / 4}};
    REQUIRE(boxes[0].box.size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        CHECK(boxes[0].box[i].bin == expected[i].first);
        CHECK(boxes[0].box[i].value == Approx(std::sqrt(expected[i].second)));
    }
    shapes.occurrences.clear();
    shapes.first = {0, 0, 0};
    CHECK(ism::remembered_boxes(shapes).empty());
}
