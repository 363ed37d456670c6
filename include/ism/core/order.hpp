// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "ism/core/callable.hpp"

/// Whatever is sorted is sorted by whole numbers, and by the one function here: each other type that
/// std::sort() or std::stable_sort() meets costs every compilation some megabytes.
namespace ism::detail {

/// A number that rises with a value; −0 is 0. Two of 32 bits make one key, the first above the second.
[[nodiscard]] inline std::uint32_t rising(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value + 0.0f), sign = std::uint32_t(1) << 31;
    return (bits & sign) != 0 ? ~bits : bits | sign;
}
[[nodiscard]] inline std::uint64_t rising(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value + 0.0), sign = std::uint64_t(1) << 63;
    return (bits & sign) != 0 ? ~bits : bits | sign;
}

/// A number that falls as a value rises.
[[nodiscard]] inline std::uint32_t falling(float value) {
    return ~rising(value);
}
[[nodiscard]] inline std::uint64_t falling(double value) {
    return ~rising(value);
}

/// One key of two, the first of which counts more.
[[nodiscard]] inline std::uint64_t joined(std::uint32_t first, std::uint32_t second) {
    return std::uint64_t(first) << 32 | second;
}

/// The key of a value, and which one it is.
struct Ranked {
    std::uint64_t key;
    std::uint32_t index;
};

/// By rising key, of equal ones by index. Allocates nothing.
inline void sort_ranked(Ranked* ranked, std::size_t count) {
    std::sort(ranked, ranked + count, [](const Ranked& a, const Ranked& b) {
        return a.key < b.key || (a.key == b.key && a.index < b.index);
    });
}

/// Sorts values by rising key(value); equal ones stay in their order.
template <class T, Callable<const T&> Key>
void sort_by(std::vector<T>& values, const Key& key) {
    std::vector<Ranked> order(values.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = {key(values[i]), i};
    sort_ranked(order.data(), order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        if (order[i].index == i) continue;
        T first = std::move(values[i]);  // of a cycle of values that change places
        std::uint32_t to = i;
        while (order[to].index != i) {
            values[to] = std::move(values[order[to].index]);
            to = std::exchange(order[to].index, to);
        }
        values[to] = std::move(first);
        order[to].index = to;
    }
}

/// The value that `n` of the others come before, in any order of equal ones; they are reordered. The middle
/// one of an odd number is their median.
[[nodiscard]] inline float nth_smallest(std::vector<float>& values, std::size_t n) {
    const auto nth = values.begin() + std::ptrdiff_t(n);
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

}  // namespace ism::detail
