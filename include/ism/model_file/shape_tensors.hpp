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
#include <utility>
#include <vector>

#include "ism/io/json.hpp"
#include "ism/io/limits.hpp"
#include "ism/model/figure_reach.hpp"
#include "ism/model/shape_model.hpp"
#include "ism/model_file/tensor.hpp"

/// Training objects and occurrences as tensors: a column each member, by name.
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

/// Numbers of the classes, all different; none where the file has none.
[[nodiscard]] inline std::vector<std::int64_t> read_category_ids(const TensorFile& file,
                                                                 std::size_t classes) {
    if (!file.metadata.contains("category_ids")) return {};
    const std::string place = file.source + ", category_ids";
    const Json list = parse_json(metadata_text(file, "category_ids"), place);
    if (!list.is_array() || list.size() != classes)
        throw FileError(join_text(place, ": expected an array of ", classes, ", got ", json_text(list)));
    std::vector<std::int64_t> ids;
    for (const Json& id : list) ids.push_back(to_integer(id, "id", place));
    expect<FileError>(std::set(ids.begin(), ids.end()).size() == ids.size(), place, "each once", "one twice");
    return ids;
}

inline void objects_to_tensors(std::span<const TrainingObject> objects, TensorFile& file) {
    std::vector<float> sizes;
    std::vector<std::uint32_t> classes, sides;
    std::vector<std::uint8_t> runs;
    Json images = Json::array();
    for (const TrainingObject& o : objects) {
        // A member that is added to TrainingObject does not compile here until it is kept too.
        const auto& [class_index, width, height, size_px, mask, image, reach, size_m, centre_m, points_m] = o;
        // reach is the mask's; the last three: points_to_tensors()
        sizes.insert(sizes.end(), {width, height, size_px});
        classes.push_back(class_index);
        sides.insert(sides.end(), {std::uint32_t(mask.width()), std::uint32_t(mask.height())});
        pack_mask(mask, runs);
        images.push_back(image);
    }
    file.metadata["images"] = dump_json(images, file.source + ": image names");
    file.tensors["object_sizes"] = make_tensor<float>(sizes, {objects.size(), 3});
    file.tensors["object_classes"] = make_tensor<std::uint32_t>(classes, {objects.size()});
    file.tensors["mask_sizes"] = make_tensor<std::uint32_t>(sides, {objects.size(), 2});
    file.tensors["mask_runs"] = make_tensor<std::uint8_t>(runs, {runs.size() / 2, 2});
}

[[nodiscard]] inline std::vector<TrainingObject> objects_from_tensors(const TensorFile& file,
                                                                      std::size_t class_count) {
    const auto classes = values<std::uint32_t>(file, "object_classes", {any_length});
    const std::size_t count = classes.size();
    const auto sizes = values<float>(file, "object_sizes", {count, 3});
    const auto sides = values<std::uint32_t>(file, "mask_sizes", {count, 2});
    auto runs = values<std::uint8_t>(file, "mask_runs", {any_length, 2});
    const std::vector<std::string> images = metadata_texts(file, "images");
    expect<FileError>(count > 0, lazy_text(file.source, ": training objects"), "1 or more", 0);
    expect<FileError>(images.size() == count, lazy_text(file.source, ": image names"), count, images.size());
    std::vector<TrainingObject> objects;
    for (std::size_t i = 0; i < count; ++i) {
        const std::string place = join_text(file.source, ", object ", i);
        TrainingObject object{.class_index = classes[i],
                              .width = sizes[3 * i],
                              .height = sizes[3 * i + 1],
                              .size_px = sizes[3 * i + 2],
                              .mask = unpack_mask(runs, sides[2 * i], sides[2 * i + 1], place),
                              .image = images[i]};
        expect<FileError>(object.class_index < class_count, lazy_text(place, ": class"),
                          lazy_text("below ", class_count), object.class_index);
        for (const float side : {object.width, object.height, object.size_px})
            expect<FileError>(side >= 1e-3f && side <= 1e6f, lazy_text(place, ": size"), "0.001 ... 1e6 px",
                              side);
        object.reach = figure_reach(object.mask, object.width, object.height);
        objects.push_back(std::move(object));
    }
    expect<FileError>(runs.empty(), lazy_text(file.source, ": mask runs"), "as many as the masks need",
                      "more");
    return objects;
}

/// @param prefix  of the tensors' names
inline void occurrences_to_tensors(std::span<const Occurrence> occurrences, const std::string& prefix,
                                   TensorFile& file) {
    const std::size_t count = occurrences.size();
    std::vector<float> reals(6 * count);
    std::vector<std::uint32_t> indices(3 * count);
    for (std::size_t i = 0; i < count; ++i) {
        // A member that is added to Occurrence does not compile here until it is kept too.
        const auto& [x, y, scale, angle, depth_m, weight, class_index, object, feature] = occurrences[i];
        std::size_t column = 0;
        for (const float value : {x, y, scale, angle, depth_m, weight}) reals[column++ * count + i] = value;
        column = 0;
        for (const std::uint32_t value : {class_index, object, feature})
            indices[column++ * count + i] = value;
    }
    std::size_t column = 0;
    for (const char* name : {"x", "y", "scale", "angle", "depth_m", "weight"})
        file.tensors[prefix + name] =
            make_tensor<float>(std::span<const float>(reals).subspan(column++ * count, count), {count});
    column = 0;
    for (const char* name : {"class", "object", "feature"})
        file.tensors[prefix + name] = make_tensor<std::uint32_t>(
            std::span<const std::uint32_t>(indices).subspan(column++ * count, count), {count});
}

/// @throws FileError where a number is out of range.
inline void check_occurrence(const Occurrence& o, std::span<const TrainingObject> objects, TextPart place) {
    constexpr float most = 1e7f;  // px
    expect<FileError>(std::abs(o.x) <= most && std::abs(o.y) <= most, lazy_text(place, ": x, y"),
                      "-1e7 ... 1e7 px", lazy_text(o.x, ", ", o.y));
    expect<FileError>(o.scale >= 1e-6f && o.scale <= most, lazy_text(place, ": scale"), "1e-6 ... 1e7 px",
                      o.scale);
    expect<FileError>(std::abs(o.angle) <= 100, lazy_text(place, ": angle"), "-100 ... 100", o.angle);
    expect<FileError>(!std::isinf(o.depth_m), lazy_text(place, ": depth"), "metres or NaN", o.depth_m);
    expect<FileError>(o.weight >= 0 && o.weight <= 1e6f, lazy_text(place, ": weight"), "0 ... 1e6", o.weight);
    expect<FileError>(o.object < objects.size(), lazy_text(place, ": object"),
                      lazy_text("below ", objects.size()), o.object);
    expect<FileError>(o.class_index == objects[o.object].class_index, lazy_text(place, ": class"),
                      lazy_text(objects[o.object].class_index, " as its object"), o.class_index);
}

[[nodiscard]] inline std::vector<Occurrence> occurrences_from_tensors(
    const TensorFile& file, const std::string& prefix, std::span<const TrainingObject> objects) {
    const std::size_t count = values<float>(file, prefix + "x", {any_length}).size();
    const auto real = [&](const char* name) { return values<float>(file, prefix + name, {count}); };
    const auto index = [&](const char* name) { return values<std::uint32_t>(file, prefix + name, {count}); };
    const auto x = real("x"), y = real("y"), scale = real("scale"), angle = real("angle"),
               depth_m = real("depth_m"), weight = real("weight");
    const auto class_index = index("class"), object = index("object"), feature = index("feature");
    std::vector<Occurrence> occurrences(count);
    for (std::size_t i = 0; i < count; ++i) {
        occurrences[i] = {x[i],      y[i],           scale[i],  angle[i],  depth_m[i],
                          weight[i], class_index[i], object[i], feature[i]};
        check_occurrence(occurrences[i], objects, lazy_text(file.source, ", ", prefix, i));
    }
    return occurrences;
}

/// Where groups begin, as a tensor.
[[nodiscard]] inline std::vector<std::uint32_t> offsets_from_tensor(const TensorFile& file,
                                                                    const std::string& name,
                                                                    std::size_t groups, std::size_t count) {
    const auto offsets = values<std::uint32_t>(file, name, {groups + 1});
    expect<FileError>(offsets.front() == 0 && offsets.back() == count, lazy_text(file.source, ": ", name),
                      lazy_text("0 to ", count), lazy_text(offsets.front(), " to ", offsets.back()));
    for (std::size_t g = 0; g < groups; ++g)
        expect<FileError>(offsets[g] <= offsets[g + 1], lazy_text(file.source, ": ", name), "rising numbers",
                          lazy_text(offsets[g], " before ", offsets[g + 1]));
    return {offsets.begin(), offsets.end()};
}

[[nodiscard]] inline Tensor offsets_tensor(std::span<const std::uint32_t> offsets) {
    return make_tensor<std::uint32_t>(offsets, {offsets.size()});
}

inline void shapes_to_tensors(const ShapeModel& shapes, TensorFile& file) {
    // A member that is added to ShapeModel does not compile here until it is kept too.
    const auto& [class_names, category_ids, objects, occurrences, frames] =
        shapes;  // frames: frames_to_tensors()
    file.metadata["class_names"] = dump_json(Json(class_names), file.source + ": class names");
    if (!category_ids.empty()) file.metadata["category_ids"] = Json(category_ids).dump();
    objects_to_tensors(objects, file);
    occurrences_to_tensors(occurrences.values(), "occurrence_", file);
    file.tensors["word_occurrences"] = offsets_tensor(occurrences.offsets());
}

/// Reads what shapes_to_tensors() wrote, for a model of `words` words.
[[nodiscard]] inline ShapeModel shapes_from_tensors(const TensorFile& file, std::size_t words) {
    ShapeModel shapes{.class_names = read_class_names(file)};
    shapes.category_ids = read_category_ids(file, shapes.class_names.size());
    shapes.objects = objects_from_tensors(file, shapes.class_names.size());
    auto occurrences = occurrences_from_tensors(file, "occurrence_", shapes.objects);
    auto offsets = offsets_from_tensor(file, "word_occurrences", words, occurrences.size());
    shapes.occurrences = {std::move(occurrences), std::move(offsets)};
    return shapes;
}

}  // namespace ism::detail
