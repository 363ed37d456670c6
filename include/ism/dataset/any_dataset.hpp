// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

/// @file
/// @brief Labelled images in whatever form they are. By stb_image: see ism/io/images.hpp for what a program
/// needs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "ism/dataset/class_folders.hpp"
#include "ism/dataset/coco.hpp"
#include "ism/dataset/image_files.hpp"

namespace ism {

/// @brief The forms of data sets that are told apart.
enum class DatasetFormat { coco, class_folders, images };

/// @brief What a data set is, and the file or folder to read it from.
struct DatasetPlace {
    DatasetFormat format;
    std::filesystem::path path;
};

/// @brief Tells in which form a file or folder holds a data set. A file is COCO's JSON. A folder holds one
/// JSON file of COCO's, or folders of images, one a class, or images without labels.
/// @throws FileError where it is none of these.
[[nodiscard]] inline DatasetPlace find_dataset(const std::filesystem::path& path) {
    namespace fs = std::filesystem;
    std::error_code ignored;
    if (!fs::is_directory(path, ignored)) return {DatasetFormat::coco, path};
    std::vector<fs::path> json;
    bool folders = false;
    for (const fs::path& entry : detail::folder_entries(path)) {
        if (fs::is_directory(entry, ignored))
            folders = true;
        else if (detail::lower(entry.extension().string()) == ".json")
            json.push_back(entry);
    }
    if (json.size() == 1) return {DatasetFormat::coco, json[0]};
    if (folders) return {DatasetFormat::class_folders, path};
    if (!detail::image_files(path).empty()) return {DatasetFormat::images, path};
    throw FileError("folder '" + one_line(path.string()) + "': expected a data set, got no image");
}

/// @brief Reads a data set in the form that find_dataset() tells.
/// @throws FileError as find_dataset() and the reader of this form do.
[[nodiscard]] inline Dataset read_any_dataset(const std::filesystem::path& path,
                                              const DatasetReadOptions& options = {}) {
    const DatasetPlace place = find_dataset(path);
    switch (place.format) {
        case DatasetFormat::class_folders:
            return read_class_folders(place.path, options);
        case DatasetFormat::images:
            return read_image_folder(place.path, options);
        default:
            return read_dataset(place.path, options.faults);
    }
}

}  // namespace ism
