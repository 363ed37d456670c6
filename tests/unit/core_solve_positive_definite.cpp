// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cstddef>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/core/solve_positive_definite.hpp"

TEST_CASE("equations of a positive definite matrix are solved") {
    constexpr std::size_t n = 7;
    ism::Random random(3);
    for (int trial = 0; trial < 20; ++trial) {
        std::array<std::array<double, n>, n> factor{}, a{};
        std::array<double, n> x{}, b{};
        for (auto& row : factor)
            for (double& number : row) number = random.uniform(-1, 1);
        for (double& number : x) number = random.uniform(-10, 10);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) {
                a[i][j] = i == j ? 0.1 : 0.0;
                for (std::size_t k = 0; k < n; ++k) a[i][j] += factor[i][k] * factor[j][k];
                b[i] += a[i][j] * x[j];
            }
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = i + 1; j < n; ++j) a[i][j] = 1e9;  // what is above the diagonal is not read
        const auto solution = ism::detail::solve_positive_definite(a, b);
        for (std::size_t i = 0; i < n; ++i) CHECK(solution[i] == Approx(x[i]).margin(1e-6));
    }
}
