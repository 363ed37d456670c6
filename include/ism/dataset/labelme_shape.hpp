// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

/// @file
/// @brief The shapes of labelme's files. By stb_image: see ism/io/images.hpp for what a program needs.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "ism/core/box_check.hpp"
#include "ism/dataset/mask_files.hpp"
#include "ism/io/base64.hpp"
#include "ism/io/json.hpp"

namespace ism::detail {

/// @brief A circle by its middle and a point of its rim.
[[nodiscard]] inline Polygon circle_outline(const Point2& middle, const Point2& rim) {
    constexpr int corners = 64;
    const double radius = std::hypot(rim.x - middle.x, rim.y - middle.y);
    Polygon outline;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * i / corners;
        outline.push_back({middle.x + radius * std::cos(angle), middle.y + radius * std::sin(angle)});
    }
    return outline;
}

/// @brief A painted mask in an image of `width` × `height`: an image file in base64, whose first and last
/// pixel lie at the two points.
[[nodiscard]] inline Mask painted_mask(const Json& record, const Point2& first, const Point2& last, int width,
                                       int height, const std::string& place) {
    const std::string& text = text_member(record, "mask", place);
    const std::string mask_place = place + ", mask";
    const ImageFile file = open_image(mask_place, at_place(mask_place, [&] { return decode_base64(text); }));
    const double x = std::trunc(first.x), y = std::trunc(first.y);
    const ImageSize size{file.width, file.height};
    if (std::trunc(last.x) - x + 1 != size.width || std::trunc(last.y) - y + 1 != size.height)
        refuse_json(place, "points", join_text("the first and last pixel of a mask of ", sides_text(size)),
                    join_text(first.x, ", ", first.y, " and ", last.x, ", ", last.y));
    if (x < 0 || y < 0 || x + size.width > width || y + size.height > height)
        refuse_json(place, "points", join_text("a mask within ", width, "x", height, " pixels"),
                    join_text(first.x, ", ", first.y, " and ", last.x, ", ", last.y));
    const Mask painted = decode_mask(file);
    Mask mask(width, height);
    for (int row = 0; row < size.height; ++row)
        for (int column = 0; column < size.width; ++column)
            mask(int(x) + column, int(y) + row) = painted(column, row);
    return mask;
}

/// @brief A shape as an object of an image; its class is left to the caller.
/// @throws FileError where it makes no sense, or is none that has an area.
[[nodiscard]] inline DatasetAnnotation labelme_object(const Json& record, const DatasetImage& image,
                                                      const std::string& place) {
    std::string kind = "polygon";
    if (const Json* type = optional_member(record, "shape_type", place))
        kind = to_text(*type, "shape_type", place);
    const bool lacks_area = std::set<std::string>{"line", "linestrip", "point", "points"}.contains(kind);
    if (!std::set<std::string>{"polygon", "rectangle", "circle", "mask"}.contains(kind))
        refuse_json(place, "shape_type", "polygon, rectangle, circle or mask",
                    "'" + kind + "'" + (lacks_area ? ", which has no area" : ""));
    const std::size_t least = kind == "polygon" ? 3 : 2;
    const Json& array = array_member(record, "points", place);
    if (array.size() < least) refuse_json(place, "points", join_text(least, " or more"), json_text(array));
    Polygon points;
    for (const Json& point : array) {
        if (!point.is_array() || point.size() != 2)
            refuse_json(place, "points", "pairs x, y", json_text(point));
        points.push_back({to_number(point[0], "points", place), to_number(point[1], "points", place)});
    }
    DatasetAnnotation object;
    if (kind == "circle") points = circle_outline(points[0], points[1]);
    if (kind == "mask") {
        const Mask mask = painted_mask(record, points[0], points[1], image.width, image.height, place);
        object.box = mask_box(mask);
        object.segmentation = compress_mask(mask);
    } else {
        object.box = box_around(points);
        if (kind != "rectangle") object.segmentation = std::vector<Polygon>{std::move(points)};
    }
    at_place(place, [&] { check_labelled_box(object.box, image.width, image.height); });
    if (const Json* difficult = optional_member(record, "difficult", place))
        object.crowd = difficult->is_boolean() && difficult->get<bool>();
    return object;
}

/// @brief Makes an object with a mask larger by a part of it.
inline void join(DatasetAnnotation& whole, DatasetAnnotation part, const DatasetImage& image) {
    const Box &a = whole.box, &b = part.box;
    const Box box = box_around(
        {{a.x, a.y}, {a.x + a.width, a.y + a.height}, {b.x, b.y}, {b.x + b.width, b.y + b.height}});
    auto* const outlines = std::get_if<std::vector<Polygon>>(&whole.segmentation);
    auto* const more = std::get_if<std::vector<Polygon>>(&part.segmentation);
    if (outlines != nullptr && more != nullptr) {
        outlines->insert(outlines->end(), more->begin(), more->end());
    } else {
        Mask mask = read_mask(image, whole);
        const Mask other = read_mask(image, part);
        for (std::size_t i = 0; i < mask.pixels().size(); ++i) mask.pixels()[i] |= other.pixels()[i];
        whole.segmentation = compress_mask(mask);
    }
    whole.box = box;
}

}  // namespace ism::detail
