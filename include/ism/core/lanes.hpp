// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>

#include "ism/core/callable.hpp"
#include "ism/core/processor.hpp"

namespace ism::detail {

/// Sums side by side, which a compiler adds at once with whatever instructions there are: what is in a lane,
/// and hence the whole, does not depend on them.
template <std::floating_point T, std::size_t N>
requires(std::has_single_bit(N)) struct Lanes {
    std::array<T, N> sums{};

    [[nodiscard]] T& operator[](std::size_t lane) { return sums[lane]; }

    /// All lanes, in one order: the upper half onto the lower, again and again.
    template <std::floating_point Total = T>
    [[nodiscard]] Total sum() const {
        Total left[N];
        for (std::size_t l = 0; l < N; ++l) left[l] = sums[l];
#pragma GCC unroll 8
        for (std::size_t half = N / 2; half > 0; half /= 2)
            for (std::size_t l = 0; l < half; ++l) left[l] += left[l + half];
        return left[0];
    }
};

/// Σ term(k) over k < size in N lanes.
template <std::floating_point T, std::size_t N, Callable<std::size_t> Term>
[[nodiscard]] ISM_DETAIL_INLINE T sum_in_lanes(std::size_t size, const Term& term) {
    Lanes<T, N> lanes;
    std::size_t k = 0;
    for (; k + N <= size; k += N)
        for (std::size_t l = 0; l < N; ++l) lanes[l] += term(k + l);
    for (std::size_t l = 0; k + l < size; ++l) lanes[l] += term(k + l);
    return lanes.sum();
}

}  // namespace ism::detail
