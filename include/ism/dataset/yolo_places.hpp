// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "ism/dataset/image_files.hpp"
#include "ism/dataset/yaml_lists.hpp"

/// Where a data set of YOLO has its images, and the names of its classes.
namespace ism::detail {

/// @brief The names of the classes, and the files or folders of images.
struct YoloPlaces {
    std::filesystem::path root;
    std::vector<std::string> names;
    std::vector<std::filesystem::path> images;
    std::string part = {};  ///< that is read, as the file or folder names it; empty where nothing names it
};

/// @brief Calls `use` for each line that is not empty; U+FEFF, which some editors put first, is no part of
/// it.
template <class Use>
void for_lines(std::string_view text, const Use& use) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    for (std::size_t number = 1; !text.empty(); ++number) {
        const std::size_t end = text.find('\n');
        const std::string_view line = trimmed(text.substr(0, end));
        if (!line.empty()) use(line, number);
        text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
    }
}

[[nodiscard]] inline std::vector<std::string> lines_of(const std::filesystem::path& path) {
    std::vector<std::string> lines;
    for_lines(read_text(path, 1 << 30),
              [&](std::string_view line, std::size_t) { lines.emplace_back(line); });
    return lines;
}

/// @brief The text file that describes a data set of YOLO in this folder; empty where there is none.
[[nodiscard]] inline std::filesystem::path yolo_file(const std::filesystem::path& folder) {
    for (const char* name : {"data.yaml", "data.yml", "dataset.yaml", "dataset.yml", "classes.txt",
                             "labels/classes.txt", "images/classes.txt"})
        if (std::filesystem::is_regular_file(folder / name)) return folder / name;
    return {};
}

/// @brief A path of a YAML file. Roboflow writes "../train/images" for what is beside the file.
[[nodiscard]] inline std::filesystem::path yolo_path(const std::filesystem::path& root, std::string name) {
    const std::filesystem::path whole = root / path_from_utf8(name);
    if (std::filesystem::exists(whole) || !name.starts_with("../")) return whole;
    return root / path_from_utf8(name.substr(3));
}

[[nodiscard]] inline std::vector<std::string> yolo_names(const std::vector<YamlItem>& items,
                                                         const std::string& place) {
    std::vector<std::string> names;
    for (const YamlItem& item : items) {
        if (!item.key.empty() && item.key != std::to_string(names.size()))
            throw FileError(
                join_text(place, ": names: expected classes 0, 1, 2 … in this order, got '", item.key, "'"));
        names.push_back(item.value);
    }
    return names;
}

/// @brief What a YAML file says of the part that is asked for: `train`; or `test`, else `val`.
inline void read_yolo_yaml(const std::filesystem::path& file, const DatasetReadOptions& options,
                           YoloPlaces& places, bool with_images) {
    const std::string place = file_text(file);
    auto lists = read_yaml_lists(read_text(file, 1 << 26));
    places.names = yolo_names(lists["names"], place);
    if (!with_images) return;
    std::filesystem::path root = file.parent_path();
    if (!lists["path"].empty()) {
        const auto given = root / path_from_utf8(lists["path"][0].value);
        if (std::filesystem::is_directory(given)) root = given;
    }
    const bool test = options.part == DatasetPart::test;
    std::string key = test ? "test" : "train";
    if (test && (lists[key].empty() || !std::filesystem::exists(yolo_path(root, lists[key][0].value))))
        key = "val";
    places.part = key;
    for (const YamlItem& item : lists[key]) places.images.push_back(yolo_path(root, item.value));
    if (places.images.empty())
        throw FileError(place + ": expected " + (test ? "'test' or 'val'" : "'train'") +
                        ", where images are, got neither");
}

/// @brief Where the images of a folder are: in it or in its folder images, there all or those of a part.
[[nodiscard]] inline std::filesystem::path yolo_images(const std::filesystem::path& folder,
                                                       DatasetPart part) {
    const auto images = std::filesystem::is_directory(folder / "images") ? folder / "images" : folder;
    if (!image_files(images).empty()) return images;
    for (const char* name : {"train", "test", "val", "valid"}) {
        const bool of_train = std::string_view(name) == "train";
        if (of_train == (part == DatasetPart::train) && std::filesystem::is_directory(images / name))
            return images / name;
    }
    return images;
}

[[nodiscard]] inline YoloPlaces yolo_places(const std::filesystem::path& path,
                                            const DatasetReadOptions& options) {
    YoloPlaces places;
    const bool folder = std::filesystem::is_directory(path);
    places.root = folder ? path : path.parent_path();
    std::filesystem::path described = folder ? yolo_file(path) : path;
    const bool is_yaml = described.extension() != ".txt";
    if (!folder || (is_yaml && !described.empty())) {
        read_yolo_yaml(described, options, places, true);
    } else {
        const auto images = yolo_images(path, options.part);
        places.images = {images};
        if (images != path && images.filename() != "images") places.part = path_to_utf8(images.filename());
        // The names of the classes may stand in a folder above, as in train/ and valid/ beside data.yaml.
        auto above = std::filesystem::absolute(path / "").parent_path();
        for (int up = 0; up <= 2 && described.empty(); ++up, above = above.parent_path())
            described = yolo_file(above);
        if (described.empty())
            throw FileError("folder '" + one_line(path.string()) +
                            "': expected the names of its classes in data.yaml or classes.txt, got neither");
        if (described.extension() == ".txt")
            places.names = lines_of(described);
        else
            read_yolo_yaml(described, options, places, false);
    }
    if (places.names.empty()) throw FileError(file_text(described) + ": expected names of classes, got none");
    return places;
}

}  // namespace ism::detail
