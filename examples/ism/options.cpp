// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "options.hpp"

#include <algorithm>
#include <cctype>

#include "input.hpp"

#include "ism/core/nearest_name.hpp"

namespace program {

NumberRange between(double least, double most) {
    return {least, most, ism::join_text("from ", least, " to ", most)};
}

ism::Camera parse_camera(const std::string& option, const std::string& text) {
    std::vector<double> numbers;
    for (std::string part : CLI::detail::split(text, ',')) {
        CLI::detail::trim(part);
        double number = 0;
        const auto [stop, failure] = std::from_chars(part.data(), part.data() + part.size(), number);
        if (failure == std::errc{} && stop == part.data() + part.size()) numbers.push_back(number);
    }
    const bool four = numbers.size() == 4 && std::count(text.begin(), text.end(), ',') == 3;
    ism::expect(four, option, "four numbers, FX,FY,CX,CY in pixels", ism::lazy_text("'", text, "'"));
    const ism::Camera camera{numbers[0], numbers[1], numbers[2], numbers[3]};
    ism::check(camera);
    return camera;
}

CLI::Option* only(CLI::Option* option, const std::vector<std::string>& words) {
    const auto refusal = [words](const std::string& text) -> std::string {
        if (std::find(words.begin(), words.end(), text) != words.end()) return {};
        return "expected one of " + list_text(words) + ", got '" + text + "'" +
               ism::did_you_mean(text, words);
    };
    std::string kinds;
    for (const std::string& word : words) kinds += (kinds.empty() ? "{" : "|") + word;
    return option->check(CLI::Validator(refusal, ""))->type_name(kinds + "}");
}

void check_option_names(const CLI::App& command, const std::vector<std::string>& arguments) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
        for (const std::string& name : option->get_snames()) names.push_back("-" + name);
    }
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& argument = arguments[i];
        if (argument == "--") return;
        const bool is_option =
            argument.size() > 1 && argument[0] == '-' &&
            (argument[1] == '-' || std::isalpha(static_cast<unsigned char>(argument[1])) != 0);
        if (!is_option) continue;
        const bool is_long = argument[1] == '-';
        const std::string name = is_long ? argument.substr(0, argument.find('=')) : argument.substr(0, 2);
        const bool known = std::find(names.begin(), names.end(), name) != names.end();
        if (!known) {
            // "-model" is most likely "--model".
            const std::string typed = is_long ? name : argument.size() > 2 ? "-" + argument : argument;
            throw ism::Error("unknown option " + argument.substr(0, argument.find('=')) +
                             ism::did_you_mean(typed, names) + " (ism " + command.get_name() +
                             " --help tells all)");
        }
        // The next argument is its value, whatever it begins with.
        const bool own_value = is_long ? argument != name : argument.size() > 2;
        if (!own_value && command.get_option(name)->get_items_expected_min() > 0) ++i;
    }
}

std::string refusal_text(const CLI::ParseError& error, const std::vector<std::string>& arguments) {
    const std::string text = error.what(), kind = error.get_name(), &command = arguments.front();
    const auto before = [&](const char* part) { return text.substr(0, text.find(part)); };
    const std::string help = "; ism " + command + " --help tells more";
    if (kind == "RequiredError") {
        const std::string lacking = before(" is required");
        const auto model = std::find_if(arguments.begin(), arguments.end(), [](const std::string& argument) {
            return argument.ends_with(".safetensors");
        });
        return command + ": expected " + lacking + ", got none" +
               (lacking == "--model" && model != arguments.end()
                    ? ": did you mean --model " + shell_word(*model) + "?"
                    : help);
    }
    if (kind == "ExcludesError")
        return "expected " + before(" excludes ") + " or " + text.substr(text.find(" excludes ") + 10) +
               ", got both";
    if (kind == "RequiresError")
        return before(" requires ") + ": expected " + text.substr(text.find(" requires ") + 10) +
               " with it, got none";
    if (kind == "ArgumentMismatch") {
        const bool missing = text.ends_with(" missing");
        return before(": ") +
               (missing ? ": expected a value, got none" : ": expected once, got several times") + help;
    }
    if (error.get_exit_code() == int(CLI::ExitCodes::ExtrasError)) {
        const std::size_t colon = text.find(": ");
        return command + ": expected no further argument, got '" +
               (colon == std::string::npos ? text : text.substr(colon + 2)) + "'" + help;
    }
    return text;
}

}  // namespace program
