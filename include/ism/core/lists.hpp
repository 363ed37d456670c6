// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "ism/core/callable.hpp"

/// For each type of values these cost a compiler a third of what std::vector::insert() and resize(),
/// std::any_of() and std::erase_if() do.
namespace ism::detail {

/// Adds values to the end of a list.
template <class T>
void append(std::vector<T>& list, const std::vector<T>& values) {
    for (const T& value : values) list.push_back(value);
}

/// Room for at least so many values. Where there is too little, all become new.
template <class T>
void make_room(std::vector<T>& list, std::size_t count) {
    if (list.size() < count) list = std::vector<T>(count);
}

/// Drops all values but the first `count`.
template <class T>
void keep_first(std::vector<T>& list, std::size_t count) {
    while (list.size() > count) list.pop_back();
}

/// Whether any value satisfies `test`.
template <class T, Callable<const T&> Test>
[[nodiscard]] bool any_of(const std::vector<T>& list, const Test& test) {
    for (const T& value : list)
        if (test(value)) return true;
    return false;
}

/// Drops the values that satisfy `test`; the others stay in order.
template <class T, Callable<const T&> Test>
void drop_if(std::vector<T>& list, const Test& test) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < list.size(); ++i)
        if (!test(list[i])) {
            if (kept < i) list[kept] = std::move(list[i]);
            ++kept;
        }
    keep_first(list, kept);
}

}  // namespace ism::detail
