// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "ism/core/lanes.hpp"
#include "ism/core/processor.hpp"
#include "ism/core/vector.hpp"

namespace ism::detail {

inline constexpr std::size_t projected_dimension = 48;  // coordinates that bounds are taken from
inline constexpr std::size_t tile_rows = 6;             // clusters of a strip, with
inline constexpr std::size_t tile_columns = 16;  // those of a panel: what fits into 16 vector registers

/// Clusters of a strip. A pair passes where dot − half_sq_norm − half_sq_norm, at most minus half its squared
/// distance, is not below the lower of its two cutoffs.
struct TileRows {
    std::array<const float*, tile_rows> numbers;  ///< of each row
    const float* half_sq_norm;  ///< half the squared lengths, rounded down; infinity: never passes
    const float* cutoff;        ///< minus half the largest squared distance of interest
};

/// Clusters of a panel.
struct TileColumns {
    const float* numbers;  ///< number k of all columns side by side, for each k
    const float* half_sq_norm;
    const float* cutoff;
};

/// Which columns pass with each row: bit c of element r.
using TileMask = std::array<std::uint16_t, tile_rows>;

/// @brief All pairs of a strip and a panel, plainly.
[[nodiscard]] inline TileMask prune_tile_any(const TileRows& strip, const TileColumns& panel) {
    TileMask passed{};
    for (std::size_t r = 0; r < tile_rows; ++r) {
        std::array<float, tile_columns> sum;
        for (std::size_t c = 0; c < tile_columns; ++c)
            sum[c] = -strip.half_sq_norm[r] - panel.half_sq_norm[c];
        for (std::size_t k = 0; k < projected_dimension; ++k)
            for (std::size_t c = 0; c < tile_columns; ++c)
                sum[c] += strip.numbers[r][k] * panel.numbers[k * tile_columns + c];
        for (std::size_t c = 0; c < tile_columns; ++c)
            passed[r] |= std::uint16_t((sum[c] >= std::min(strip.cutoff[r], panel.cutoff[c])) << c);
    }
    return passed;
}

/// The sum of squared differences, the same for (a, b) and (b, a). A difference is rounded to float once; its
/// square is exact in double, so that a fused multiply-add rounds like two steps: the same bits for every
/// instruction set.
ISM_DETAIL_INLINE float sq_difference_body(const float* a, const float* b, std::size_t count) {
    return float(sum_in_lanes<double, 8>(count, [=](std::size_t k) {
        const float difference = a[k] - b[k];
        return double(difference) * double(difference);
    }));
}

[[nodiscard]] inline float sq_difference_any(const float* a, const float* b, std::size_t count) {
    return sq_difference_body(a, b, count);
}

/// About the same in float, with rounding that depends on the instruction set: the relative error is below
/// rough_error(count), beside an absolute one of numbers that float cannot hold. `count` is a multiple of 8.
[[nodiscard]] inline float rough_sq_difference_any(const float* a, const float* b, std::size_t count) {
    return sum_in_lanes<float, 8>(count, [=](std::size_t k) { return (a[k] - b[k]) * (a[k] - b[k]); });
}

/// For each of `count` / 8 products and sums, twice that for the rest, half a last digit.
[[nodiscard]] constexpr float rough_error(std::size_t count) {
    return float(count / 4 + 16) * 0x1p-24f;
}

#if ISM_DETAIL_X86
/// @brief prune_tile_any() for processors with AVX2 and FMA.
ISM_DETAIL_TARGET("avx2,fma")
inline TileMask prune_tile_avx2(const TileRows& strip, const TileColumns& panel) {
    using Floats = Vector<float, 8>;
    constexpr std::size_t lanes = 8, parts = tile_columns / lanes;
    Floats sum[tile_rows][parts], column[parts];
#pragma GCC unroll 8
    for (std::size_t p = 0; p < parts; ++p)
        std::memcpy(&column[p], panel.half_sq_norm + p * lanes, sizeof(Floats));
#pragma GCC unroll 8
    for (std::size_t r = 0; r < tile_rows; ++r)
#pragma GCC unroll 8
        for (std::size_t p = 0; p < parts; ++p) sum[r][p] = -strip.half_sq_norm[r] - column[p];
    for (std::size_t k = 0; k < projected_dimension; ++k) {
#pragma GCC unroll 8
        for (std::size_t p = 0; p < parts; ++p)
            std::memcpy(&column[p], panel.numbers + k * tile_columns + p * lanes, sizeof(Floats));
#pragma GCC unroll 8
        for (std::size_t r = 0; r < tile_rows; ++r)
#pragma GCC unroll 8
            for (std::size_t p = 0; p < parts; ++p) sum[r][p] += strip.numbers[r][k] * column[p];
    }
    TileMask passed{};
#pragma GCC unroll 8
    for (std::size_t p = 0; p < parts; ++p) std::memcpy(&column[p], panel.cutoff + p * lanes, sizeof(Floats));
#pragma GCC unroll 8
    for (std::size_t r = 0; r < tile_rows; ++r) {
        const Floats own = strip.cutoff[r] - Floats{};
#pragma GCC unroll 8
        for (std::size_t p = 0; p < parts; ++p) {
            const Floats passes = Floats(sum[r][p] >= (own < column[p] ? own : column[p]));
            passed[r] |= std::uint16_t(__builtin_ia32_movmskps256(passes) << (p * lanes));
        }
    }
    return passed;
}

/// sq_difference_body() with its lanes in two registers.
ISM_DETAIL_TARGET("avx2,fma")
inline float sq_difference_avx2(const float* a, const float* b, std::size_t count) {
    Vector<double, 4> sum[2] = {}, d;
    Vector<float, 4> x, y;
    for (std::size_t k = 0; k < count; k += 8)
#pragma GCC unroll 8
        for (std::size_t half = 0; half < 2; ++half) {
            std::memcpy(&x, a + k + half * 4, sizeof(x));
            std::memcpy(&y, b + k + half * 4, sizeof(y));
            x -= y;
            asm("vcvtps2pd %1, %0" : "=v"(d) : "v"(x));  // g++ 12: four for __builtin_convertvector()
            sum[half] += d * d;
        }
    sum[0] += sum[1];
    return float(sum_of_lanes<double, 4>(sum[0]));
}

/// sq_difference_body() with its lanes in one register.
ISM_DETAIL_TARGET("avx512f")
inline float sq_difference_avx512(const float* a, const float* b, std::size_t count) {
    Vector<double, 8> sum{}, d;
    Vector<float, 8> x, y;
    for (std::size_t k = 0; k < count; k += 8) {
        std::memcpy(&x, a + k, sizeof(x));
        std::memcpy(&y, b + k, sizeof(y));
        x -= y;
        asm("vcvtps2pd %1, %0" : "=v"(d) : "v"(x));
        sum += d * d;
    }
    return float(sum_of_lanes<double, 8>(sum));
}

/// rough_sq_difference_any() in 16 lanes, in two registers.
ISM_DETAIL_TARGET("avx2,fma")
inline float rough_sq_difference_avx2(const float* a, const float* b, std::size_t count) {
    Vector<float, 8> sum[2] = {}, x, y;
    std::size_t k = 0;
    for (; k + 16 <= count; k += 16)
#pragma GCC unroll 8
        for (std::size_t half = 0; half < 2; ++half) {
            std::memcpy(&x, a + k + half * 8, sizeof(x));
            std::memcpy(&y, b + k + half * 8, sizeof(y));
            x -= y;
            sum[half] += x * x;
        }
    if (k < count) {
        std::memcpy(&x, a + k, sizeof(x));
        std::memcpy(&y, b + k, sizeof(y));
        x -= y;
        sum[0] += x * x;
    }
    sum[0] += sum[1];
    return sum_of_lanes<float, 8>(sum[0]);
}

/// The same lanes in one register.
ISM_DETAIL_TARGET("avx512f,fma")
inline float rough_sq_difference_avx512(const float* a, const float* b, std::size_t count) {
    Vector<float, 16> sum{};
    std::size_t k = 0;
    for (; k + 16 <= count; k += 16) {
        Vector<float, 16> x, y;
        std::memcpy(&x, a + k, sizeof(x));
        std::memcpy(&y, b + k, sizeof(y));
        x -= y;
        sum += x * x;
    }
    Vector<float, 8> halves[2];
    std::memcpy(halves, &sum, sizeof(sum));
    if (k < count) {
        Vector<float, 8> x, y;
        std::memcpy(&x, a + k, sizeof(x));
        std::memcpy(&y, b + k, sizeof(y));
        x -= y;
        halves[0] += x * x;
    }
    halves[0] += halves[1];
    return sum_of_lanes<float, 8>(halves[0]);
}
#endif

/// @brief The functions above for an instruction set.
struct DistanceKernels {
    TileMask (*prune_tile)(const TileRows&, const TileColumns&) = prune_tile_any;
    float (*sq_difference)(const float*, const float*, std::size_t) = sq_difference_any;
    float (*rough_sq_difference)(const float*, const float*, std::size_t) = rough_sq_difference_any;

    explicit DistanceKernels([[maybe_unused]] InstructionSet isa) {
#if ISM_DETAIL_X86
        if (isa == InstructionSet::any) return;
        prune_tile = prune_tile_avx2;
        sq_difference = sq_difference_avx2;
        rough_sq_difference = rough_sq_difference_avx2;
        if (isa == InstructionSet::avx2) return;
        sq_difference = sq_difference_avx512;
        rough_sq_difference = rough_sq_difference_avx512;
#endif
    }
};

}  // namespace ism::detail
