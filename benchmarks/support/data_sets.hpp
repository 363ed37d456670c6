// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ism/dataset/dataset.hpp"

namespace bench {

/// @brief Where the real images are: the environment's ISM_DATA, else the project's ../shared/data.
[[nodiscard]] std::filesystem::path data_folder();

/// @brief The same, where it is there.
/// @throws ism::Error, telling how the folder of the data is named, else
std::filesystem::path data_file(const std::filesystem::path& file);

/// @brief ism::read_dataset(), which data_sets.cpp alone compiles.
[[nodiscard]] ism::Dataset read_set(const std::filesystem::path& file);

/// @brief What figures are told for: test.json of a set's folder, or val.json, with the classes of a model.
[[nodiscard]] ism::Dataset held_out(const std::filesystem::path& folder,
                                    const std::vector<std::string>& class_names);

}  // namespace bench
