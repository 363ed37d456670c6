// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "ism/config.hpp"

namespace ism {

/// @brief What a mask is like, in numbers that differ little between objects of one class, wherever and in
/// whatever size they are seen.
struct MaskMeasures {
    double extent = 0;  ///< share of its box that it covers, 0 … 1
    double certainty = 0;  ///< mean |2 p(figure) − 1| in the box, 0 … 1: how well colours tell it from ground
    double raggedness = 0;  ///< logarithm of perimeter² / area
    [[nodiscard]] bool operator==(const MaskMeasures&) const = default;

    /// @brief All of them, to be computed with.
    [[nodiscard]] constexpr std::array<double, 3> values() const { return {extent, certainty, raggedness}; }
};

/// @brief What masks of a class are like: mean and standard deviation of each measure. Not known where a
/// deviation is 0.
struct TypicalMask {
    MaskMeasures mean = {}, deviation = {};
    [[nodiscard]] bool operator==(const TypicalMask&) const = default;

    [[nodiscard]] bool known() const {
        return deviation.extent > 0 && deviation.certainty > 0 && deviation.raggedness > 0;
    }
};

}  // namespace ism
