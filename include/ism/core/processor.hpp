// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

/// @file
/// @brief Functions for vector units that the compiler may use only in them: no flags are asked of the user,
/// and which unit there is is looked up when the program runs.

#include <initializer_list>

#if defined(__x86_64__) && defined(__GNUC__)
#define ISM_X86_UNITS 1
#include <immintrin.h>
#define ISM_TARGET(units) __attribute__((target(units)))
#define ISM_INLINE inline __attribute__((always_inline))
#else
#define ISM_X86_UNITS 0
#define ISM_INLINE inline
#endif

namespace ism {

/// @brief Vector units that some loops are written for. Results never depend on it, only the time does.
enum class VectorUnit {
    any,          ///< what the compiler makes of plain loops
    avx2,         ///< x86: AVX2 with FMA
    avx512_vnni,  ///< x86: AVX-512 with dot products of bytes
};

/// @brief Whether the processor at hand has the unit.
[[nodiscard]] inline bool has_unit(VectorUnit unit) {
#if ISM_X86_UNITS
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (unit == VectorUnit::avx2) return avx2;
    if (unit == VectorUnit::avx512_vnni)
        return avx2 && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vnni");
#endif
    return unit == VectorUnit::any;
}

/// @brief The fastest of the units that the processor at hand has.
[[nodiscard]] inline VectorUnit best_unit() {
    for (const VectorUnit unit : {VectorUnit::avx512_vnni, VectorUnit::avx2})
        if (has_unit(unit)) return unit;
    return VectorUnit::any;
}

}  // namespace ism
