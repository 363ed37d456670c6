// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <vector>

#include "support/catch.hpp"

#include "ism/train/occurrence_weights.hpp"

TEST_CASE("occurrences weigh by hand: a feature has one vote, classes count alike, a word's add up to 1") {
    ism::ShapeModel shapes;
    shapes.class_names = {"a", "b"};
    const auto seen = [](std::uint32_t feature, std::uint32_t class_index) {
        ism::Occurrence o;
        o.feature = feature, o.class_index = class_index;
        return o;
    };
    shapes.occurrences = {{seen(0, 0), seen(1, 0), seen(2, 1), seen(0, 0), seen(2, 1)}, {0, 3, 5}};
    ism::weigh_occurrences(shapes);
    // Features 0 and 2 look like two words. Class a has 1/2 + 1 + 1/2 = 2, class b 1: word 0 has
    // 1/4, 1/2 and 1/2, word 1 has 1/4 and 1/2, before they are brought to 1.
    const std::vector<double> expected = {0.2, 0.4, 0.4, 1.0 / 3, 2.0 / 3};
    for (std::size_t i = 0; i < expected.size(); ++i)
        CHECK(shapes.occurrence(i).weight == Approx(expected[i]));
    const ism::ShapeModel once = shapes;
    ism::weigh_occurrences(shapes);
    for (std::size_t i = 0; i < expected.size(); ++i)
        CHECK(shapes.occurrence(i).weight == once.occurrence(i).weight);
}

TEST_CASE("every match is an occurrence of its word, in the order of features") {
    std::vector<ism::Occurrence> features(3);
    for (std::uint32_t i = 0; i < 3; ++i) features[i].feature = i;
    const std::vector<ism::Match> matches = {{0, 2}, {1, 0}, {1, 2}, {2, 0}};
    const auto words = ism::group_by_word(features, matches, 4);
    REQUIRE(words.size() == 4);
    CHECK(words[1].empty());
    CHECK(words[3].empty());
    CHECK((words[0].size() == 2 && words[0][0].feature == 1 && words[0][1].feature == 2));
    CHECK((words[2].size() == 2 && words[2][0].feature == 0 && words[2][1].feature == 1));
}
