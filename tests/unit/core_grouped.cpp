// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <utility>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/grouped.hpp"

TEST_CASE("groups that were moved away are none, and can be added to again") {
    ism::Grouped<int> groups;
    groups.push_back({1, 2});
    groups.push_back({});
    const ism::Grouped<int> moved = std::move(groups);
    CHECK(moved.size() == 2);
    CHECK(groups.empty());
    groups.push_back({3});
    REQUIRE(groups.size() == 1);
    CHECK(groups[0].front() == 3);
}
