// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "ism/config.hpp"

namespace ism {

/// @brief The probability with these odds, given as their logarithm: 1 / (1 + e⁻ˣ).
[[nodiscard]] inline double logistic(double log_odds) {
    return 1 / (1 + std::exp(-log_odds));
}

/// @brief log(1 + eˣ), for any x: what it costs to be told no by log odds of x.
[[nodiscard]] inline double softplus(double x) {
    return std::max(x, 0.0) + std::log1p(std::exp(-std::abs(x)));
}

}  // namespace ism
