// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

/// @file
/// @brief Finding and numbering the images of a data set that is no COCO's. By stb_image: see
/// ism/io/images.hpp for what a program needs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "ism/dataset/dataset.hpp"
#include "ism/dataset/depth_files.hpp"
#include "ism/dataset/faults.hpp"
#include "ism/io/images.hpp"
#include "ism/io/paths.hpp"

namespace ism {

/// @brief The part of a data set that is asked for, where it has several.
enum class DatasetPart { train, test };

/// @brief How data sets are read that are not COCO's.
struct DatasetReadOptions {
    Faults* faults =
        nullptr;  ///< where given, images and labels that make no sense are left out, and told there
    DatasetPart part = DatasetPart::train;
    ImageFileSize (*image_size)(const std::filesystem::path&) = read_image_size;
};

namespace detail {

[[nodiscard]] inline std::string lower(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return text;
}

/// @brief The endings of images, also of kinds that are not read: they shall be told.
inline constexpr std::string_view image_endings[] = {".jpg", ".jpeg", ".png",  ".bmp", ".pnm",
                                                     ".ppm", ".pgm",  ".webp", ".tif", ".tiff",
                                                     ".gif", ".heic", ".heif", ".avif"};

/// @brief Whether a file is named as an image, and not as one that the program drew beside it (NAME.ism.png).
[[nodiscard]] inline bool is_image_name(const std::filesystem::path& path) {
    if (path.stem().extension() == ".ism") return false;
    const std::string ending = lower(path.extension().string());
    return std::find(std::begin(image_endings), std::end(image_endings), ending) != std::end(image_endings);
}

/// @brief What is in a folder, by name; nothing hidden, nor what macOS adds to archives.
/// @throws FileError where it cannot be read.
[[nodiscard]] inline std::set<std::filesystem::path> folder_entries(const std::filesystem::path& folder) {
    std::set<std::filesystem::path> entries;
    std::error_code failure;
    std::filesystem::directory_iterator at(folder, failure);
    for (; !failure && at != std::filesystem::directory_iterator(); at.increment(failure))
        if (const std::string name = at->path().filename().string();
            !name.starts_with(".") && name != "__MACOSX")
            entries.insert(at->path());
    if (failure)
        throw FileError(join_text(
            "folder '", one_line(folder.string()), "': expected a folder to read, got ",
            failure == std::errc::no_such_file_or_directory ? "none of this name" : failure.message()));
    return entries;
}

[[nodiscard]] inline std::vector<std::filesystem::path> image_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : folder_entries(folder))
        if (is_image_name(entry) && !std::filesystem::is_directory(entry)) files.push_back(entry);
    return files;
}

/// @brief The image of this name without its ending, in this folder; empty where there is none. Depth counts
/// where nothing else has the name.
/// @param except  an ending that it may not have
[[nodiscard]] inline std::filesystem::path image_of_stem(const std::filesystem::path& folder,
                                                         const std::string& stem,
                                                         std::string_view except = {}) {
    std::error_code ignored;
    std::filesystem::path depth;
    for (const std::string_view ending : image_endings) {
        if (ending == except) continue;
        std::string upper(ending);
        for (char& c : upper)
            if (c >= 'a' && c <= 'z') c = char(c - 'a' + 'A');
        for (const std::string& name : {stem + std::string(ending), stem + upper}) {
            if (!std::filesystem::is_regular_file(folder / name, ignored)) continue;
            if (!is_depth_image(folder / name)) return folder / name;
            if (depth.empty()) depth = folder / name;
        }
    }
    return depth;
}

/// @brief A data set of a folder, whose name ends with "/": file names are told as seen from it.
[[nodiscard]] inline Dataset folder_dataset(const std::filesystem::path& folder) {
    return {.source = folder.filename().empty() ? folder : folder / ""};
}

/// @brief Image number `id`, as large as it is shown, or as labels tell where they are of the stored pixels.
/// @throws FileError where it cannot be read, or is of neither size.
[[nodiscard]] inline DatasetImage labelled_image(std::int64_t id, const std::filesystem::path& file,
                                                 const DatasetReadOptions& options,
                                                 const ImageSize* labelled = nullptr) {
    const ImageFileSize size = options.image_size(file);
    if (labelled != nullptr && !(*labelled == size.shown) && !(*labelled == size.stored))
        throw FileError(join_text(file_text(file), ": expected ", sides_text(*labelled),
                                  " pixels as its labels say, got ", sides_text(size.shown)));
    const ImageSize& own = labelled != nullptr ? *labelled : size.shown;
    return {.id = id, .file = file, .width = own.width, .height = own.height};
}

/// @brief Numbers classes and objects from 1.
inline void number(Dataset& dataset) {
    for (std::size_t c = 0; c < dataset.class_names.size(); ++c)
        dataset.category_ids.push_back(std::int64_t(c) + 1);
    std::int64_t id = 0;
    for (DatasetImage& image : dataset.images)
        for (DatasetAnnotation& object : image.objects) object.id = ++id;
}

/// @brief Classes in the order of their names, in place of that in which they came; then number().
inline void name_classes(Dataset& dataset, const std::map<std::string, std::uint32_t>& classes) {
    dataset.classes_listed = false;
    std::vector<std::uint32_t> place_of(classes.size());
    for (const auto& [name, came] : classes) {
        place_of[came] = std::uint32_t(dataset.class_names.size());
        dataset.class_names.push_back(name);
    }
    for (DatasetImage& image : dataset.images)
        for (DatasetAnnotation& object : image.objects) object.class_index = place_of[object.class_index];
    number(dataset);
}

}  // namespace detail

}  // namespace ism
