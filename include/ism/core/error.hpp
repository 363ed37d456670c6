// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <locale>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "ism/config.hpp"

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

/// @brief Joins its arguments into one string as a stream would print them.
template <class... Parts>
[[nodiscard]] std::string join_text(const Parts&... parts) {
    std::ostringstream text;
    text.imbue(std::locale::classic());  // the same text wherever the program runs
    (text << ... << parts);
    return text.str();
}

/// @brief Throws E unless `holds`, with the message "`what`: expected `expected`, got `actual`".
template <class E = Error, class Expected, class Actual>
void expect(bool holds, std::string_view what, const Expected& expected, const Actual& actual) {
    if (!holds) throw E(join_text(what, ": expected ", expected, ", got ", actual));
}

}  // namespace ism
