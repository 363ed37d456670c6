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

inline constexpr std::size_t sieve_depth = 48;    // numbers of a cluster that the sieve looks at
inline constexpr std::size_t sieve_rows = 6;      // clusters of a strip, with
inline constexpr std::size_t sieve_columns = 16;  // those of a panel: what fits into 16 vector registers

/// Clusters of a strip. A pair passes where dot − start − start ≥ the lower of its two bars.
struct SieveStrip {
    std::array<const float*, sieve_rows> numbers;  ///< of each row
    const float* start;  ///< half the squared lengths, a little less; infinity: passes never
    const float* bar;    ///< minus half the squared distance that still counts
};

/// Clusters of a panel.
struct SievePanel {
    const float* numbers;  ///< number k of all columns side by side, for each k
    const float* start;
    const float* bar;
};

/// Which columns pass with each row: bit c of element r.
using SievePassed = std::array<std::uint16_t, sieve_rows>;

/// @brief All pairs of a strip and a panel, plainly.
[[nodiscard]] inline SievePassed sieve_plain(const SieveStrip& strip, const SievePanel& panel) {
    SievePassed passed{};
    for (std::size_t r = 0; r < sieve_rows; ++r) {
        std::array<float, sieve_columns> sum;
        for (std::size_t c = 0; c < sieve_columns; ++c) sum[c] = -strip.start[r] - panel.start[c];
        for (std::size_t k = 0; k < sieve_depth; ++k)
            for (std::size_t c = 0; c < sieve_columns; ++c)
                sum[c] += strip.numbers[r][k] * panel.numbers[k * sieve_columns + c];
        for (std::size_t c = 0; c < sieve_columns; ++c)
            passed[r] |= std::uint16_t((sum[c] >= std::min(strip.bar[r], panel.bar[c])) << c);
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

/// For each of `count` / 8 products and sums, and as many again for the rest, half a last digit.
[[nodiscard]] constexpr float rough_error(std::size_t count) {
    return float(count / 4 + 16) * 0x1p-24f;
}

#if ISM_DETAIL_X86
/// @brief sieve_plain() for processors with AVX2 and FMA.
ISM_DETAIL_TARGET("avx2,fma")
inline SievePassed sieve_avx2(const SieveStrip& strip, const SievePanel& panel) {
    const __m256 start[2] = {_mm256_loadu_ps(panel.start), _mm256_loadu_ps(panel.start + 8)};
    __m256 sum[sieve_rows][2];
    for (std::size_t r = 0; r < sieve_rows; ++r)
        for (std::size_t h = 0; h < 2; ++h)
            sum[r][h] = _mm256_sub_ps(_mm256_set1_ps(-strip.start[r]), start[h]);
    for (std::size_t k = 0; k < sieve_depth; ++k) {
        const __m256 left = _mm256_loadu_ps(panel.numbers + k * sieve_columns);
        const __m256 right = _mm256_loadu_ps(panel.numbers + k * sieve_columns + 8);
        for (std::size_t r = 0; r < sieve_rows; ++r) {
            const __m256 one = _mm256_broadcast_ss(strip.numbers[r] + k);
            sum[r][0] = _mm256_fmadd_ps(one, left, sum[r][0]);
            sum[r][1] = _mm256_fmadd_ps(one, right, sum[r][1]);
        }
    }
    SievePassed passed{};
    const __m256 bar[2] = {_mm256_loadu_ps(panel.bar), _mm256_loadu_ps(panel.bar + 8)};
    for (std::size_t r = 0; r < sieve_rows; ++r) {
        const __m256 own = _mm256_set1_ps(strip.bar[r]);
        const __m256 left = _mm256_cmp_ps(sum[r][0], _mm256_min_ps(own, bar[0]), _CMP_GE_OQ);
        const __m256 right = _mm256_cmp_ps(sum[r][1], _mm256_min_ps(own, bar[1]), _CMP_GE_OQ);
        passed[r] = std::uint16_t(_mm256_movemask_ps(left) | _mm256_movemask_ps(right) << 8);
    }
    return passed;
}

ISM_DETAIL_TARGET("avx2,fma")
inline float sq_difference_avx2(const float* a, const float* b, std::size_t count) {
    return sq_difference_body(a, b, count);
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
struct SieveKernel {
    SievePassed (*sieve)(const SieveStrip&, const SievePanel&) = sieve_plain;
    float (*sq_difference)(const float*, const float*, std::size_t) = sq_difference_any;
    float (*rough_sq_difference)(const float*, const float*, std::size_t) = rough_sq_difference_any;

    explicit SieveKernel([[maybe_unused]] InstructionSet isa) {
#if ISM_DETAIL_X86
        if (isa == InstructionSet::any) return;
        sieve = sieve_avx2;
        sq_difference = sq_difference_avx2;
        rough_sq_difference = rough_sq_difference_avx2;
#endif
    }
};

}  // namespace ism::detail
