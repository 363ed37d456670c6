// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <string>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>

#include "ism/core/camera.hpp"
#include "ism/core/error.hpp"

namespace program {

/// Which numbers an option takes, and how that is told.
struct NumberRange {
    double least = 0, most = 1e9;
    std::string text = "0 or more";
};

/// "from LEAST to MOST".
[[nodiscard]] NumberRange between(double least, double most);

/// The number that an option was given.
/// @throws ism::Error, naming the option, its range and the text, where it is no such number.
template <class Number>
[[nodiscard]] Number parse_number(const std::string& option, const std::string& text,
                                  const NumberRange& range) {
    Number number{};
    const char* const end = text.data() + text.size();
    const auto [stop, failure] = std::from_chars(text.data(), end, number);
    const bool inside = failure == std::errc{} && stop == end && double(number) >= range.least &&
                        double(number) <= range.most;
    ism::expect(inside, option,
                ism::lazy_text(std::integral<Number> ? "a whole number, " : "a number, ", range.text),
                failure == std::errc::result_out_of_range && stop == end ? text + ", too large a number"
                                                                         : "'" + text + "'");
    return number;
}

/// An option that takes a number of a range, and whose value is told as its default.
template <class Number>
CLI::Option* add_number(CLI::App& app, const std::string& name, Number& number, const NumberRange& range,
                        const std::string& help) {
    return app
        .add_option_function<std::string>(
            name,
            [&number, name, range](const std::string& text) {
                number = parse_number<Number>(name, text, range);
            },
            help + " (" + range.text + ")")
        ->type_name("NUMBER")
        ->default_str(ism::join_text(number));
}

/// A camera as FX,FY,CX,CY.
/// @throws ism::Error, naming the option, where it is none.
[[nodiscard]] ism::Camera parse_camera(const std::string& option, const std::string& text);

/// An option that takes one of these words.
CLI::Option* only(CLI::Option* option, const std::vector<std::string>& words);

/// Refuses what is no option of the command, and names the nearest one.
/// @param arguments  those after the command's name
/// @throws ism::Error
void check_option_names(const CLI::App& command, const std::vector<std::string>& arguments);

/// What CLI11 says is wrong, in this program's words.
/// @param arguments  the command and those after it
[[nodiscard]] std::string refusal_text(const CLI::ParseError& error,
                                       const std::vector<std::string>& arguments);

}  // namespace program
