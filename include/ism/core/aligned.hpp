// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "ism/config.hpp"

namespace ism {

/// @brief 64 bytes at an address that is a multiple of 64: what a vector unit loads from them lies in one
/// line of the cache.
struct alignas(64) CacheLine {
    std::byte bytes[64];
};

/// @brief Numbers of which the first lies at the start of a cache line.
template <class T>
requires std::is_arithmetic_v<T>
class AlignedVector {
public:
    AlignedVector() = default;
    explicit AlignedVector(std::size_t size) { resize(size); }

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] T* data() { return reinterpret_cast<T*>(lines_.data()); }
    [[nodiscard]] const T* data() const { return reinterpret_cast<const T*>(lines_.data()); }
    [[nodiscard]] T& operator[](std::size_t i) { return data()[i]; }
    [[nodiscard]] const T& operator[](std::size_t i) const { return data()[i]; }

    /// @brief Keeps the first numbers; those that are new are 0.
    void resize(std::size_t size) {
        lines_.resize((size * sizeof(T) + sizeof(CacheLine) - 1) / sizeof(CacheLine));
        if (size > size_) std::fill(data() + size_, data() + size, T(0));
        size_ = size;
    }

private:
    std::vector<CacheLine> lines_;
    std::size_t size_ = 0;
};

/// @brief The next multiple of the floats in a cache line.
[[nodiscard]] constexpr int whole_lines(int floats) {
    return (floats + 15) / 16 * 16;
}

}  // namespace ism
