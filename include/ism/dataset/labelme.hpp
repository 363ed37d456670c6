// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

/// @file
/// @brief Labels as labelme and its relatives write them: a JSON file an image. By stb_image: see
/// ism/io/images.hpp for what a program needs.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ism/core/box_check.hpp"
#include "ism/dataset/image_files.hpp"
#include "ism/io/json.hpp"

namespace ism {

namespace detail {

/// @brief The outline of a shape, or the corners of its box.
struct LabelmeShape {
    Polygon outline;
    bool is_box = false;
};

[[nodiscard]] inline LabelmeShape shape_from_json(const Json& record, const std::string& place) {
    std::string kind = "polygon";
    if (const Json* type = optional_member(record, "shape_type", place))
        kind = to_text(*type, "shape_type", place);
    const std::size_t least = kind == "polygon" ? 3 : 2;
    if (kind != "polygon" && kind != "rectangle" && kind != "circle")
        refuse_json(place, "shape_type", "polygon, rectangle or circle", "'" + kind + "'");
    const Json& points = array_member(record, "points", place);
    if (points.size() < least) refuse_json(place, "points", join_text(least, " or more"), json_text(points));
    LabelmeShape shape{.outline = {}, .is_box = kind == "rectangle"};
    for (const Json& point : points) {
        if (!point.is_array() || point.size() != 2)
            refuse_json(place, "points", "pairs x, y", json_text(point));
        shape.outline.push_back({to_number(point[0], "points", place), to_number(point[1], "points", place)});
    }
    if (kind == "circle") {  // its middle, and a point of its rim
        const Point2 middle = shape.outline[0], rim = shape.outline[1];
        const double radius = std::hypot(rim.x - middle.x, rim.y - middle.y);
        constexpr int corners = 64;
        shape.outline.clear();
        for (int i = 0; i < corners; ++i) {
            const double angle = 2 * 3.14159265358979323846 * i / corners;
            shape.outline.push_back(
                {middle.x + radius * std::cos(angle), middle.y + radius * std::sin(angle)});
        }
    }
    return shape;
}

/// @brief The box around both.
[[nodiscard]] inline Box joined(const Box& a, const Box& b) {
    return box_around(
        {{a.x, a.y}, {a.x + a.width, a.y + a.height}, {b.x, b.y}, {b.x + b.width, b.y + b.height}});
}

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
    std::map<std::pair<std::uint32_t, std::string>, std::size_t> group_of;
    std::size_t number = 0;
    for (const Json& record : array_member(root, "shapes", file)) {
        const std::string place = join_text(file, ", shape ", number++);
        read_or_tell(options.faults, [&] {
            const std::string& label = text_member(record, "label", place);
            const LabelmeShape shape = shape_from_json(record, place);
            DatasetAnnotation object{.class_index = 0, .box = box_around(shape.outline)};
            at_place(place, [&] { check_labelled_box(object.box, image.width, image.height); });
            if (const Json* difficult = optional_member(record, "difficult", place))
                object.crowd = difficult->is_boolean() && difficult->get<bool>();
            if (!shape.is_box) object.segmentation = std::vector<Polygon>{shape.outline};
            object.class_index = classes.emplace(label, std::uint32_t(classes.size())).first->second;
            const Json* group = optional_member(record, "group_id", place);
            if (group == nullptr || shape.is_box) return image.objects.push_back(std::move(object));
            // Shapes of one group are parts of one object.
            const auto [at, first] =
                group_of.emplace(std::pair(object.class_index, group->dump()), image.objects.size());
            if (first) return image.objects.push_back(std::move(object));
            DatasetAnnotation& whole = image.objects[at->second];
            std::get<std::vector<Polygon>>(whole.segmentation).push_back(shape.outline);
            whole.box = joined(whole.box, object.box);
        });
    }
    dataset.images.push_back(std::move(image));
}

}  // namespace detail

/// @brief Reads labels of labelme: a JSON file an image, one alone or all of a folder. Polygons and circles
/// are masks, rectangles boxes; shapes of one label and group_id are one object. Images are numbered from 1
/// in the order of the JSON files, classes in that of their names. Images without a JSON file are left out,
/// one without shapes is background.
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
