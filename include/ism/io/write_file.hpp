// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cerrno>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <ios>
#include <limits>
#include <locale>
#include <ostream>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/number_text.hpp"
#include "ism/io/paths.hpp"

namespace ism {

namespace detail {

/// @brief Why the last call of the operating system failed.
[[nodiscard]] inline std::string system_reason() {
    return errno != 0 ? std::generic_category().message(errno) : std::string("an unknown failure");
}

/// @brief The whole file as bytes, kept in a std::string or a std::vector.
template <class Bytes>
requires(sizeof(typename Bytes::value_type) == 1) [[nodiscard]] Bytes
    read_whole(const std::filesystem::path& path, std::uintmax_t most_bytes) {
    std::error_code ignored;
    const auto status = std::filesystem::status(path, ignored);
    if (status.type() == std::filesystem::file_type::not_found)
        throw FileError(file_text(path) + ": expected a file to read, got none of this name");
    if (std::filesystem::is_directory(status))
        throw FileError(file_text(path) + ": expected a file to read, got a folder");
    errno = 0;
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw FileError(file_text(path) + ": expected a readable file, got " + system_reason());
    const std::uintmax_t size = std::filesystem::file_size(path, ignored);
    const bool sized = std::filesystem::is_regular_file(status) && !ignored;
    if (sized && size > most_bytes)
        throw FileError(join_text(file_text(path), ": expected at most ", most_bytes, " bytes, got ", size));
    Bytes bytes;
    bytes.resize(sized ? std::size_t(size) + 1 : 65536);
    std::size_t count = 0;
    while (stream) {
        if (count == bytes.size()) bytes.resize(2 * count);
        stream.read(reinterpret_cast<char*>(bytes.data()) + count, std::streamsize(bytes.size() - count));
        count += std::size_t(stream.gcount());
        if (count > most_bytes)
            throw FileError(
                join_text(file_text(path), ": expected at most ", most_bytes, " bytes, got more"));
    }
    if (stream.bad()) throw FileError(file_text(path) + ": expected a readable file, got " + system_reason());
    bytes.resize(count);
    return bytes;
}

/// @brief Makes sure that what a file holds may be replaced: renaming over it would not ask.
/// @throws FileError where it is write-protected.
inline void check_replaceable(const std::filesystem::path& path) {
    namespace fs = std::filesystem;
    std::error_code failure;
    const fs::file_status status = fs::status(path, failure);
    if (!fs::is_regular_file(status)) return;
    constexpr fs::perms write = fs::perms::owner_write | fs::perms::group_write | fs::perms::others_write;
    const bool writable = (status.permissions() & write) != fs::perms::none;
    if (!writable || !std::ofstream(path, std::ios::binary | std::ios::app))
        throw FileError(file_text(path) +
                        ": expected a file that may be replaced, got a write-protected one");
}

}  // namespace detail

/// @brief All bytes of a file.
/// @throws FileError where there is no such file, it is a folder, cannot be read, or is larger than
/// `most_bytes`.
[[nodiscard]] inline std::vector<std::uint8_t> read_bytes(
    const std::filesystem::path& path,
    std::uintmax_t most_bytes = std::numeric_limits<std::uintmax_t>::max()) {
    return detail::read_whole<std::vector<std::uint8_t>>(path, most_bytes);
}

/// @brief All bytes of a file as a string, unchanged.
/// @throws FileError as read_bytes() does.
[[nodiscard]] inline std::string read_text(
    const std::filesystem::path& path,
    std::uintmax_t most_bytes = std::numeric_limits<std::uintmax_t>::max()) {
    return detail::read_whole<std::string>(path, most_bytes);
}

/// @brief Writes a file atomically: `write(stream)` fills a temporary file in the same folder, which is then
/// renamed to `path`; a file that was there leaves it its permissions. On failure `path` is unchanged and the
/// temporary file is removed. What is not a regular file (a pipe, /dev/stdout) is written directly.
/// @throws FileError where the folder is missing or cannot be written to, `path` is a folder or
/// write-protected, or the disk is full; and whatever `write` throws.
template <std::invocable<std::ostream&> Write>
void write_file(const std::filesystem::path& path, Write&& write) {
    namespace fs = std::filesystem;
    std::error_code failure;
    const auto status = fs::status(path, failure);
    const std::string text = file_text(path);
    if (fs::is_directory(status)) throw FileError(text + ": expected a file to write, got a folder");
    if (path.filename().empty()) throw FileError(text + ": expected a file to write, got no file name");
    if (status.type() == fs::file_type::none)  // a link to itself, say, or a folder that may not be entered
        throw FileError(text + ": expected a place to write to, got " + failure.message());
    const bool direct = fs::exists(status) && !fs::is_regular_file(status);
    detail::check_replaceable(path);
    fs::path target = path;
    if (fs::is_regular_file(status)) {
        target = fs::canonical(path, failure);  // a link stays a link
        if (failure) target = path;
    }
    fs::path temporary = target;
    if (!direct) {
        std::random_device device;
        temporary += join_text(".", hex_text(device(), 8), hex_text(device(), 8), ".tmp");
    }
    const auto remove_temporary = [&] {
        if (!direct) fs::remove(temporary, failure);
    };
    errno = 0;
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    stream.imbue(std::locale::classic());
    if (!stream) throw FileError(text + ": expected a place to write to, got " + detail::system_reason());
    try {
        std::forward<Write>(write)(static_cast<std::ostream&>(stream));
        stream.close();
        if (!stream) throw FileError(text + ": expected to write it whole, got " + detail::system_reason());
        if (!direct) {
            if (fs::exists(status)) fs::permissions(temporary, status.permissions(), failure);
            fs::rename(temporary, target, failure);
            if (failure) throw FileError(text + ": expected to put it in place, got " + failure.message());
        }
    } catch (...) {
        stream.close();
        remove_temporary();
        throw;
    }
}

/// @brief Writes `bytes` to a file atomically.
/// @throws FileError as the other write_file() does.
inline void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
    write_file(path, [&](std::ostream& stream) {
        stream.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    });
}

/// @brief Writes `text` to a file atomically, unchanged.
/// @throws FileError as the other write_file() does.
inline void write_file(const std::filesystem::path& path, std::string_view text) {
    write_file(path, [&](std::ostream& stream) { stream.write(text.data(), std::streamsize(text.size())); });
}

}  // namespace ism
