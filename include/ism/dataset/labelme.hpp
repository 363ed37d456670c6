// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

/// @file
/// @brief Labels as labelme and its relatives write them: a JSON file an image. By stb_image: see
/// ism/io/images.hpp for what a program needs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "ism/dataset/image_files.hpp"
#include "ism/dataset/labelme_shape.hpp"
#include "ism/io/json.hpp"

namespace ism {

namespace detail {

/// @brief The image that a labelme file tells of: by its path, else the one of the same name beside it.
[[nodiscard]] inline std::filesystem::path labelme_image(const Json& root,
                                                         const std::filesystem::path& path) {
    const std::string place = file_text(path);
    if (const Json* given = optional_member(root, "imagePath", place)) {
        std::string name = to_text(*given, "imagePath", place);
        std::replace(name.begin(), name.end(), '\\', '/');
        const auto file = at_place(place, [&] { return path.parent_path() / path_from_utf8(name); });
        if (std::filesystem::exists(file)) return file;
        if (std::filesystem::exists(path.parent_path() / file.filename()))
            return path.parent_path() / file.filename();
    }
    const auto beside = image_of_stem(path.parent_path(), path.stem().string());
    if (beside.empty())
        throw FileError(place + ": expected its image (imagePath, or of the same name), got none");
    return beside;
}

/// @brief Adds the image of a labelme file. Its classes are numbered as they come in `classes`.
inline void add_labelme_image(const Json& root, const std::filesystem::path& path, std::int64_t id,
                              const DatasetReadOptions& options,
                              std::map<std::string, std::uint32_t>& classes, Dataset& dataset) {
    const std::string file = file_text(path);
    ImageSize labelled;
    const bool sized =
        optional_member(root, "imageWidth", file) && optional_member(root, "imageHeight", file);
    if (sized)
        labelled = {
            int(std::clamp<std::int64_t>(integer_member(root, "imageWidth", file), 0, max_image_side)),
            int(std::clamp<std::int64_t>(integer_member(root, "imageHeight", file), 0, max_image_side))};
    DatasetImage image = labelled_image(id, labelme_image(root, path), options, sized ? &labelled : nullptr);
    image.label_file = path;
    std::map<std::pair<std::uint32_t, std::string>, std::size_t> group_of;
    std::size_t number = 0;
    for (const Json& record : array_member(root, "shapes", file)) {
        const std::string place = join_text(file, ", shape ", number++);
        const bool read = read_or_tell(options.faults, [&] {
            const std::string& label = text_member(record, "label", place);
            DatasetAnnotation object = labelme_object(record, image, place);
            object.class_index = classes.emplace(label, std::uint32_t(classes.size())).first->second;
            const Json* group = optional_member(record, "group_id", place);
            if (group == nullptr || !object.masked()) return image.objects.push_back(std::move(object));
            // Shapes of one group are parts of one object.
            const auto [at, first] =
                group_of.emplace(std::pair(object.class_index, group->dump()), image.objects.size());
            if (first) return image.objects.push_back(std::move(object));
            join(image.objects[at->second], std::move(object), image);
        });
        if (!read) image.incomplete = true;
    }
    dataset.images.push_back(std::move(image));
}

}  // namespace detail

/// @brief Reads labels of labelme: a JSON file an image, one alone or all of a folder. Polygons, circles
/// and painted masks are masks, rectangles boxes; shapes of one label and group_id are one object. Images are
/// numbered from 1 in the order of the JSON files, classes in that of their names. Images without a JSON file
/// are left out, one without shapes is background.
/// @throws FileError, naming the file and the shape, where one cannot be read or makes no sense and there is
/// no list of faults.
[[nodiscard]] inline Dataset read_labelme(const std::filesystem::path& path,
                                          const DatasetReadOptions& options = {}) {
    const bool folder = std::filesystem::is_directory(path);
    Dataset dataset = folder ? detail::folder_dataset(path) : Dataset{.source = path};
    std::map<std::string, std::uint32_t> classes;
    std::int64_t id = 0;
    for (const auto& file : folder ? detail::folder_entries(path) : std::set{path}) {
        if (folder && detail::lower(file.extension().string()) != ".json") continue;
        ++id;
        read_or_tell(options.faults, [&] {
            detail::add_labelme_image(detail::read_json(file), file, id, options, classes, dataset);
        });
    }
    detail::name_classes(dataset, classes);
    return dataset;
}

}  // namespace ism
