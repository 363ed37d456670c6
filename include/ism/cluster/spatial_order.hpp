// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "ism/config.hpp"

namespace ism::detail {

/// Orders rows so that those near each other stand together: halves at the median of the coordinate that
/// spreads most, then each half again, down to groups of `group` (a k-d tree's leaves; Bentley 1975).
/// @param coordinates  rows one after another, `dimension` numbers each
/// @param order  numbers of the rows to order, in place
inline void order_spatially(std::span<const float> coordinates, std::size_t dimension, std::size_t group,
                            std::span<std::uint32_t> order) {
    if (order.size() <= group) return;
    const auto value = [&](std::uint32_t row, std::size_t k) { return coordinates[row * dimension + k]; };
    std::size_t widest = 0;
    double most = -1;
    for (std::size_t k = 0; k < dimension; ++k) {
        double sum = 0, square = 0;
        for (const std::uint32_t row : order)
            sum += value(row, k), square += double(value(row, k)) * value(row, k);
        if (const double spread = square - sum * sum / double(order.size()); spread > most)
            most = spread, widest = k;
    }
    // whole groups on the left, so that only the last group of all is not full
    const std::size_t half = (order.size() / group + 1) / 2 * group;
    std::nth_element(order.begin(), order.begin() + std::ptrdiff_t(half), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                         return value(a, widest) != value(b, widest) ? value(a, widest) < value(b, widest)
                                                                     : a < b;
                     });
    order_spatially(coordinates, dimension, group, order.first(half));
    order_spatially(coordinates, dimension, group, order.subspan(half));
}

}  // namespace ism::detail
