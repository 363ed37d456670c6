// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "support/data_sets.hpp"

#include <cstdlib>

#include "ism/dataset/coco.hpp"

namespace bench {

std::filesystem::path data_folder() {
    const char* folder = std::getenv("ISM_DATA");
    return folder != nullptr && *folder != '\0' ? folder : ISM_DEFAULT_DATA;
}

std::filesystem::path data_file(const std::filesystem::path& file) {
    ism::expect(std::filesystem::exists(file), file.string(),
                "public data there; ISM_DATA or --data names its folder", "none");
    return file;
}

ism::Dataset read_set(const std::filesystem::path& file) {
    data_file(file);
    return ism::read_dataset(file);
}

ism::Dataset held_out(const std::filesystem::path& folder, const std::vector<std::string>& class_names) {
    const bool has_test = std::filesystem::exists(folder / "test.json");
    return ism::select_classes(read_set(folder / (has_test ? "test.json" : "val.json")), class_names);
}

}  // namespace bench
