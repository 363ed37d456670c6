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
        : function_(Shared<void>::make<F>(std::move(function))), call_(call<F>) {}

    /// @brief Calls an F that is made in place, of these values: it is never moved.
    template <std::invocable<Arguments...> F, class... Values>
    requires std::constructible_from<F, Values...>
    [[nodiscard]] static Function make(Values&&... values) {
        Function function;
        function.function_ = Shared<void>::make<F>(std::forward<Values>(values)...);
        function.call_ = call<F>;
        return function;
    }

    [[nodiscard]] explicit operator bool() const { return function_.get() != nullptr; }
    /// @throws Error where there is nothing to call, and what the call throws.
    R operator()(Arguments... arguments) const {
        expect(bool(*this), "function", "one to call", "none");
        return call_(function_.get(), std::forward<Arguments>(arguments)...);
    }

private:
    template <class F>
    static R call(void* what, Arguments... arguments) {
        return (*static_cast<F*>(what))(std::forward<Arguments>(arguments)...);
    }

    Shared<void> function_;
    R (*call_)(void* what, Arguments... arguments) = nullptr;
};

}  // namespace ism
