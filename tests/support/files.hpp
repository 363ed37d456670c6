// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <filesystem>
#include <random>
#include <string>
#include <system_error>

#include "ism/core/error.hpp"
#include "ism/core/number_text.hpp"
#include "ism/io/write_file.hpp"

namespace ism::test {

/// @brief An empty folder of its own that goes away with all in it.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::random_device device;
        path_ = std::filesystem::temp_directory_path() /
                join_text("ism-test-", hex_text(device(), 8), hex_text(device(), 8));
        std::filesystem::create_directories(path_);
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

/// @brief Makes a folder the current one for as long as it lives.
class WorkingFolder {
public:
    explicit WorkingFolder(const std::filesystem::path& folder) : before_(std::filesystem::current_path()) {
        std::filesystem::current_path(folder);
    }
    ~WorkingFolder() {
        std::error_code ignored;
        std::filesystem::current_path(before_, ignored);
    }
    WorkingFolder(const WorkingFolder&) = delete;
    WorkingFolder& operator=(const WorkingFolder&) = delete;

private:
    std::filesystem::path before_;
};

/// @brief Writes a file, and makes the folders above it.
inline void write_text(const std::filesystem::path& path, const std::string& text) {
    std::filesystem::create_directories(path.parent_path());
    write_file(path, text);
}

/// @brief Writes a grey image of one brightness, as PNM.
inline void write_pnm(const std::filesystem::path& path, int width, int height) {
    write_text(path, join_text("P5 ", width, " ", height, " 255\n") +
                         std::string(std::size_t(width) * std::size_t(height), 'x'));
}

/// @brief The message of the E that `call` throws; "nothing thrown" where it throws nothing.
template <class E = Error, std::invocable Call>
[[nodiscard]] std::string error_message(Call&& call) {
    try {
        call();
    } catch (const E& error) {
        return error.what();
    }
    return "nothing thrown";
}

}  // namespace ism::test
