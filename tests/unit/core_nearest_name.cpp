// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/nearest_name.hpp"

TEST_CASE("typing errors are letters added, left out, replaced or swapped") {
    CHECK(ism::typing_errors("model", "model") == 0);
    CHECK(ism::typing_errors("modle", "model") == 1);
    CHECK(ism::typing_errors("mdel", "model") == 1);
    CHECK(ism::typing_errors("moodel", "model") == 1);
    CHECK(ism::typing_errors("nodel", "model") == 1);
    CHECK(ism::typing_errors("", "model") == 5);
    CHECK(ism::typing_errors("sunday", "saturday") == 3);
}

TEST_CASE("the name that was most likely meant is the nearest one, or none") {
    const std::vector<std::string> options = {"--model", "--data", "--min-score", "--depth", "--depth-scale"};
    CHECK(ism::nearest_name("--modle", options) == "--model");
    CHECK(ism::nearest_name("--min_score", options) == "--min-score");
    CHECK(ism::nearest_name("--depht", options) == "--depth");
    CHECK(ism::nearest_name("--depth-s", options) == "--depth-scale");  // begins so
    CHECK(ism::nearest_name("--camera", options).empty());
    CHECK(ism::nearest_name("", options).empty());
    const std::vector<std::string> classes = {"car", "cow", "x"};
    CHECK(ism::nearest_name("cra", classes) == "car");
    CHECK(ism::nearest_name("y", classes).empty());  // every letter is another one
    CHECK(ism::did_you_mean("caw", classes) == ": did you mean car?");
    CHECK(ism::did_you_mean("horse", classes).empty());
    CHECK(ism::nearest_name(std::string(100000, 'a'), classes).empty());
}
