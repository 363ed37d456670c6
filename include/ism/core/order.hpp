// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/config.hpp"

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
inline void sort_ranked(std::span<Ranked> ranked) {
    std::sort(ranked.data(), ranked.data() + ranked.size(), [](const Ranked& a, const Ranked& b) {
        return a.key < b.key || (a.key == b.key && a.index < b.index);
    });
}

/// Sorts values by rising key(value); equal ones stay in their order.
template <class T, std::invocable<const T&> Key>
void sort_by(std::vector<T>& values, const Key& key) {
    std::vector<Ranked> order(values.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = {key(values[i]), i};
    sort_ranked(order);
    std::vector<T> sorted;
    sorted.reserve(values.size());
    for (const Ranked& next : order) sorted.push_back(std::move(values[next.index]));
    values = std::move(sorted);
}

}  // namespace ism::detail
