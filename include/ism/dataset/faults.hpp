// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <string>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"

namespace ism {

/// @brief What is wrong with single labels or images of a data set, a line each.
using Faults = std::vector<std::string>;

/// @brief Calls `read`. Where it throws an Error and there is a list, its message is added to the list.
/// @return whether nothing was thrown
/// @throws what `read` throws, where there is no list.
template <std::invocable Read>
bool read_or_tell(Faults* faults, Read&& read) {
    if (faults == nullptr) return std::forward<Read>(read)(), true;
    try {
        std::forward<Read>(read)();
        return true;
    } catch (const Error& error) {
        faults->push_back(error.what());
        return false;
    }
}

}  // namespace ism
