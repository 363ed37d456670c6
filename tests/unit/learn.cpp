// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <vector>

#include "support/catch.hpp"

#include "ism/train/train.hpp"

TEST_CASE("occurrences weigh by hand: a feature has one vote, classes count alike, a word's add up to 1") {
    ism::Shapes shapes;
    shapes.class_names = {"a", "b"};
    const auto add = [&](std::uint32_t feature, std::uint32_t class_index) {
        ism::Occurrence o;
        o.feature = feature, o.class_index = class_index;
        shapes.occurrences.push_back(o);
    };
    add(0, 0), add(1, 0), add(2, 1);  // word 0
    add(0, 0), add(2, 1);             // word 1
    shapes.first = {0, 3, 5};
    ism::detail::weigh_occurrences(shapes);
    // Features 0 and 2 look like two words. Class a has 1/2 + 1 + 1/2 = 2, class b 1: word 0 has
    // 1/4, 1/2 and 1/2, word 1 has 1/4 and 1/2, before they are brought to 1.
    const std::vector<double> expected = {0.2, 0.4, 0.4, 1.0 / 3, 2.0 / 3};
    for (std::size_t i = 0; i < expected.size(); ++i)
        CHECK(shapes.occurrences[i].weight == Approx(expected[i]));
    const auto once = shapes.occurrences;
    ism::detail::weigh_occurrences(shapes);
    for (std::size_t i = 0; i < once.size(); ++i) CHECK(shapes.occurrences[i].weight == once[i].weight);
}
