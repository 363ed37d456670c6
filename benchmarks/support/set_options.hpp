// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "support/data_sets.hpp"
#include "support/options.hpp"

namespace bench {

/// @brief Options of a benchmark that learns from train.json of sets and looks at their test.json or
/// val.json.
struct SetOptions {
    std::vector<std::string> sets;
    std::filesystem::path data = data_folder();
    unsigned threads = 0;

    /// @brief The command line must not outlive these options.
    void add_to(Options& command_line) {
        command_line.add("--data", data, "folder of the data sets");
        command_line.add("--sets", sets, "with train.json, and test.json or val.json");
        command_line.add("--threads", threads, "0 = as many as the machine has");
    }
};

}  // namespace bench
