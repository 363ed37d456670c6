// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "ism/core/box_check.hpp"
#include "ism/dataset/coco_fields.hpp"
#include "ism/dataset/dataset.hpp"
#include "ism/dataset/faults.hpp"
#include "ism/io/json.hpp"
#include "ism/io/paths.hpp"

namespace ism {

namespace detail {

[[nodiscard]] inline Camera camera_from_json(const Json& value, const std::string& place) {
    const std::string at = place + ", camera";
    const Camera camera{number_member(value, "fx", at), number_member(value, "fy", at),
                        number_member(value, "cx", at), number_member(value, "cy", at)};
    at_place(place, [&] { check(camera); });
    return camera;
}

[[nodiscard]] inline DatasetImage image_from_json(const Json& record, const std::filesystem::path& folder,
                                                  const std::string& list) {
    DatasetImage image;
    image.id = integer_member(record, "id", list);
    const std::string place = join_text(list, " with id ", image.id);
    const auto file_of = [&](const std::string& name) {
        return folder / at_place(place, [&] { return path_from_utf8(name); });
    };
    image.file = file_of(text_member(record, "file_name", place));
    const std::int64_t width = integer_member(record, "width", place);
    const std::int64_t height = integer_member(record, "height", place);
    if (!is_image_size(width, height))
        refuse_json(place, "width, height", image_size_limits, join_text(width, "x", height));
    image.width = int(width), image.height = int(height);
    if (const Json* depth_file = optional_member(record, "depth_file_name", place)) {
        image.depth_file = file_of(to_text(*depth_file, "depth_file_name", place));
        image.depth_scale = number_member(record, "depth_scale", place);
        if (!(image.depth_scale > 0))
            refuse_json(place, "depth_scale", "metres per unit above 0", join_text(image.depth_scale));
    }
    if (const Json* camera = optional_member(record, "camera", place))
        image.camera = camera_from_json(*camera, place);
    return image;
}

/// @brief The mask, and the box that is either given or taken from the mask.
inline void read_outline(const Json& record, const DatasetImage& image, const std::string& place,
                         DatasetAnnotation& annotation) {
    const Json* segmentation = optional_member(record, "segmentation", place);
    if (segmentation != nullptr && segmentation->is_object()) {
        CompressedRle packed = rle_from_json(*segmentation, place);
        if (sides_text(packed) != sides_text(image))
            refuse_json(place, "segmentation size", sides_text(image), sides_text(packed));
        annotation.segmentation = std::move(packed);
    } else if (segmentation != nullptr && segmentation->is_array()) {
        if (!segmentation->empty()) annotation.segmentation = polygons_from_json(*segmentation, place);
    } else if (segmentation != nullptr) {
        refuse_json(place, "segmentation", "run lengths or polygons", json_text(*segmentation));
    }
    if (const Json* box = optional_member(record, "bbox", place))
        annotation.box = box_from_json(*box, place);
    else if (segmentation != nullptr && !segmentation->empty())
        annotation.box = at_place(place, [&] { return mask_box(read_mask(image, annotation)); });
    else
        refuse_json(place, "bbox", "a box, or a segmentation to take it from", "neither");
    at_place(place, [&] { check_labelled_box(annotation.box, image.width, image.height); });
}

/// @brief Whether a category is none of its own but the name of the others' group, as Roboflow writes it:
/// number 0, which others name as their supercategory and no annotation has.
[[nodiscard]] inline bool is_empty_group(const Json& category, const Json& categories, const Json& labels) {
    const auto has = [](const Json& record, const char* key, const Json& value) {
        return record.is_object() && record.contains(key) && record[key] == value;
    };
    if (!has(category, "id", 0) || !category.contains("name")) return false;
    const auto is_below = [&](const Json& other) {
        return !has(other, "id", 0) && has(other, "supercategory", category["name"]);
    };
    const auto has_it = [&](const Json& label) { return has(label, "category_id", 0); };
    return std::any_of(categories.begin(), categories.end(), is_below) &&
           std::none_of(labels.begin(), labels.end(), has_it);
}

/// @brief The folder from which file names count: the JSON's own; where the first image is not there, but in
/// images beside it or beside its folder, or in the folder above, it is that.
[[nodiscard]] inline std::filesystem::path image_folder(const Json& images,
                                                        const std::filesystem::path& own) {
    if (images.empty() || !images[0].is_object() || !images[0].contains("file_name") ||
        !images[0]["file_name"].is_string())
        return own;
    const std::string& name = images[0]["file_name"].get_ref<const std::string&>();
    std::error_code ignored;
    if (name.empty() || name.find('\0') != std::string::npos) return own;
    for (const char* folder : {"", "images", "../images", ".."})
        if (std::filesystem::is_regular_file(own / folder / path_from_utf8(name), ignored))
            return folder[0] == '\0' ? own : (own / folder).lexically_normal();
    return own;
}

/// @brief The images and classes that annotations refer to by number.
struct CocoNumbers {
    std::map<std::int64_t, std::size_t> image_of = {};
    std::map<std::int64_t, std::uint32_t> class_of = {};
    std::set<std::int64_t> annotations = {};
};

/// @brief The image that an annotation of a new id is of.
[[nodiscard]] inline DatasetImage& annotated_image(const Json& record, const std::string& file,
                                                   CocoNumbers& numbers, Dataset& dataset) {
    const std::int64_t id = integer_member(record, "id", file + ", annotation");
    const std::string own = join_text(file, ", annotation with id ", id);
    if (!numbers.annotations.insert(id).second) refuse_json(own, "id", "each id once", "it twice");
    const std::int64_t image_id = integer_member(record, "image_id", own);
    const auto image_at = numbers.image_of.find(image_id);
    if (image_at == numbers.image_of.end())
        refuse_json(own, "image_id", "the id of one of its images", join_text(image_id));
    return dataset.images[image_at->second];
}

inline void read_annotation(const Json& record, const std::string& file, const CocoNumbers& numbers,
                            DatasetImage& image) {
    DatasetAnnotation annotation;
    annotation.id = integer_member(record, "id", file);
    const std::string place = join_text(file, ", annotation with id ", annotation.id, " of image ", image.id,
                                        " ('", one_line(image.file.string()), "')");
    const std::int64_t category_id = integer_member(record, "category_id", place);
    const auto class_at = numbers.class_of.find(category_id);
    if (class_at == numbers.class_of.end())
        refuse_json(place, "category_id", "the id of one of its categories", join_text(category_id));
    annotation.class_index = class_at->second;
    if (const Json* crowd = optional_member(record, "iscrowd", place))
        annotation.crowd =
            crowd->is_boolean() ? crowd->get<bool>() : to_integer(*crowd, "iscrowd", place) != 0;
    if (const Json* instance = optional_member(record, "instance", place))
        annotation.instance = instance->is_number() ? join_text(to_integer(*instance, "instance", place))
                                                    : to_text(*instance, "instance", place);
    read_outline(record, image, place, annotation);
    if (const Json* position = optional_member(record, "position_m", place)) {
        annotation.position_m = position_from_json(*position, place);
        if (!(annotation.position_m->z > 0))
            refuse_json(place, "position_m", "a place before the camera, z above 0",
                        join_text("z = ", annotation.position_m->z));
    }
    image.objects.push_back(std::move(annotation));
}

[[nodiscard]] inline Dataset dataset_from_json(const Json& root, const std::filesystem::path& path,
                                               Faults* faults = nullptr) {
    const std::string file = file_text(path);
    Dataset dataset{.source = path};
    CocoNumbers numbers;
    std::set<std::string> names;
    const Json none = Json::array();
    const bool labelled = optional_member(root, "annotations", file) != nullptr;
    const Json& labels = labelled ? array_member(root, "annotations", file) : none;
    const bool named = labelled || optional_member(root, "categories", file) != nullptr;
    const Json& categories = named ? array_member(root, "categories", file) : none;
    for (const Json& record : categories) {
        if (is_empty_group(record, categories, labels)) continue;
        const std::int64_t id = integer_member(record, "id", file + ", category");
        const std::string place = join_text(file, ", category with id ", id);
        const std::string& name = text_member(record, "name", place);
        if (!numbers.class_of.emplace(id, std::uint32_t(dataset.class_names.size())).second)
            refuse_json(place, "id", "each id once", "it twice");
        if (!names.insert(name).second) refuse_json(place, "name", "each name once", "'" + name + "' twice");
        dataset.class_names.push_back(name);
        dataset.category_ids.push_back(id);
    }
    const Json& images = array_member(root, "images", file);
    const std::filesystem::path folder = image_folder(images, path.parent_path());
    for (const Json& record : images) {
        dataset.images.push_back(image_from_json(record, folder, file + ", image"));
        const std::int64_t id = dataset.images.back().id;
        if (!numbers.image_of.emplace(id, numbers.image_of.size()).second)
            refuse_json(join_text(file, ", image with id ", id), "id", "each id once", "it twice");
    }
    for (const Json& record : labels)
        read_or_tell(faults, [&] {
            DatasetImage& image = annotated_image(record, file, numbers, dataset);
            if (!read_or_tell(faults, [&] { read_annotation(record, file, numbers, image); }))
                image.incomplete = true;
        });
    return dataset;
}

}  // namespace detail

/// @brief Reads a data set in COCO's JSON: images, categories, annotations with bbox, segmentation (run
/// lengths as text or array, or polygons), iscrowd, and instance (a text or number that names the thing). Per
/// image also depth_file_name, depth_scale (metres per unit) and camera {fx, fy, cx, cy}, per annotation
/// position_m [x, y, z]. File names count from the JSON's folder, or where the first is not there from
/// images/, ../images/ or ../. A missing bbox is taken from the segmentation. Without annotations and
/// categories images have no labels. An empty category 0 that others name as their supercategory is no class.
/// Images are not opened yet.
/// @param faults  where given, annotations that make no sense are left out, and told there
/// @throws FileError, naming the file, the image and the annotation, where the file cannot be read, is no
/// JSON (with line and column), lacks a key, repeats an id, names an unknown image or category, or a box
/// (see check_labelled_box()), mask size, depth scale, camera or position makes no sense.
[[nodiscard]] inline Dataset read_dataset(const std::filesystem::path& path, Faults* faults = nullptr) {
    return detail::dataset_from_json(detail::read_json(path), path, faults);
}

}  // namespace ism
