// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ism/io/json.hpp"
#include "ism/io/limits.hpp"
#include "ism/model/occurrence.hpp"
#include "ism/model_file/model_appearance.hpp"
#include "ism/model_file/tensor.hpp"

/// The shape part of a model as tensors.
namespace ism::detail {

/// Object masks as pairs (length 1 … 255, value), row after row, those of one object after another.
inline void pack_mask(const Mask& mask, std::vector<std::uint8_t>& runs) {
    const std::span<const std::uint8_t> cells = mask.pixels();
    for (std::size_t i = 0, end = 0; i < cells.size(); i = end) {
        while (end < cells.size() && cells[end] == cells[i] && end - i < 255) ++end;
        runs.push_back(static_cast<std::uint8_t>(end - i));
        runs.push_back(cells[i]);
    }
}

/// The next mask of the runs, which are then taken off the front.
[[nodiscard]] inline Mask unpack_mask(std::span<const std::uint8_t>& runs, std::uint32_t width,
                                      std::uint32_t height, const std::string& place) {
    expect<FileError>(is_image_size(width, height), lazy_text(place, ": mask size"), image_size_limits,
                      lazy_text(width, "x", height));
    const std::size_t cells = std::size_t(width) * height;
    expect<FileError>(cells <= runs.size() / 2 * 255, lazy_text(place, ": mask cells"),
                      lazy_text("at most ", runs.size() / 2 * 255), cells);
    Mask mask(static_cast<int>(width), static_cast<int>(height));
    std::size_t at = 0;
    while (at < cells) {
        expect<FileError>(runs.size() >= 2 && runs[0] > 0 && runs[0] <= cells - at,
                          lazy_text(place, ": mask run"), lazy_text("1 to ", cells - at, " cells"),
                          runs.size() < 2 ? 0 : int(runs[0]));
        std::fill_n(mask.pixels().begin() + std::ptrdiff_t(at), runs[0], runs[1]);
        at += runs[0];
        runs = runs.subspan(2);
    }
    return mask;
}

inline void shapes_to_tensors(const Shapes& shapes, TensorFile& file) {
    // A member that is added to Shapes does not compile here until it is kept too.
    [[maybe_unused]] const auto& [names, all_objects, all_occurrences, first, appearance] = shapes;
    const std::size_t count = shapes.occurrences.size(), objects = shapes.objects.size();
    std::vector<float> numbers, sizes;
    std::vector<std::uint32_t> indices, classes, sides;
    std::vector<std::uint8_t> runs;
    for (const Occurrence& o : shapes.occurrences) {
        numbers.insert(numbers.end(), {o.x, o.y, o.scale, o.depth_m, o.weight});
        indices.insert(indices.end(), {o.class_index, o.object, o.feature});
    }
    Json images = Json::array();
    for (const TrainingObject& o : shapes.objects) {
        sizes.insert(sizes.end(), {o.width, o.height, o.size_px});
        classes.push_back(o.class_index);
        sides.insert(sides.end(), {std::uint32_t(o.mask.width()), std::uint32_t(o.mask.height())});
        pack_mask(o.mask, runs);
        images.push_back(o.image);
    }
    file.metadata["class_names"] = dump_json(Json(shapes.class_names), file.source + ": class names");
    file.metadata["images"] = dump_json(images, file.source + ": image names");
    file.tensors["occurrences"] = make_tensor<float>(numbers, {count, 5});
    file.tensors["occurrence_indices"] = make_tensor<std::uint32_t>(indices, {count, 3});
    file.tensors["first_occurrence"] = make_tensor<std::uint32_t>(shapes.first, {shapes.first.size()});
    file.tensors["object_sizes"] = make_tensor<float>(sizes, {objects, 3});
    file.tensors["object_classes"] = make_tensor<std::uint32_t>(classes, {objects});
    file.tensors["mask_sizes"] = make_tensor<std::uint32_t>(sides, {objects, 2});
    appearance_to_tensors(appearance, file);
    file.tensors["mask_runs"] = make_tensor<std::uint8_t>(runs, {runs.size() / 2, 2});
}

/// A metadata text.
[[nodiscard]] inline const std::string& metadata_text(const TensorFile& file, const std::string& key) {
    const auto found = file.metadata.find(key);
    if (found == file.metadata.end())
        throw FileError(join_text(file.source, ": expected metadata '", key, "', got none of this name"));
    return found->second;
}

/// The texts of a metadata text that is a JSON array of them.
[[nodiscard]] inline std::vector<std::string> metadata_texts(const TensorFile& file, const std::string& key) {
    const std::string place = file.source + ", " + key;
    const Json list = parse_json(metadata_text(file, key), place);
    if (!list.is_array()) throw FileError(place + ": expected an array, got " + json_text(list));
    std::vector<std::string> texts;
    for (const Json& text : list) {
        if (!text.is_string()) throw FileError(place + ": expected texts, got " + json_text(text));
        texts.push_back(text.get<std::string>());
    }
    return texts;
}

[[nodiscard]] inline std::vector<std::string> read_class_names(const TensorFile& file) {
    std::vector<std::string> names = metadata_texts(file, "class_names");
    expect<FileError>(!names.empty(), lazy_text(file.source, ": class names"), "1 or more", "none");
    expect<FileError>(std::set(names.begin(), names.end()).size() == names.size(),
                      lazy_text(file.source, ": class names"), "each once", "one twice");
    return names;
}

/// @throws FileError where a number is out of range.
inline void check_occurrence(const Occurrence& o, const Shapes& shapes, const std::string& place) {
    expect<FileError>(std::isfinite(o.x) && std::isfinite(o.y), lazy_text(place, ": x, y"), "finite numbers",
                      lazy_text(o.x, ", ", o.y));
    expect<FileError>(std::isfinite(o.scale) && o.scale > 0, lazy_text(place, ": scale"), "above 0", o.scale);
    expect<FileError>(!std::isinf(o.depth_m), lazy_text(place, ": depth"), "metres or NaN", o.depth_m);
    expect<FileError>(std::isfinite(o.weight) && o.weight >= 0, lazy_text(place, ": weight"), "0 or more",
                      o.weight);
    expect<FileError>(o.object < shapes.objects.size(), lazy_text(place, ": object"),
                      lazy_text("below ", shapes.objects.size()), o.object);
    expect<FileError>(o.class_index == shapes.objects[o.object].class_index, lazy_text(place, ": class"),
                      lazy_text(shapes.objects[o.object].class_index, " as its object"), o.class_index);
}

/// Reads what shapes_to_tensors() wrote, for a codebook of `words` words.
[[nodiscard]] inline Shapes shapes_from_tensors(const TensorFile& file, std::size_t words) {
    Shapes shapes;
    shapes.class_names = read_class_names(file);
    const auto classes = values<std::uint32_t>(file, "object_classes", {any_length});
    const std::size_t objects = classes.size();
    const auto sizes = values<float>(file, "object_sizes", {objects, 3});
    const auto sides = values<std::uint32_t>(file, "mask_sizes", {objects, 2});
    auto runs = values<std::uint8_t>(file, "mask_runs", {any_length, 2});
    const std::vector<std::string> images = metadata_texts(file, "images");
    expect<FileError>(objects > 0, lazy_text(file.source, ": training objects"), "1 or more", 0);
    expect<FileError>(images.size() == objects, lazy_text(file.source, ": image names"), objects,
                      images.size());
    for (std::size_t i = 0; i < objects; ++i) {
        const std::string place = join_text(file.source, ", object ", i);
        TrainingObject object{.class_index = classes[i],
                              .width = sizes[3 * i],
                              .height = sizes[3 * i + 1],
                              .size_px = sizes[3 * i + 2],
                              .mask = unpack_mask(runs, sides[2 * i], sides[2 * i + 1], place),
                              .image = images[i]};
        expect<FileError>(object.class_index < shapes.class_names.size(), lazy_text(place, ": class"),
                          lazy_text("below ", shapes.class_names.size()), object.class_index);
        for (const float side : {object.width, object.height, object.size_px})
            expect<FileError>(std::isfinite(side) && side > 0, lazy_text(place, ": size"), "above 0 px",
                              side);
        shapes.objects.push_back(std::move(object));
    }
    expect<FileError>(runs.empty(), lazy_text(file.source, ": mask runs"), "as many as the masks need",
                      "more");

    const auto first = values<std::uint32_t>(file, "first_occurrence", {words + 1});
    const auto numbers = values<float>(file, "occurrences", {any_length, 5});
    const std::size_t count = numbers.size() / 5;
    const auto indices = values<std::uint32_t>(file, "occurrence_indices", {count, 3});
    expect<FileError>(first.front() == 0 && first.back() == count,
                      lazy_text(file.source, ": first_occurrence"), lazy_text("0 to ", count),
                      lazy_text(first.front(), " to ", first.back()));
    for (std::size_t w = 0; w < words; ++w)
        expect<FileError>(first[w] <= first[w + 1], lazy_text(file.source, ": first_occurrence"),
                          "rising numbers", lazy_text(first[w], " before ", first[w + 1]));
    shapes.first.assign(first.begin(), first.end());
    shapes.occurrences.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const float* n = numbers.data() + 5 * i;
        const std::uint32_t* k = indices.data() + 3 * i;
        const Occurrence occurrence{n[0], n[1], n[2], n[3], n[4], k[0], k[1], k[2]};
        check_occurrence(occurrence, shapes, join_text(file.source, ", occurrence ", i));
        shapes.occurrences.push_back(occurrence);
    }

    shapes.appearance = appearance_from_tensors(file, words, shapes.class_names.size());
    return shapes;
}

}  // namespace ism::detail
