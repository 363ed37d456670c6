// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>

#include "ism/core/text.hpp"

namespace ism {

/// @brief Base of every exception this library throws. The message is one line and names the value or
/// file at fault, what was expected and what was found.
class Error : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// @brief A file that cannot be read or written, or whose content is not what it should be.
class FileError : public Error {
    using Error::Error;
};

namespace detail {

/// Kept out of line: nothing of it is compiled into the loops that check.
template <class E>
[[noreturn, gnu::cold, gnu::noinline]] void refuse(const TextPart& what, const TextPart& expected,
                                                   const TextPart& actual) {
    throw E(join_text(what, ": expected ", expected, ", got ", actual));
}

}  // namespace detail

/// @brief Throws E unless `holds`, with the message "`what`: expected `expected`, got `actual`". The message
/// is made only then: see lazy_text() for one of several parts.
template <class E = Error>
void expect(bool holds, const TextPart& what, const TextPart& expected, const TextPart& actual) {
    if (!holds) [[unlikely]]
        detail::refuse<E>(what, expected, actual);
}

}  // namespace ism
