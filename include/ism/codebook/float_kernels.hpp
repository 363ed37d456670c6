// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "ism/codebook/filter.hpp"
#include "ism/config.hpp"
#include "ism/core/processor.hpp"
#include "ism/core/vector.hpp"

namespace ism::detail {

/// One group of words against queries: bit j of masks[i] is set unless query i · word j + bias[j] ≤
/// limits[i]. Words are in panels of 16, number after number.
struct FloatTask {
    const float* queries;
    std::size_t count, dimension;
    const float* limits;
    const float* panels;
    const float* bias;
    std::uint64_t* masks;
};

/// A float, or a vector of them.
template <class T>
concept FloatLanes = sizeof(T) % sizeof(float) == 0 && requires(T lanes, float factor) {
    lanes += factor * lanes;
};

/// `Rows` queries and 16 words at a time stay in registers.
template <FloatLanes Lanes, std::size_t Rows>
ISM_DETAIL_INLINE void filter_floats_body(const FloatTask& task) {
    constexpr std::size_t words = 16, lanes = sizeof(Lanes) / sizeof(float), parts = words / lanes;
    static_assert(filter_tile % Rows == 0);
    std::fill_n(task.masks, task.count, std::uint64_t(0));
    for (std::size_t first = 0; first < filter_group; first += words)
        for (std::size_t i = 0; i < task.count; i += Rows) {
            const float* query = task.queries + i * task.dimension;
            const float* panel = task.panels + first * task.dimension;
            // every loop over these is unrolled, so that they stay in registers
            Lanes sum[Rows][parts], word[parts];
#pragma GCC unroll 8
            for (std::size_t r = 0; r < Rows; ++r)
#pragma GCC unroll 8
                for (std::size_t p = 0; p < parts; ++p)
                    std::memcpy(&sum[r][p], task.bias + first + p * lanes, sizeof(Lanes));
            for (std::size_t k = 0; k < task.dimension; ++k) {
#pragma GCC unroll 8
                for (std::size_t p = 0; p < parts; ++p)
                    std::memcpy(&word[p], panel + k * words + p * lanes, sizeof(Lanes));
#pragma GCC unroll 8
                for (std::size_t r = 0; r < Rows; ++r)
#pragma GCC unroll 8
                    for (std::size_t p = 0; p < parts; ++p)
                        sum[r][p] += query[r * task.dimension + k] * word[p];
            }
            float sums[Rows][words];
#pragma GCC unroll 8
            for (std::size_t r = 0; r < Rows; ++r)
#pragma GCC unroll 8
                for (std::size_t p = 0; p < parts; ++p)
                    std::memcpy(&sums[r][p * lanes], &sum[r][p], sizeof(Lanes));
            for (std::size_t r = 0; r < Rows; ++r) {
                const float limit = task.limits[i + r];
                int any = 0;
                for (std::size_t j = 0; j < words; ++j) any |= !(sums[r][j] <= limit);  // NaN: any
                if (any == 0) continue;
                for (std::size_t j = 0; j < words; ++j)
                    task.masks[i + r] |= std::uint64_t(!(sums[r][j] <= limit)) << (first + j);
            }
        }
}

using FilterFloats = void(const FloatTask&);

#if defined(__GNUC__)
inline void filter_floats_any(const FloatTask& task) {
    filter_floats_body<Vector<float, 4>, 4>(task);
}
#else
inline void filter_floats_any(const FloatTask& task) {
    filter_floats_body<float, 1>(task);
}
#endif

#if ISM_DETAIL_X86
ISM_DETAIL_TARGET("avx2,fma")
inline void filter_floats_avx2(const FloatTask& task) {
    filter_floats_body<Vector<float, 8>, 6>(task);
}
#endif

/// The kernel for an instruction set.
[[nodiscard]] inline FilterFloats* float_kernel([[maybe_unused]] InstructionSet isa) {
#if ISM_DETAIL_X86
    if (isa != InstructionSet::any) return filter_floats_avx2;
#endif
    return filter_floats_any;
}

}  // namespace ism::detail
