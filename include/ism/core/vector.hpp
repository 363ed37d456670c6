// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

/// @file
/// @brief Vectors as GCC and clang have them in the language, with operators for most of what a processor
/// does. What has none is a builtin of both or a line of assembly in the kernel that needs it, for
/// <immintrin.h> costs every compilation 90 MB and 0.2 s. Vectors are loaded and stored with memcpy, and
/// given to functions by reference alone: how else depends on the instruction set.

#include <cstddef>
#include <cstring>

#include "ism/core/processor.hpp"

#if defined(__GNUC__)

namespace ism::detail {

template <class T, std::size_t N>
using Vector [[gnu::vector_size(N * sizeof(T))]] = T;

/// Floats in a register, of those that the compiler's flags allow.
#if defined(__AVX512F__)
inline constexpr std::size_t native_lanes = 16;
#elif defined(__AVX__)
inline constexpr std::size_t native_lanes = 8;
#else
inline constexpr std::size_t native_lanes = 4;
#endif

/// Makes the compiler forget what it knows of a value. g++ 12 has an instruction for a < b ? a : b, but where
/// b is a constant it compares, masks both and joins them.
template <class T, std::size_t N>
ISM_DETAIL_INLINE void forget(Vector<T, N>& value) {
    asm("" : "+m"(value));
}

/// The sum of all lanes in the order of Lanes::sum(): the upper half onto the lower, again and again.
template <class T, std::size_t N>
[[nodiscard]] ISM_DETAIL_INLINE T sum_of_lanes(const Vector<T, N>& lanes) {
    if constexpr (N == 2) {
        return lanes[0] + lanes[1];
    } else if constexpr (sizeof(lanes) == 16) {  // what is smaller than a register is slow
        const Vector<T, N> sums = lanes + Vector<T, N>{lanes[2], lanes[3], lanes[2], lanes[3]};
        return sums[0] + sums[1];
    } else {
        Vector<T, N / 2> halves[2];
        std::memcpy(halves, &lanes, sizeof(lanes));
        halves[0] += halves[1];
        return sum_of_lanes<T, N / 2>(halves[0]);
    }
}

}  // namespace ism::detail

#endif
