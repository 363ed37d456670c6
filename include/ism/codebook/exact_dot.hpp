// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "ism/core/lanes.hpp"
#include "ism/core/processor.hpp"
#include "ism/feature/feature.hpp"

namespace ism::detail {

/// A product of two floats, or of a float and a byte, is exact in double, so that a fused multiply-add rounds
/// like two steps: the same bits on every processor.
template <DescriptorScalar T>
ISM_DETAIL_INLINE double dot_body(const float* a, const T* b, std::size_t size) {
    return sum_in_lanes<double, 8>(size, [=](std::size_t k) { return double(a[k]) * double(b[k]); });
}

template <DescriptorScalar T>
using Dot = double(const float*, const T*, std::size_t);

template <DescriptorScalar T>
double dot_any(const float* a, const T* b, std::size_t size) {
    return dot_body(a, b, size);
}

#if ISM_DETAIL_X86
template <DescriptorScalar T>
ISM_DETAIL_TARGET("avx2,fma")
double dot_avx2(const float* a, const T* b, std::size_t size) {
    return dot_body(a, b, size);
}
#endif

/// The dot product of two rows in double, its bits the same for every instruction set.
template <DescriptorScalar T>
[[nodiscard]] Dot<T>* exact_dot([[maybe_unused]] InstructionSet isa) {
#if ISM_DETAIL_X86
    if (isa != InstructionSet::any) return dot_avx2<T>;
#endif
    return dot_any<T>;
}

}  // namespace ism::detail
