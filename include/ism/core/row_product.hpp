// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "ism/core/processor.hpp"
#include "ism/core/vector.hpp"

namespace ism {

/// @brief What rows of examples are made of: whole numbers take half of the memory, which fitting waits for.
template <typename T>
concept RowNumber = std::same_as<T, float> || std::same_as<T, std::int16_t>;

namespace detail {

/// A register of numbers of a row, as floats.
using RowPart = Vector<float, native_lanes>;

ISM_DETAIL_INLINE void load_part(const std::int16_t* from, RowPart& part) {
    Vector<std::int16_t, native_lanes> numbers;
    Vector<std::int32_t, native_lanes> wide;
    std::memcpy(&numbers, from, sizeof(numbers));
#if defined(__AVX2__) && !defined(__AVX512F__)
    asm("vpmovsxwd %1, %0" : "=x"(wide) : "xm"(numbers));  // g++ 12 widens halves apart and joins them
#else
    wide = __builtin_convertvector(numbers, Vector<std::int32_t, native_lanes>);
#endif
    part = __builtin_convertvector(wide, RowPart);
}
ISM_DETAIL_INLINE void load_part(const float* from, RowPart& part) {
    std::memcpy(&part, from, sizeof(part));
}

/// The scalar product of two rows, summed in 16 lanes whatever the registers.
template <RowNumber A, RowNumber B>
[[nodiscard]] double row_product(const A* a, const B* b, std::size_t size) {
    constexpr std::size_t lanes = 16;
    RowPart sums[lanes / native_lanes]{}, x, y;
    const std::size_t whole = size / lanes * lanes;
    for (std::size_t k = 0; k < whole; k += lanes)
#pragma GCC unroll 8
        for (std::size_t part = 0; part < lanes / native_lanes; ++part) {
            load_part(a + k + part * native_lanes, x), load_part(b + k + part * native_lanes, y);
            sums[part] += x * y;
        }
    double sum = 0;
    for (const RowPart& part : sums)
        for (std::size_t l = 0; l < native_lanes; ++l) sum += part[l];
    for (std::size_t k = whole; k < size; ++k) sum += float(a[k]) * float(b[k]);
    return sum;
}

/// Adds a share of a row to as many weights.
template <RowNumber T>
void add_row(float share, const T* row, float* weights, std::size_t size) {
    RowPart x, w;
    const std::size_t whole = size / native_lanes * native_lanes;
    for (std::size_t k = 0; k < whole; k += native_lanes) {
        load_part(row + k, x), load_part(weights + k, w);
        w += share * x;
        std::memcpy(weights + k, &w, sizeof(w));
    }
    for (std::size_t k = whole; k < size; ++k) weights[k] += share * float(row[k]);
}

}  // namespace detail

}  // namespace ism
