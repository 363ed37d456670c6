// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

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

/// @brief Numbers in whole cache lines, the first at the start of one.
template <class T>
requires std::is_arithmetic_v<T>
class AlignedVector {
public:
    AlignedVector() = default;
    explicit AlignedVector(std::size_t size) : lines_((size + in_line - 1) / in_line) {}

    /// @brief Those that were asked for and what fills the last line.
    [[nodiscard]] std::size_t size() const { return lines_.size() * in_line; }
    [[nodiscard]] T* data() { return reinterpret_cast<T*>(lines_.data()); }
    [[nodiscard]] const T* data() const { return reinterpret_cast<const T*>(lines_.data()); }
    [[nodiscard]] T& operator[](std::size_t i) { return data()[i]; }
    [[nodiscard]] const T& operator[](std::size_t i) const { return data()[i]; }

    /// @brief Room for at least so many. Where there is too little, all become 0.
    void make_room(std::size_t size) {
        if (this->size() < size) *this = AlignedVector(size);
    }

private:
    static constexpr std::size_t in_line = sizeof(CacheLine) / sizeof(T);
    std::vector<CacheLine> lines_;
};

/// @brief The next multiple of the floats in a cache line.
[[nodiscard]] constexpr int whole_lines(int floats) {
    constexpr int in_line = sizeof(CacheLine) / sizeof(float);
    return (floats + in_line - 1) / in_line * in_line;
}

}  // namespace ism
