// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

/// @file
/// @brief Labelled images in whatever form they are. By stb_image: see ism/io/images.hpp for what a program
/// needs.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "ism/dataset/class_folders.hpp"
#include "ism/dataset/coco.hpp"
#include "ism/dataset/image_files.hpp"
#include "ism/dataset/labelme.hpp"
#include "ism/dataset/yolo.hpp"

namespace ism {

/// @brief The forms of data sets that are told apart.
enum class DatasetFormat { json, yolo, voc, labelme, class_folders, images };

/// @brief What a data set is, and the file or folder to read it from.
struct DatasetPlace {
    DatasetFormat format;
    std::filesystem::path path;
};

namespace detail {

/// @brief Whether JSON is that of labelme, else it is COCO's.
[[nodiscard]] inline bool is_labelme(const Json& root) {
    return root.is_object() && root.contains("shapes") && !root.contains("images");
}

/// @brief What the JSON files of a folder are: labelme's, or one of COCO's.
[[nodiscard]] inline DatasetPlace json_of_folder(const std::filesystem::path& folder,
                                                 const std::vector<std::filesystem::path>& files) {
    for (const auto& file : files)
        if (file.filename() == "_annotations.coco.json") return {DatasetFormat::json, file};
    if (files.size() == 1) return {DatasetFormat::json, files[0]};
    if (is_labelme(read_json(files[0]))) return {DatasetFormat::labelme, folder};
    throw FileError(join_text("folder '", one_line(folder.string()),
                              "': expected one JSON file of COCO, or those of labelme, got ", files.size(),
                              " such as '", one_line(files[0].filename().string()), "': name one"));
}

/// @brief Whether a text begins as an object of JSON does.
[[nodiscard]] inline bool begins_as_object(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::string mark(3, '\0');  // some editors put U+FEFF before a text
    if (!stream.read(mark.data(), 3) || mark != "\xEF\xBB\xBF") stream.clear(), stream.seekg(0);
    char first = 0;
    return stream >> first && first == '{';
}

/// @brief Whether a file is JSON that may be labels: an object. Results are an array.
[[nodiscard]] inline bool is_json_object(const std::filesystem::path& file) {
    return lower(file.extension().string()) == ".json" && begins_as_object(file);
}

[[nodiscard]] inline std::vector<std::filesystem::path> json_objects(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    if (!std::filesystem::is_directory(folder)) return files;
    for (const auto& entry : folder_entries(folder))
        if (is_json_object(entry)) files.push_back(entry);
    return files;
}

[[nodiscard]] inline bool has_folder(const std::filesystem::path& folder) {
    for (const auto& entry : folder_entries(folder))
        if (std::filesystem::is_directory(entry)) return true;
    return false;
}

[[nodiscard]] inline bool has_xml(const std::filesystem::path& folder) {
    if (!std::filesystem::is_directory(folder)) return false;
    for (const auto& entry : folder_entries(folder))
        if (lower(entry.extension().string()) == ".xml") return true;
    return false;
}

}  // namespace detail

/// @brief Tells in which form a file or folder holds a data set. A file is JSON of COCO or labelme, YAML of
/// YOLO, or of Pascal VOC the XML of an image or a list of ImageSets. In a folder the first of these counts:
/// YOLO's YAML file, Annotations with XML or XML beside the images, YOLO's labels or classes.txt, in it or in
/// annotations one JSON file of COCO or any of labelme, folders of images, images.
/// @throws FileError where it is none of these.
[[nodiscard]] inline DatasetPlace find_dataset(const std::filesystem::path& path) {
    namespace fs = std::filesystem;
    const std::string ending = detail::lower(path.extension().string());
    if (!fs::is_directory(path)) {
        if (ending == ".yaml" || ending == ".yml") return {DatasetFormat::yolo, path};
        if (ending == ".xml" || path.parent_path().parent_path().filename() == "ImageSets")
            return {DatasetFormat::voc, path};
        if (detail::is_image_name(path))
            throw FileError(
                file_text(path) +
                ": expected a file or folder of labels, got an image; detect takes one without --data");
        return {DatasetFormat::json, path};
    }
    const fs::path described = detail::yolo_file(path);
    if (described.extension() == ".yaml" || described.extension() == ".yml")
        return {DatasetFormat::yolo, path};
    if (detail::has_xml(path / "Annotations") || detail::has_xml(path)) return {DatasetFormat::voc, path};
    if (!described.empty() || fs::is_directory(path / "labels")) return {DatasetFormat::yolo, path};
    if (path.filename() == "images" && fs::is_directory(path.parent_path() / "labels"))
        return {DatasetFormat::yolo, path};
    for (const fs::path& folder : {path, path / "annotations"}) {
        const std::vector<fs::path> json = detail::json_objects(folder);
        if (!json.empty()) return detail::json_of_folder(folder, json);
    }
    if (detail::has_folder(path)) return {DatasetFormat::class_folders, path};
    if (!detail::image_files(path).empty()) return {DatasetFormat::images, path};
    throw FileError("folder '" + one_line(path.string()) + "': expected a data set, got no image");
}

/// @brief Reads a data set that find_dataset() found.
/// @throws FileError as the reader of its form does, and for Pascal VOC, whose XML the program `ism` alone
/// reads.
[[nodiscard]] inline Dataset read_any_dataset(const DatasetPlace& place,
                                              const DatasetReadOptions& options = {}) {
    switch (place.format) {
        case DatasetFormat::yolo:
            return read_yolo(place.path, options);
        case DatasetFormat::voc:
            throw FileError(file_text(place.path) +
                            ": expected no XML of Pascal VOC, which the program ism alone reads, got it");
        case DatasetFormat::labelme:
            return read_labelme(place.path, options);
        case DatasetFormat::class_folders:
            return read_class_folders(place.path, options);
        case DatasetFormat::images:
            return read_image_folder(place.path, options);
        case DatasetFormat::json:
            break;
    }
    const detail::Json root = detail::read_json(place.path);
    if (detail::is_labelme(root)) return read_labelme(place.path, options);
    return detail::dataset_from_json(root, place.path, options.faults);
}

/// @brief Reads a data set in the form that find_dataset() tells.
/// @throws FileError as find_dataset() and the other read_any_dataset() do.
[[nodiscard]] inline Dataset read_any_dataset(const std::filesystem::path& path,
                                              const DatasetReadOptions& options = {}) {
    return read_any_dataset(find_dataset(path), options);
}

}  // namespace ism
