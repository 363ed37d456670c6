// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "ism/core/lanes.hpp"
#include "ism/core/processor.hpp"

namespace ism::detail {

/// How bytes stand for numbers: b for least + step · b, 0 ≤ b < levels.
struct ByteScale {
    double least = 0, step = 1;
    int levels = 256;
};

/// The range of some numbers, evenly divided.
[[nodiscard]] inline ByteScale byte_scale(std::span<const float> values, int levels) {
    constexpr std::size_t lanes = 16;
    float low[lanes], high[lanes];
    std::fill_n(low, lanes, values.front()), std::fill_n(high, lanes, values.front());
    std::size_t k = 0;
    for (; k + lanes <= values.size(); k += lanes)
        for (std::size_t l = 0; l < lanes; ++l) {
            low[l] = values[k + l] < low[l] ? values[k + l] : low[l];
            high[l] = values[k + l] > high[l] ? values[k + l] : high[l];
        }
    for (; k < values.size(); ++k)
        low[0] = std::min(low[0], values[k]), high[0] = std::max(high[0], values[k]);
    const double least = *std::min_element(low, low + lanes), most = *std::max_element(high, high + lanes);
    return {.least = least, .step = (most - least) / (levels - 1), .levels = levels};
}

/// What a row of numbers v lost when it was written as bytes that stand for v'.
struct ByteRounding {
    double error = 0;   ///< |v − v'|
    double along = 0;   ///< c·(v − v'), c the centre
    double length = 0;  ///< |v' − c|
    double sum = 0;     ///< of the bytes
};

/// Writes a whole number of eights as bytes and adds to what was lost, squared where it is a length. It is
/// taken from the bytes, so that rounding itself may err.
ISM_DETAIL_INLINE void round_eights(const float* __restrict row, const double* __restrict centre,
                                    std::size_t size, const ByteScale& scale, std::uint8_t* __restrict bytes,
                                    ByteRounding& lost) {
    const double origin = scale.least, step = scale.step;
    const float least = float(origin), factor = float(1 / step), top = float(scale.levels - 1);
    for (std::size_t k = 0; k < size; ++k) {
        const float wanted = (row[k] - least) * factor + 0.5f;
        const float kept = wanted > 0 ? wanted : 0;
        bytes[k] = std::uint8_t(std::int32_t(kept < top ? kept : top));
    }
    constexpr std::size_t lanes = 8;
    Lanes<double, lanes> sq_error, along, sq_length, sum;
    for (std::size_t k = 0; k < size; k += lanes)
        for (std::size_t l = 0; l < lanes; ++l) {
            const double byte = bytes[k + l], value = origin + step * byte;
            const double error = double(row[k + l]) - value, off = value - centre[k + l];
            sq_error[l] += error * error, along[l] += error * centre[k + l];
            sq_length[l] += off * off, sum[l] += byte;
        }
    lost.error += sq_error.sum(), lost.along += along.sum();
    lost.length += sq_length.sum(), lost.sum += sum.sum();
}

/// Writes a row of numbers as bytes. On x86 only for processors with AVX2 and FMA, as all filters in bytes:
/// see byte_kernel().
#if ISM_DETAIL_X86
ISM_DETAIL_TARGET("avx2,fma")
#endif
inline ByteRounding round_row(std::span<const float> row, const double* centre, const ByteScale& scale,
                              std::uint8_t* bytes) {
    ByteRounding lost;
    const std::size_t whole = row.size() / 8 * 8, rest = row.size() - whole;
    round_eights(row.data(), centre, whole, scale, bytes, lost);
    if (rest > 0) {  // filled up by what a byte stands for exactly, and which is its own centre
        float numbers[8];
        double centres[8];
        std::uint8_t rounded[8];
        std::fill_n(numbers, 8, float(scale.least)), std::fill_n(centres, 8, scale.least);
        std::copy_n(row.data() + whole, rest, numbers), std::copy_n(centre + whole, rest, centres);
        round_eights(numbers, centres, 8, scale, rounded, lost);
        std::copy_n(rounded, rest, bytes + whole);
    }
    lost.error = std::sqrt(lost.error), lost.length = std::sqrt(lost.length);
    return lost;
}

}  // namespace ism::detail
