// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ism/core/camera.hpp"
#include "ism/core/geometry.hpp"
#include "ism/dataset/coco_fields.hpp"
#include "ism/dataset/rle.hpp"
#include "ism/io/json.hpp"
#include "ism/io/write_file.hpp"

namespace ism {

/// @brief One object found in an image of a data set, as written to and read from files.
struct Result {
    std::int64_t image_id = 0;                                      ///< DatasetImage::id
    std::int64_t category_id = 0;                                   ///< of Dataset::category_ids
    Box box;                                                        ///< pixels
    double score = 0;                                               ///< larger is more confident
    double probability = std::numeric_limits<double>::quiet_NaN();  ///< 0 … 1, comparable between images and
                                                                    ///< classes; NaN = not known
    std::optional<CompressedRle> segmentation = {};
    std::optional<Point3> position_m = {};  ///< in the camera frame
    double depth_m = no_depth;              ///< along the optical axis, metres; NaN = not known
    double scale = 1;                       ///< size relative to the reference size of its class
    double position_error_m =
        std::numeric_limits<double>::quiet_NaN();  ///< scatter of votes; NaN = not known
    double angle_rad = 0;         ///< turned by so much from x towards y; 0 = upright, or not known
    std::string class_name = {};  ///< what category_id stands for; empty = not told
};

namespace detail {

[[nodiscard]] inline Result result_from_json(const Json& record, const std::string& place) {
    Result result{.image_id = integer_member(record, "image_id", place),
                  .category_id = integer_member(record, "category_id", place),
                  .box = {},
                  .score = number_member(record, "score", place)};
    const Json* segmentation = optional_member(record, "segmentation", place);
    if (segmentation != nullptr && segmentation->is_array() && !segmentation->empty())
        refuse_json(place, "segmentation", "run lengths {size, counts}, as results have them", "polygons");
    if (segmentation != nullptr && !segmentation->is_array())
        result.segmentation = rle_from_json(*segmentation, place);
    if (const Json* box = optional_member(record, "bbox", place)) {
        result.box = box_from_json(*box, place, true);
    } else {
        if (!result.segmentation)
            refuse_json(place, "bbox", "a box, or a segmentation to take it from", "neither");
        result.box = mask_box(decompress_mask(*result.segmentation));
        if (!(result.box.area() > 0)) refuse_json(place, "segmentation", "at least one figure pixel", "none");
    }
    if (const Json* position = optional_member(record, "position_m", place))
        result.position_m = position_from_json(*position, place);
    if (const Json* depth = optional_member(record, "depth_m", place)) {
        result.depth_m = to_number(*depth, "depth_m", place);
        if (!is_depth(result.depth_m)) refuse_json(place, "depth_m", "metres above 0", json_text(*depth));
    }
    if (const Json* probability = optional_member(record, "probability", place)) {
        result.probability = to_number(*probability, "probability", place);
        if (!(result.probability >= 0 && result.probability <= 1))
            refuse_json(place, "probability", "a number from 0 to 1", json_text(*probability));
    }
    if (const Json* scale = optional_member(record, "scale", place)) {
        result.scale = to_number(*scale, "scale", place);
        if (!(result.scale > 0)) refuse_json(place, "scale", "a number above 0", json_text(*scale));
    }
    if (const Json* error = optional_member(record, "position_error_m", place)) {
        result.position_error_m = to_number(*error, "position_error_m", place);
        if (!(result.position_error_m >= 0))
            refuse_json(place, "position_error_m", "metres, 0 or more", json_text(*error));
    }
    if (const Json* angle = optional_member(record, "angle_rad", place))
        result.angle_rad = to_number(*angle, "angle_rad", place);
    if (const Json* name = optional_member(record, "class", place))
        result.class_name = to_text(*name, "class", place);
    return result;
}

[[nodiscard]] inline Json result_to_json(const Result& result) {
    Json record = {{"image_id", result.image_id},
                   {"category_id", result.category_id},
                   {"bbox", box_to_json(result.box)},
                   {"score", result.score},
                   {"scale", result.scale}};
    if (!result.class_name.empty()) record["class"] = result.class_name;
    if (!std::isnan(result.depth_m)) record["depth_m"] = result.depth_m;
    if (!std::isnan(result.probability)) record["probability"] = result.probability;
    if (result.segmentation) record["segmentation"] = rle_to_json(*result.segmentation);
    if (result.position_m) record["position_m"] = position_to_json(*result.position_m);
    if (result.position_m && !std::isnan(result.position_error_m))
        record["position_error_m"] = result.position_error_m;
    if (result.angle_rad != 0) record["angle_rad"] = result.angle_rad;
    return record;
}

}  // namespace detail

/// @brief What write_results() writes.
/// @param place  what errors name
/// @throws FileError where read_results() would refuse it.
[[nodiscard]] inline std::string results_text(std::span<const Result> results, const std::string& place) {
    detail::Json records = detail::Json::array();
    for (std::size_t i = 0; i < results.size(); ++i) {
        records.push_back(detail::result_to_json(results[i]));
        static_cast<void>(detail::result_from_json(records.back(), join_text(place, ", result ", i)));
    }
    return detail::json_lines(records, place) + "\n";
}

/// @brief Writes results as COCO's array, one record a line: image_id, category_id, bbox, score, segmentation
/// {size, counts}; beside these scale and, where they are known, class (its name), probability, depth_m,
/// position_m [x, y, z], position_error_m and, of what is turned, angle_rad.
/// @throws FileError where the file cannot be written, or read_results() would refuse it; nothing is written
/// then.
inline void write_results(const std::filesystem::path& path, std::span<const Result> results) {
    write_file(path, results_text(results, file_text(path)));
}

/// @brief Reads a COCO array of results, of this or of another program: what only we write (scale, class,
/// depth_m, position_m …) may be missing, and so may either bbox or segmentation; an empty list as
/// segmentation is none, and a box may be without area.
/// @throws FileError, naming the file and the result's place in it, where the file cannot be read, is no such
/// array, or a value makes no sense.
[[nodiscard]] inline std::vector<Result> read_results(const std::filesystem::path& path) {
    const detail::Json root = detail::read_json(path);
    const std::string file = file_text(path);
    if (!root.is_array())
        throw FileError(file + ": expected an array of results, got " + detail::json_text(root));
    std::vector<Result> results;
    for (std::size_t i = 0; i < root.size(); ++i)
        results.push_back(detail::result_from_json(root[i], join_text(file, ", result ", i)));
    return results;
}

}  // namespace ism
