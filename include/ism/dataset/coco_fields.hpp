// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ism/core/geometry.hpp"
#include "ism/dataset/dataset.hpp"
#include "ism/io/json.hpp"
#include "ism/io/paths.hpp"

/// The fields that COCO's data sets and results have in common.
namespace ism::detail {

/// @brief [x, y, width, height].
/// @param may_be_empty  whether width and height may be 0
[[nodiscard]] inline Box box_from_json(const Json& value, const std::string& place,
                                       bool may_be_empty = false) {
    const std::string_view expected = "four numbers x, y, width, height";
    if (!value.is_array() || value.size() != 4) refuse_json(place, "bbox", expected, json_text(value));
    double numbers[4];
    for (std::size_t i = 0; i < 4; ++i) {
        numbers[i] = to_number(value[i], "bbox", place);
        if (std::abs(numbers[i]) > 1e9) refuse_json(place, "bbox", "pixels up to 1e9", json_text(value[i]));
    }
    const double shorter = std::min(numbers[2], numbers[3]);
    if (shorter < 0 || (shorter == 0 && !may_be_empty))
        refuse_json(place, "bbox",
                    may_be_empty ? "a width and height of 0 or more" : "a width and height above 0",
                    join_text(numbers[2], "x", numbers[3]));
    return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

[[nodiscard]] inline Json box_to_json(const Box& box) {
    return {number_json(box.x), number_json(box.y), number_json(box.width), number_json(box.height)};
}

/// @brief [x, y, z], metres in the camera frame.
[[nodiscard]] inline Point3 position_from_json(const Json& value, const std::string& place) {
    if (!value.is_array() || value.size() != 3)
        refuse_json(place, "position_m", "three numbers x, y, z", json_text(value));
    const auto coordinate = [&](std::size_t i) { return to_number(value[i], "position_m", place); };
    return {coordinate(0), coordinate(1), coordinate(2)};
}

[[nodiscard]] inline Json position_to_json(const Point3& position) {
    return {position.x, position.y, position.z};
}

/// @brief {"size": [height, width], "counts": text or array}.
[[nodiscard]] inline CompressedRle rle_from_json(const Json& value, const std::string& place) {
    const std::string_view what = "segmentation";
    const Json& size = array_member(value, "size", place);
    if (size.size() != 2) refuse_json(place, "segmentation size", "height, width", json_text(size));
    const std::int64_t height = to_integer(size[0], "segmentation size", place);
    const std::int64_t width = to_integer(size[1], "segmentation size", place);
    if (!is_image_size(width, height))
        refuse_json(place, "segmentation size", image_size_limits, join_text(width, "x", height));
    const Json& counts = member(value, "counts", place, "run lengths");
    if (counts.is_string()) {
        CompressedRle packed{int(width), int(height), counts.get<std::string>()};
        at_place(place, [&] { return decompress(packed); });
        return packed;
    }
    if (!counts.is_array()) refuse_json(place, what, "counts as text or array", json_text(counts));
    Rle rle{int(width), int(height), {}};
    for (const Json& count : counts) {
        const std::int64_t run = to_integer(count, "segmentation counts", place);
        if (run < 0 || run > max_image_pixels)
            refuse_json(place, "segmentation counts", "run lengths of 0 or more", json_text(count));
        rle.counts.push_back(std::uint32_t(run));
    }
    return at_place(place, [&] {
        check_run_lengths(rle);
        return compress(rle);
    });
}

[[nodiscard]] inline Json rle_to_json(const CompressedRle& packed) {
    return {{"size", {packed.height, packed.width}}, {"counts", packed.counts}};
}

/// @brief [[x1, y1, x2, y2, ...], ...].
[[nodiscard]] inline std::vector<Polygon> polygons_from_json(const Json& value, const std::string& place) {
    std::vector<Polygon> polygons;
    for (const Json& flat : value) {
        if (!flat.is_array() || flat.size() < 6 || flat.size() % 2 != 0)
            refuse_json(place, "segmentation", "polygons of 6, 8, ... numbers", json_text(flat));
        Polygon polygon;
        for (std::size_t i = 0; i < flat.size(); i += 2)
            polygon.push_back(
                {to_number(flat[i], "segmentation", place), to_number(flat[i + 1], "segmentation", place)});
        for (const Point2& corner : polygon)
            if (std::abs(corner.x) > 1e9 || std::abs(corner.y) > 1e9)
                refuse_json(place, "segmentation", "pixels up to 1e9", join_text(corner.x, ", ", corner.y));
        polygons.push_back(std::move(polygon));
    }
    return polygons;
}

[[nodiscard]] inline Json polygons_to_json(const std::vector<Polygon>& polygons) {
    Json value = Json::array();
    for (const Polygon& polygon : polygons) {
        Json flat = Json::array();
        for (const Point2& corner : polygon) {
            flat.push_back(number_json(corner.x));
            flat.push_back(number_json(corner.y));
        }
        value.push_back(std::move(flat));
    }
    return value;
}

/// @brief An array of records as text, one record a line.
[[nodiscard]] inline std::string json_lines(const Json& records, const std::string& place) {
    std::string text = "[";
    for (std::size_t i = 0; i < records.size(); ++i)
        text += (i == 0 ? "\n" : ",\n") + dump_json(records[i], place);
    return text + "\n]";
}

}  // namespace ism::detail
