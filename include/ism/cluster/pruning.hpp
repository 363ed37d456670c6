// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "ism/core/lanes.hpp"
#include "ism/core/processor.hpp"

#if ISM_DETAIL_X86
#include <immintrin.h>
#endif

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
    const __m256 norm[2] = {_mm256_loadu_ps(panel.half_sq_norm), _mm256_loadu_ps(panel.half_sq_norm + 8)};
    __m256 sum[tile_rows][2];
    for (std::size_t r = 0; r < tile_rows; ++r)
        for (std::size_t h = 0; h < 2; ++h)
            sum[r][h] = _mm256_sub_ps(_mm256_set1_ps(-strip.half_sq_norm[r]), norm[h]);
    for (std::size_t k = 0; k < projected_dimension; ++k) {
        const __m256 left = _mm256_loadu_ps(panel.numbers + k * tile_columns);
        const __m256 right = _mm256_loadu_ps(panel.numbers + k * tile_columns + 8);
        for (std::size_t r = 0; r < tile_rows; ++r) {
            const __m256 one = _mm256_broadcast_ss(strip.numbers[r] + k);
            sum[r][0] = _mm256_fmadd_ps(one, left, sum[r][0]);
            sum[r][1] = _mm256_fmadd_ps(one, right, sum[r][1]);
        }
    }
    TileMask passed{};
    const __m256 cutoff[2] = {_mm256_loadu_ps(panel.cutoff), _mm256_loadu_ps(panel.cutoff + 8)};
    for (std::size_t r = 0; r < tile_rows; ++r) {
        const __m256 own = _mm256_set1_ps(strip.cutoff[r]);
        const __m256 left = _mm256_cmp_ps(sum[r][0], _mm256_min_ps(own, cutoff[0]), _CMP_GE_OQ);
        const __m256 right = _mm256_cmp_ps(sum[r][1], _mm256_min_ps(own, cutoff[1]), _CMP_GE_OQ);
        passed[r] = std::uint16_t(_mm256_movemask_ps(left) | _mm256_movemask_ps(right) << 8);
    }
    return passed;
}

ISM_DETAIL_TARGET("avx2,fma")
inline float sq_difference_avx2(const float* a, const float* b, std::size_t count) {
    return sq_difference_body(a, b, count);
}

/// The same lanes in half as many instructions.
ISM_DETAIL_TARGET("avx512f")
inline float sq_difference_avx512(const float* a, const float* b, std::size_t count) {
    __m512d lanes = _mm512_setzero_pd();
    for (std::size_t k = 0; k < count; k += 8) {
        // maskz: g++ 12 warns of an uninitialised value in _mm512_cvtps_pd()
        const __m512d d =
            _mm512_maskz_cvtps_pd(0xff, _mm256_sub_ps(_mm256_loadu_ps(a + k), _mm256_loadu_ps(b + k)));
        lanes = _mm512_fmadd_pd(d, d, lanes);
    }
    return float(std::bit_cast<Lanes<double, 8>>(lanes).sum());
}

ISM_DETAIL_TARGET("avx512f")
inline float rough_sq_difference_avx512(const float* a, const float* b, std::size_t count) {
    __m512 sum = _mm512_setzero_ps();
    std::size_t k = 0;
    for (; k + 16 <= count; k += 16) {
        const __m512 d = _mm512_sub_ps(_mm512_loadu_ps(a + k), _mm512_loadu_ps(b + k));
        sum = _mm512_fmadd_ps(d, d, sum);
    }
    if (k < count) {
        const __m512 d =
            _mm512_sub_ps(_mm512_maskz_loadu_ps(0xff, a + k), _mm512_maskz_loadu_ps(0xff, b + k));
        sum = _mm512_fmadd_ps(d, d, sum);
    }
    return std::bit_cast<Lanes<float, 16>>(sum).sum();
}

/// @brief rough_sq_difference_any() for processors with AVX2 and FMA.
ISM_DETAIL_TARGET("avx2,fma")
inline float rough_sq_difference_avx2(const float* a, const float* b, std::size_t count) {
    __m256 even = _mm256_setzero_ps(), odd = even;
    std::size_t k = 0;
    for (; k + 16 <= count; k += 16) {
        const __m256 d = _mm256_sub_ps(_mm256_loadu_ps(a + k), _mm256_loadu_ps(b + k));
        const __m256 e = _mm256_sub_ps(_mm256_loadu_ps(a + k + 8), _mm256_loadu_ps(b + k + 8));
        even = _mm256_fmadd_ps(d, d, even), odd = _mm256_fmadd_ps(e, e, odd);
    }
    for (; k < count; k += 8) {
        const __m256 d = _mm256_sub_ps(_mm256_loadu_ps(a + k), _mm256_loadu_ps(b + k));
        even = _mm256_fmadd_ps(d, d, even);
    }
    const __m256 all = _mm256_add_ps(even, odd);
    const __m128 half = _mm_add_ps(_mm256_castps256_ps128(all), _mm256_extractf128_ps(all, 1));
    const __m128 pair = _mm_add_ps(half, _mm_movehl_ps(half, half));
    return _mm_cvtss_f32(_mm_add_ss(pair, _mm_movehdup_ps(pair)));
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
