// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "support/catch.hpp"
#include "support/skipped.hpp"

namespace ism::test {

/// @brief Where the real images are expected: the environment's ISM_DATA, else the project's ../shared/data.
[[nodiscard]] inline std::filesystem::path data_folder() {
    const char* folder = std::getenv("ISM_DATA");
    return folder != nullptr && *folder != '\0' ? folder : ISM_DEFAULT_DATA;
}

/// @brief The path of a file or folder of the real data, "uiuc-cars/train.json" say; nothing where it is
/// missing: the test then says so and returns. With CI set in the environment that is a failure.
[[nodiscard]] inline std::optional<std::filesystem::path> find_data(const std::string& name) {
    std::error_code ignored;
    const std::filesystem::path path = data_folder() / name;
    if (std::filesystem::exists(path, ignored)) return path;
    const std::string message = "no data at " + path.string() + "; set ISM_DATA to the folder of the data";
    const char* ci = std::getenv("CI");
    if (ci != nullptr && *ci != '\0') FAIL(message);
    WARN("skipped: " << message);
    ++skipped_tests();
    return std::nullopt;
}

}  // namespace ism::test
