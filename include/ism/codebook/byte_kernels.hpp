// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "ism/codebook/filter.hpp"
#include "ism/config.hpp"
#include "ism/core/processor.hpp"
#include "ism/core/vector.hpp"

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
    using Ints = Vector<std::int32_t, 16>;
    constexpr std::size_t rows = 6, parts = 4;
    static_assert(filter_block % rows == 0);
    for (std::size_t i = 0; i < task.count; i += rows) {
        const std::uint8_t* query = task.queries + i * task.quads * 4;
        Ints sum[rows][parts];
#pragma GCC unroll 8
        for (std::size_t p = 0; p < parts; ++p)
#pragma GCC unroll 8
            for (std::size_t r = 0; r < rows; ++r) std::memcpy(&sum[r][p], task.bias + 16 * p, sizeof(Ints));
        for (std::size_t k = 0; k < task.quads; ++k) {
            Ints word[parts];
#pragma GCC unroll 8
            for (std::size_t p = 0; p < parts; ++p)
                std::memcpy(&word[p], task.words + (k * parts + p) * 64, sizeof(Ints));
#pragma GCC unroll 8
            for (std::size_t r = 0; r < rows; ++r) {
                const Ints four = four_bytes(query + (r * task.quads + k) * 4) + Ints{};
#pragma GCC unroll 8
                for (std::size_t p = 0; p < parts; ++p)
                    // g++ 12 copies the accumulator of _mm512_dpbusd_epi32() before each call: matching
                    // then takes half as long again
                    asm("vpdpbusd %2, %1, %0" : "+v"(sum[r][p]) : "v"(four), "v"(word[p]));
            }
        }
#pragma GCC unroll 8
        for (std::size_t r = 0; r < rows; ++r) {
            const Ints limit = task.limits[i + r] + Ints{};
            std::uint64_t mask = 0;
#pragma GCC unroll 8
            for (std::size_t p = 0; p < parts; ++p) {
                constexpr int greater = 6;  // not less or equal
                mask |= std::uint64_t(__builtin_ia32_cmpd512_mask(sum[r][p], limit, greater, 0xffff))
                        << (16 * p);
            }
            task.masks[i + r] = mask;
        }
    }
}

/// Four queries and 16 words at a time. Two products of 7 bits by 7 fit into 16 bits even when added, so that
/// only every other sum is widened.
ISM_DETAIL_TARGET("avx2,fma")
inline void filter_bytes_avx2(const ByteTask& task) {
    using Ints = Vector<std::int32_t, 8>;
    using Shorts = Vector<std::int16_t, 16>;
    using Bytes = Vector<char, 32>;
    constexpr std::size_t rows = 4, parts = 2, strips = filter_group / (8 * parts);
    static_assert(filter_block % rows == 0);
    const Shorts ones = std::int16_t(1) + Shorts{};
    for (std::size_t i = 0; i < task.count; i += rows) {
        const std::uint8_t* query = task.queries + i * task.quads * 4;
        for (std::size_t r = 0; r < rows; ++r) task.masks[i + r] = 0;
        for (std::size_t s = 0; s < strips; ++s) {
            Ints sum[rows][parts];
#pragma GCC unroll 8
            for (std::size_t p = 0; p < parts; ++p)
#pragma GCC unroll 8
                for (std::size_t r = 0; r < rows; ++r)
                    std::memcpy(&sum[r][p], task.bias + 8 * (s * parts + p), sizeof(Ints));
            for (std::size_t k = 0; k < task.quads; k += 2) {
                const std::int8_t* words = task.words + k * 256 + s * parts * 32;
#pragma GCC unroll 8
                for (std::size_t r = 0; r < rows; ++r) {
                    const std::uint8_t* eight = query + (r * task.quads + k) * 4;
                    const Ints a = four_bytes(eight) + Ints{}, b = four_bytes(eight + 4) + Ints{};
#pragma GCC unroll 8
                    for (std::size_t p = 0; p < parts; ++p) {
                        Bytes first, second;
                        std::memcpy(&first, words + p * 32, sizeof(Bytes));
                        std::memcpy(&second, words + p * 32 + 256, sizeof(Bytes));
                        const Shorts pairs = __builtin_ia32_pmaddubsw256(Bytes(a), first) +
                                             __builtin_ia32_pmaddubsw256(Bytes(b), second);
                        sum[r][p] += __builtin_ia32_pmaddwd256(pairs, ones);
                    }
                }
            }
#pragma GCC unroll 8
            for (std::size_t r = 0; r < rows; ++r)
#pragma GCC unroll 8
                for (std::size_t p = 0; p < parts; ++p) {
                    const auto exceeds = Vector<float, 8>(sum[r][p] > task.limits[i + r]);
                    task.masks[i + r] |= std::uint64_t(unsigned(__builtin_ia32_movmskps256(exceeds)))
                                         << (8 * (s * parts + p));
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
