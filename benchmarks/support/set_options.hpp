// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "support/photographs.hpp"
#include <CLI/CLI.hpp>

namespace bench {

/// @brief Options of a benchmark that learns from train.json of sets and looks at their test.json or
/// val.json.
struct SetOptions {
    std::vector<std::string> sets;
    std::filesystem::path data = data_folder();
    unsigned threads = 0;

    /// @brief The app must not outlive these options.
    void add_to(CLI::App& app) {
        app.add_option("--data", data, "folder of the data sets");
        app.add_option("--sets", sets, "with train.json, and test.json or val.json")
            ->delimiter(',')
            ->capture_default_str();
        app.add_option("--threads", threads, "0 = as many as the machine has");
    }
};

}  // namespace bench
