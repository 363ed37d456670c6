// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/order.hpp"
#include "ism/core/random.hpp"

namespace detail = ism::detail;

TEMPLATE_TEST_CASE("keys rise with the numbers they stand for", "", float, double) {
    using Limits = std::numeric_limits<TestType>;
    const std::vector<TestType> numbers = {
        -Limits::infinity(),  Limits::lowest(), -1,  -Limits::denorm_min(), 0,
        Limits::denorm_min(), Limits::min(),    0.5, Limits::infinity()};
    for (const TestType a : numbers)
        for (const TestType b : numbers) {
            CHECK((detail::rising(a) < detail::rising(b)) == (a < b));
            CHECK((detail::falling(a) < detail::falling(b)) == (a > b));
        }
    CHECK(detail::rising(TestType(-0.0)) == detail::rising(TestType(0)));
}

TEST_CASE("the first of two keys counts more") {
    CHECK(detail::joined(1, 0) > detail::joined(0, ~0u));
    CHECK(detail::joined(1, 2) > detail::joined(1, 1));
}

TEST_CASE("sorting by a key leaves equal values in their order") {
    ism::Random random(3);
    for (const int count : {0, 1, 2, 15, 500}) {
        std::vector<std::pair<float, int>> values;
        for (int i = 0; i < count; ++i) values.emplace_back(float(int(random.uniform(-5, 5))), i);
        auto expected = values;
        std::stable_sort(expected.begin(), expected.end(),
                         [](const auto& a, const auto& b) { return a.first > b.first; });
        detail::sort_by(values, [](const auto& value) { return detail::falling(value.first); });
        CHECK(values == expected);
    }
}
