// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "ism/core/error.hpp"
#include "ism/io/paths.hpp"
#include "ism/io/write_file.hpp"

/// Reading JSON with messages that name the place: `place` is the file and the record, such as
/// "file 'a.json', annotation 7".
namespace ism::detail {

using Json = nlohmann::json;

[[noreturn]] inline void refuse_json(const std::string& place, std::string_view what,
                                     std::string_view expected, std::string_view actual) {
    throw FileError(one_line(join_text(place, ": ", what, ": expected ", expected, ", got ", actual)));
}

/// @brief A short description of a JSON value, for messages.
[[nodiscard]] inline std::string json_text(const Json& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return join_text("an array of ", value.size());
    const std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
    return text.size() <= 60 ? text : text.substr(0, 57) + "...";
}

/// @brief The JSON of a text.
/// @throws FileError with line and column where it is malformed.
[[nodiscard]] inline Json parse_json(std::string_view text, const std::string& place) {
    try {
        return Json::parse(text);
    } catch (const Json::exception& error) {
        const std::string reason =
            error.what();  // "[json.exception...] parse error at line 1, column 2: ..."
        const std::size_t begin = reason.find("] ");
        throw FileError(place + ": expected well-formed JSON, got " +
                        (begin == std::string::npos ? reason : reason.substr(begin + 2)));
    }
}

/// @brief The largest JSON file that is read; what is larger is refused before memory is taken for it.
inline constexpr std::uintmax_t max_json_bytes = std::uintmax_t(1) << 31;

/// @brief The JSON of a file.
/// @throws FileError where it cannot be read, is too large, or malformed.
[[nodiscard]] inline Json read_json(const std::filesystem::path& path) {
    return parse_json(read_text(path, max_json_bytes), file_text(path));
}

/// @brief JSON as text, without line breaks.
/// @throws FileError where a string is not UTF-8.
[[nodiscard]] inline std::string dump_json(const Json& value, const std::string& place) {
    try {
        return value.dump();
    } catch (const Json::exception&) {
        throw FileError(place + ": expected names in UTF-8, got other bytes");
    }
}

/// @brief The member `key` of an object; none where it is missing or null.
[[nodiscard]] inline const Json* optional_member(const Json& object, const char* key,
                                                 const std::string& place) {
    if (!object.is_object()) throw FileError(place + ": expected an object, got " + json_text(object));
    const auto found = object.find(key);
    return found == object.end() || found->is_null() ? nullptr : &*found;
}

[[nodiscard]] inline const Json& member(const Json& object, const char* key, const std::string& place,
                                        std::string_view expected = "a value") {
    const Json* found = optional_member(object, key, place);
    if (found == nullptr) refuse_json(place, key, expected, object.contains(key) ? "null" : "nothing");
    return *found;
}

[[nodiscard]] inline double to_number(const Json& value, std::string_view what, const std::string& place) {
    if (!value.is_number() || !std::isfinite(value.get<double>()))
        refuse_json(place, what, "a number", json_text(value));
    return value.get<double>();
}

/// @brief A whole number; 3.0 is one too.
[[nodiscard]] inline std::int64_t to_integer(const Json& value, std::string_view what,
                                             const std::string& place) {
    constexpr std::string_view expected = "a whole number";
    if (value.is_number_unsigned() && value.get<std::uint64_t>() > std::uint64_t(INT64_MAX))
        refuse_json(place, what, expected, json_text(value));
    if (value.is_number_integer()) return value.get<std::int64_t>();
    if (!value.is_number() || std::abs(value.get<double>()) > 0x1p53 ||
        value.get<double>() != std::trunc(value.get<double>()))
        refuse_json(place, what, expected, json_text(value));
    return static_cast<std::int64_t>(value.get<double>());
}

[[nodiscard]] inline double number_member(const Json& object, const char* key, const std::string& place) {
    return to_number(member(object, key, place, "a number"), key, place);
}

[[nodiscard]] inline std::int64_t integer_member(const Json& object, const char* key,
                                                 const std::string& place) {
    return to_integer(member(object, key, place, "a whole number"), key, place);
}

[[nodiscard]] inline const std::string& to_text(const Json& value, std::string_view what,
                                                const std::string& place) {
    if (!value.is_string()) refuse_json(place, what, "a text", json_text(value));
    if (value.get_ref<const std::string&>().empty()) refuse_json(place, what, "a text", "an empty one");
    return value.get_ref<const std::string&>();
}

[[nodiscard]] inline const std::string& text_member(const Json& object, const char* key,
                                                    const std::string& place) {
    return to_text(member(object, key, place, "a text"), key, place);
}

[[nodiscard]] inline const Json& array_member(const Json& object, const char* key, const std::string& place) {
    const Json& value = member(object, key, place, "an array");
    if (!value.is_array()) refuse_json(place, key, "an array", json_text(value));
    return value;
}

/// @brief A number as JSON, without a decimal point where it is whole.
[[nodiscard]] inline Json number_json(double value) {
    if (value == std::trunc(value) && std::abs(value) < 0x1p53) return static_cast<std::int64_t>(value);
    return value;
}

}  // namespace ism::detail
