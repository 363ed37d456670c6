// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ism/core/processor.hpp"

namespace CLI {
class App;
}

namespace bench {

/// @brief What a number has to be.
struct Limits {
    std::size_t least = 0, most = std::numeric_limits<std::size_t>::max();
};

/// @brief The command line of a program, read by CLI11, which options.cpp alone compiles. An option that is
/// not given leaves its value as it is.
class Options {
public:
    explicit Options(const std::string& purpose);
    Options(const Options&) = delete;
    Options& operator=(const Options&) = delete;
    ~Options();

    /// @param value  has to stay until parse() has returned
    void add(const std::string& name, std::filesystem::path& value, const std::string& help);
    void add(const std::string& name, std::string& value, const std::string& help,
             const std::vector<std::string>& allowed = {});
    void add(const std::string& name, double& value, const std::string& help);
    void add(const std::string& name, unsigned& value, const std::string& help);
    void add(const std::string& name, std::size_t& value, const std::string& help, Limits limits = {});
    void add(const std::string& name, ism::InstructionSet& value, const std::string& help);
    /// @brief A flag.
    void add(const std::string& name, bool& value, const std::string& help);
    /// @brief A list, its values apart or with commas between them.
    void add(const std::string& name, std::vector<std::string>& values, const std::string& help);
    void add(const std::string& name, std::vector<std::size_t>& values, const std::string& help,
             Limits limits = {});

    /// @brief The exit code, where the program is to end: 0 after --help, 2 after a mistake, told in a line.
    [[nodiscard]] std::optional<int> parse(int argc, char** argv);

private:
    std::unique_ptr<CLI::App> app_;
};

}  // namespace bench
