// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "ism/config.hpp"

namespace ism::detail {

/// The solution of A x = b by Cholesky's factors, A = L Lᵀ.
/// @param a  symmetric and positive definite, of which the lower triangle is read
template <std::size_t n>
[[nodiscard]] std::array<double, n> solve_positive_definite(std::array<std::array<double, n>, n> a,
                                                            std::array<double, n> b) {
    std::array<std::array<double, n>, n>& l = a;  // in its place, row by row
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            double rest = a[i][j];
            for (std::size_t k = 0; k < j; ++k) rest -= l[i][k] * l[j][k];
            l[i][j] = i == j ? std::sqrt(std::max(rest, 1e-12)) : rest / l[j][j];
        }
    std::array<double, n>& x = b;
    for (std::size_t i = 0; i < n; ++i) {  // L y = b
        for (std::size_t k = 0; k < i; ++k) x[i] -= l[i][k] * x[k];
        x[i] /= l[i][i];
    }
    for (std::size_t i = n; i-- > 0;) {  // Lᵀ x = y
        for (std::size_t k = i + 1; k < n; ++k) x[i] -= l[k][i] * x[k];
        x[i] /= l[i][i];
    }
    return x;
}

}  // namespace ism::detail
