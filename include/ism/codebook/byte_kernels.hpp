// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "ism/codebook/filter.hpp"
#include "ism/config.hpp"
#include "ism/core/processor.hpp"

#if ISM_DETAIL_X86
#include <immintrin.h>
#endif

namespace ism::detail {

/// One group of words against queries in bytes: bit j of masks[i] is set where
/// query i · word j + bias[j] > limits[i].
/// `quads` is a quarter of the dimension. A query is `quads` times four numbers, 0 … 255, or 0 … 127 for
/// AVX2; the words are `quads` times four numbers of each word, −128 … 127, or −64 … 63 for AVX2; quads is
/// even.
struct ByteTask {
    const std::uint8_t* queries;
    std::size_t count, quads;
    const std::int32_t* limits;
    const std::int8_t* words;
    const std::int32_t* bias;
    std::uint64_t* masks;
};

#if ISM_DETAIL_X86

[[nodiscard]] ISM_DETAIL_INLINE std::int32_t four_bytes(const std::uint8_t* from) {
    std::int32_t four;
    std::memcpy(&four, from, sizeof(four));
    return four;
}

/// Six queries and 64 words at a time: 24 sums in registers.
ISM_DETAIL_TARGET("avx512f,avx512bw,avx512vnni")
inline void filter_bytes_avx512_vnni(const ByteTask& task) {
    constexpr std::size_t rows = 6, parts = 4;
    static_assert(filter_block % rows == 0);
    for (std::size_t i = 0; i < task.count; i += rows) {
        const std::uint8_t* query = task.queries + i * task.quads * 4;
        __m512i sum[rows][parts];
#pragma GCC unroll 8
        for (std::size_t p = 0; p < parts; ++p)
#pragma GCC unroll 8
            for (std::size_t r = 0; r < rows; ++r) sum[r][p] = _mm512_loadu_si512(task.bias + 16 * p);
        for (std::size_t k = 0; k < task.quads; ++k) {
            __m512i word[parts];
#pragma GCC unroll 8
            for (std::size_t p = 0; p < parts; ++p)
                word[p] = _mm512_loadu_si512(task.words + (k * parts + p) * 64);
#pragma GCC unroll 8
            for (std::size_t r = 0; r < rows; ++r) {
                const __m512i four = _mm512_set1_epi32(four_bytes(query + (r * task.quads + k) * 4));
#pragma GCC unroll 8
                for (std::size_t p = 0; p < parts; ++p)
                    // g++ 12 copies the accumulator of _mm512_dpbusd_epi32() before each call: matching
                    // then takes half as long again
                    asm("vpdpbusd %2, %1, %0" : "+v"(sum[r][p]) : "v"(four), "v"(word[p]));
            }
        }
#pragma GCC unroll 8
        for (std::size_t r = 0; r < rows; ++r) {
            const __m512i limit = _mm512_set1_epi32(task.limits[i + r]);
            std::uint64_t mask = 0;
#pragma GCC unroll 8
            for (std::size_t p = 0; p < parts; ++p)
                mask |= std::uint64_t(_mm512_cmpgt_epi32_mask(sum[r][p], limit)) << (16 * p);
            task.masks[i + r] = mask;
        }
    }
}

/// Four queries and 16 words at a time. Two products of 7 bits by 7 fit into 16 bits even when added, so that
/// only every other sum is widened.
ISM_DETAIL_TARGET("avx2,fma")
inline void filter_bytes_avx2(const ByteTask& task) {
    constexpr std::size_t rows = 4, parts = 2, strips = filter_group / (8 * parts);
    static_assert(filter_block % rows == 0);
    const __m256i ones = _mm256_set1_epi16(1);
    for (std::size_t i = 0; i < task.count; i += rows) {
        const std::uint8_t* query = task.queries + i * task.quads * 4;
        for (std::size_t r = 0; r < rows; ++r) task.masks[i + r] = 0;
        for (std::size_t s = 0; s < strips; ++s) {
            __m256i sum[rows][parts];
#pragma GCC unroll 8
            for (std::size_t p = 0; p < parts; ++p)
#pragma GCC unroll 8
                for (std::size_t r = 0; r < rows; ++r)
                    sum[r][p] =
                        _mm256_loadu_si256(reinterpret_cast<const __m256i*>(task.bias + 8 * (s * parts + p)));
            for (std::size_t k = 0; k < task.quads; k += 2) {
                const std::int8_t* words = task.words + k * 256 + s * parts * 32;
#pragma GCC unroll 8
                for (std::size_t r = 0; r < rows; ++r) {
                    const std::uint8_t* eight = query + (r * task.quads + k) * 4;
                    const __m256i a = _mm256_set1_epi32(four_bytes(eight));
                    const __m256i b = _mm256_set1_epi32(four_bytes(eight + 4));
#pragma GCC unroll 8
                    for (std::size_t p = 0; p < parts; ++p) {
                        const auto* word = reinterpret_cast<const __m256i*>(words + p * 32);
                        const __m256i pairs =
                            _mm256_add_epi16(_mm256_maddubs_epi16(a, _mm256_loadu_si256(word)),
                                             _mm256_maddubs_epi16(b, _mm256_loadu_si256(word + 8)));
                        sum[r][p] = _mm256_add_epi32(sum[r][p], _mm256_madd_epi16(pairs, ones));
                    }
                }
            }
#pragma GCC unroll 8
            for (std::size_t r = 0; r < rows; ++r) {
                const __m256i limit = _mm256_set1_epi32(task.limits[i + r]);
#pragma GCC unroll 8
                for (std::size_t p = 0; p < parts; ++p) {
                    const int bits =
                        _mm256_movemask_ps(_mm256_castsi256_ps(_mm256_cmpgt_epi32(sum[r][p], limit)));
                    task.masks[i + r] |= std::uint64_t(unsigned(bits)) << (8 * (s * parts + p));
                }
            }
        }
    }
}

#endif

using FilterBytes = void(const ByteTask&);

/// The kernel for an instruction set, none where it has none for bytes.
[[nodiscard]] inline FilterBytes* byte_kernel([[maybe_unused]] InstructionSet isa) {
#if ISM_DETAIL_X86
    if (isa == InstructionSet::avx512_vnni) return filter_bytes_avx512_vnni;
    if (isa == InstructionSet::avx2) return filter_bytes_avx2;
#endif
    return nullptr;
}

/// How many numbers a byte may stand for with the kernel of an instruction set.
[[nodiscard]] constexpr int byte_levels(InstructionSet isa) {
    return isa == InstructionSet::avx512_vnni ? 256 : 128;
}

}  // namespace ism::detail
