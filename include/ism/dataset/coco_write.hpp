// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "ism/dataset/coco.hpp"
#include "ism/dataset/coco_fields.hpp"
#include "ism/io/paths.hpp"
#include "ism/io/write_file.hpp"

namespace ism {

namespace detail {

[[nodiscard]] inline Json image_to_json(const DatasetImage& image, const std::filesystem::path& folder) {
    Json record = {{"id", image.id}, {"width", image.width}, {"height", image.height}};
    record["file_name"] = image.file.empty() ? "" : path_to_utf8(relative_to(image.file, folder));
    if (!image.depth_file.empty()) {
        record["depth_file_name"] = path_to_utf8(relative_to(image.depth_file, folder));
        record["depth_scale"] = image.depth_scale;
    }
    if (image.camera)
        record["camera"] = {{"fx", number_json(image.camera->fx)},
                            {"fy", number_json(image.camera->fy)},
                            {"cx", number_json(image.camera->cx)},
                            {"cy", number_json(image.camera->cy)}};
    return record;
}

[[nodiscard]] inline Json annotation_to_json(const DatasetImage& image, const DatasetAnnotation& annotation,
                                             std::int64_t category_id) {
    Json record = {{"id", annotation.id},
                   {"image_id", image.id},
                   {"category_id", category_id},
                   {"bbox", box_to_json(annotation.box)},
                   {"iscrowd", int(annotation.crowd)}};
    const Mask mask = read_mask(image, annotation);
    record["area"] = mask.empty() ? number_json(annotation.box.area()) : Json(mask_area(mask));
    if (const auto* packed = std::get_if<CompressedRle>(&annotation.segmentation))
        record["segmentation"] = rle_to_json(*packed);
    else if (const auto* polygons = std::get_if<std::vector<Polygon>>(&annotation.segmentation))
        record["segmentation"] = polygons_to_json(*polygons);
    if (!annotation.instance.empty()) record["instance"] = annotation.instance;
    if (annotation.position_m) record["position_m"] = position_to_json(*annotation.position_m);
    return record;
}

}  // namespace detail

/// @brief Writes a data set in COCO's JSON, one record a line, as read_dataset() reads it: run lengths as
/// text, polygons as they are, file names from the JSON's folder. The same data set gives the same bytes.
/// @throws FileError where the file cannot be written, or read_dataset() would refuse it; nothing is written
/// then.
inline void write_dataset(const std::filesystem::path& path, const Dataset& dataset) {
    using detail::Json;
    const std::string place = file_text(path);
    expect<FileError>(dataset.category_ids.size() == dataset.class_names.size(),
                      lazy_text(place, ": category ids"), dataset.class_names.size(),
                      dataset.category_ids.size());
    Json root = {{"images", Json::array()}, {"annotations", Json::array()}, {"categories", Json::array()}};
    for (std::size_t i = 0; i < dataset.class_names.size(); ++i)
        root["categories"].push_back({{"id", dataset.category_ids[i]}, {"name", dataset.class_names[i]}});
    for (const DatasetImage& image : dataset.images) {
        root["images"].push_back(detail::image_to_json(image, path.parent_path()));
        for (const DatasetAnnotation& annotation : image.objects) {
            expect<FileError>(annotation.class_index < dataset.class_names.size(),
                              lazy_text(place, ", annotation ", annotation.id, ": class index"),
                              lazy_text("below ", dataset.class_names.size()), annotation.class_index);
            root["annotations"].push_back(
                detail::annotation_to_json(image, annotation, dataset.category_ids[annotation.class_index]));
        }
    }
    static_cast<void>(detail::dataset_from_json(root, path));
    std::string text = "{\n\"images\": " + detail::json_lines(root["images"], place);
    text += ",\n\"annotations\": " + detail::json_lines(root["annotations"], place);
    text += ",\n\"categories\": " + detail::json_lines(root["categories"], place) + "\n}\n";
    write_file(path, text);
}

}  // namespace ism
