// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "ism/config.hpp"
#include "ism/core/logistic.hpp"

namespace ism {

/// @brief Turns scores into probabilities, which can be compared between images and classes: for each class a
/// logistic curve over the logarithm of the score (Platt 1999). Empty = not known.
struct Calibration {
    /// @brief p = 1 / (1 + exp(−(slope · log(score) + offset)))
    struct Curve {
        double slope = 0, offset = 0;
        [[nodiscard]] bool operator==(const Curve&) const = default;
    };

    std::vector<Curve> curves;  ///< one a class

    [[nodiscard]] bool empty() const { return curves.empty(); }
    /// @brief Whether it tells hypotheses apart; curves are flat where there were too few examples.
    [[nodiscard]] bool tells_apart() const {
        return std::any_of(curves.begin(), curves.end(), [](const Curve& curve) { return curve.slope > 0; });
    }

    /// @brief The probability, 0 … 1, that a hypothesis of a class with this score shows an object of it; NaN
    /// where it is not known.
    [[nodiscard]] double probability(std::size_t class_index, double score) const {
        if (empty()) return std::nan("");
        if (!(score > 0)) return 0;
        const Curve& curve = curves[class_index];
        return logistic(curve.slope * std::log(score) + curve.offset);
    }
};

/// @brief The curve of templates that could not be tried on objects which they had not seen, since each class
/// has but one: about the mean of what models of two to five objects a class learn.
inline constexpr Calibration::Curve typical_template_curve{.slope = 2, .offset = 3};

}  // namespace ism
