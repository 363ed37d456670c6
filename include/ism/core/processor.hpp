// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

/// @file
/// @brief Which instruction set a kernel is compiled for and runs with: no compiler flags are asked of the
/// user, and which sets there are is looked up when the program runs.

#include <initializer_list>

#include "ism/config.hpp"

#if defined(__x86_64__) && defined(__GNUC__)
#define ISM_DETAIL_X86 1
/// Lets the compiler use these instructions in one function.
#define ISM_DETAIL_TARGET(instructions) __attribute__((target(instructions)))
/// A body that is compiled anew for each function with another target.
#define ISM_DETAIL_INLINE inline __attribute__((always_inline))
#else
#define ISM_DETAIL_X86 0
#define ISM_DETAIL_INLINE inline
#endif

namespace ism {

/// @brief Instruction sets that some loops are written for. Results never depend on it, only the time does.
enum class InstructionSet {
    any,          ///< what the compiler makes of plain loops
    avx2,         ///< x86: AVX2 with FMA
    avx512_vnni,  ///< x86: AVX-512 with dot products of bytes
};

/// @brief Whether the processor at hand has the instruction set.
[[nodiscard]] inline bool has_instruction_set(InstructionSet isa) {
#if ISM_DETAIL_X86
    const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (isa == InstructionSet::avx2) return avx2;
    if (isa == InstructionSet::avx512_vnni)
        return avx2 && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vnni");
#endif
    return isa == InstructionSet::any;
}

/// @brief The fastest instruction set that the processor at hand has.
[[nodiscard]] inline InstructionSet best_instruction_set() {
    for (const InstructionSet isa : {InstructionSet::avx512_vnni, InstructionSet::avx2})
        if (has_instruction_set(isa)) return isa;
    return InstructionSet::any;
}

}  // namespace ism
