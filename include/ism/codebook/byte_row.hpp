// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

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

/// The sums of a ByteRounding, eight of each side by side.
struct ByteSums {
    static constexpr std::size_t lanes = 8;
    double sq_error[lanes] = {}, along[lanes] = {}, sq_length[lanes] = {};
    std::int32_t sum[lanes] = {};

    /// Rounds up to eight numbers. What was lost is taken from the bytes, so that rounding itself may err.
    ISM_INLINE void add(const float* row, const double* centre, std::size_t count, const ByteScale& scale,
                        std::uint8_t* bytes) {
        const auto least = float(scale.least), factor = float(1 / scale.step);
        const auto top = float(scale.levels - 1);
        for (std::size_t l = 0; l < count; ++l) {
            const float wanted = (row[l] - least) * factor + 0.5f;
            const float kept = wanted > 0 ? wanted : 0;
            const auto byte = std::int32_t(kept < top ? kept : top);
            bytes[l] = std::uint8_t(byte);
            const double value = scale.least + scale.step * byte, lost = double(row[l]) - value;
            sum[l] += byte;
            sq_error[l] += lost * lost;
            along[l] += lost * centre[l];
            sq_length[l] += (value - centre[l]) * (value - centre[l]);
        }
    }
};

ISM_INLINE ByteRounding round_row_body(const float* row, const double* centre, std::size_t size,
                                       const ByteScale& scale, std::uint8_t* bytes) {
    ByteSums sums;
    std::size_t k = 0;
    for (; k + ByteSums::lanes <= size; k += ByteSums::lanes)
        sums.add(row + k, centre + k, ByteSums::lanes, scale, bytes + k);
    sums.add(row + k, centre + k, size - k, scale, bytes + k);
    ByteRounding result;
    for (std::size_t l = 0; l < ByteSums::lanes; ++l) {
        result.error += sums.sq_error[l], result.along += sums.along[l];
        result.length += sums.sq_length[l], result.sum += sums.sum[l];
    }
    result.error = std::sqrt(result.error), result.length = std::sqrt(result.length);
    return result;
}

/// Writes a row of numbers as bytes.
#if ISM_X86_UNITS
ISM_TARGET("avx2,fma")
#endif
inline ByteRounding round_row(const float* row, const double* centre, std::size_t size,
                              const ByteScale& scale, std::uint8_t* bytes) {
    return round_row_body(row, centre, size, scale, bytes);
}

}  // namespace ism::detail
