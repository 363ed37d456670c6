// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <new>
#include <vector>

#include "ism/config.hpp"

namespace ism {

/// @brief Allocates at addresses that are multiples of a cache line, 64 bytes: what a vector unit loads from
/// there lies in one line.
template <class T>
struct AlignedAllocator {
    using value_type = T;
    AlignedAllocator() = default;
    template <class U>
    explicit AlignedAllocator(const AlignedAllocator<U>& /*other*/) {}
    [[nodiscard]] T* allocate(std::size_t count) {
        return static_cast<T*>(::operator new(count * sizeof(T), std::align_val_t(64)));
    }
    void deallocate(T* memory, std::size_t /*count*/) { ::operator delete(memory, std::align_val_t(64)); }
    template <class U>
    [[nodiscard]] bool operator==(const AlignedAllocator<U>& /*other*/) const {
        return true;
    }
};

/// @brief A vector whose first element lies at the start of a cache line.
template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

/// @brief The next multiple of the floats in a cache line.
[[nodiscard]] constexpr int whole_lines(int floats) {
    return (floats + 15) / 16 * 16;
}

}  // namespace ism
