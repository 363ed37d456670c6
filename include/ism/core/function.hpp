// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <utility>

#include "ism/core/error.hpp"
#include "ism/core/shared.hpp"

namespace ism {

template <class Signature>
class Function;

/// @brief Whatever can be called as R(Arguments...), or nothing; copies share it. In place of std::function,
/// since `functional` brings hash maps and searchers with it: 19 MB of what ism/ism.hpp costs to compile.
template <class R, class... Arguments>
class Function<R(Arguments...)> {
public:
    Function() = default;
    template <std::invocable<Arguments...> F>
    requires(!std::same_as<F, Function>) Function(F function)
        : function_(Shared<void>::make<F>(std::move(function))),
          call_([](void* what, Arguments... arguments) -> R {
              return (*static_cast<F*>(what))(std::forward<Arguments>(arguments)...);
          }) {}

    [[nodiscard]] explicit operator bool() const { return call_ != nullptr; }
    /// @throws Error where there is nothing to call, and what the call throws.
    R operator()(Arguments... arguments) const {
        expect(call_ != nullptr, "function", "one to call", "none");
        return call_(function_.get(), std::forward<Arguments>(arguments)...);
    }

private:
    Shared<void> function_;
    R (*call_)(void* what, Arguments... arguments) = nullptr;
};

}  // namespace ism
