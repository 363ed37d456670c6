// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "ism/core/error.hpp"
#include "ism/core/number_text.hpp"

/// File names in messages and in JSON.
namespace ism {

/// @brief A text without line breaks and other control characters: "\\x0a" and so on stand for them.
[[nodiscard]] inline std::string one_line(std::string_view text) {
    std::string line;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte == 0x7f)
            line += "\\x" + hex_text(byte, 2);
        else
            line += c;
    }
    return line;
}

/// @brief "file 'a/b.png'", for messages.
[[nodiscard]] inline std::string file_text(const std::filesystem::path& path) {
    return join_text("file '", one_line(path.string()), "'");
}

/// @brief Calls `read` and returns what it gives; the message of an Error gets `place`, such as file_text(),
/// before it.
/// @throws FileError where `read` throws an Error.
template <std::invocable Read>
decltype(auto) at_place(const std::string& place, Read&& read) {
    try {
        return read();
    } catch (const Error& error) {
        throw FileError(place + ": " + error.what());
    }
}

/// @brief A file name as it stands in JSON: UTF-8, folders separated by "/".
[[nodiscard]] inline std::string path_to_utf8(const std::filesystem::path& path) {
    const std::u8string text = path.generic_u8string();
    return std::string(text.begin(), text.end());
}

/// @brief The reverse of path_to_utf8().
/// @throws FileError for a text with a NUL character, where the system would cut the name.
[[nodiscard]] inline std::filesystem::path path_from_utf8(const std::string& text) {
    expect<FileError>(text.find('\0') == std::string::npos, "file name", "no NUL character",
                      lazy_text("'", one_line(text), "'"));
    return std::filesystem::path(std::u8string(text.begin(), text.end()));
}

/// @brief `file` as seen from `folder` (empty: the current one), by the names alone: no link is followed and
/// neither needs to exist. Where the two have nothing in common it is the absolute path of the file.
/// @throws FileError where `file` has no name, or the current folder is needed and gone.
[[nodiscard]] inline std::filesystem::path relative_to(const std::filesystem::path& file,
                                                       const std::filesystem::path& folder) {
    const auto whole = [&](const std::filesystem::path& path) {
        std::error_code failure;
        const auto absolute = std::filesystem::absolute(path, failure);
        expect<FileError>(!failure, file_text(file), "a name with a place", failure.message());
        return absolute;
    };
    const auto target = whole(file).lexically_normal();
    const auto from = (whole(folder.empty() ? "." : folder) / "").lexically_normal();
    const auto relative = target.lexically_relative(from);
    return relative.empty() ? target : relative;
}

}  // namespace ism
