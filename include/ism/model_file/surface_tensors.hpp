// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/text.hpp"
#include "ism/model/mask_judge.hpp"
#include "ism/model/occurrence_frame.hpp"
#include "ism/model/training_object.hpp"
#include "ism/model_file/shape_tensors.hpp"
#include "ism/model_file/tensor.hpp"

/// What a model knows of surfaces in space, as tensors.
namespace ism::detail {

/// @throws FileError for a number that is not −most … most.
inline void check_numbers(std::span<const float> numbers, float most, TextPart place) {
    for (const float number : numbers)
        expect<FileError>(std::abs(number) <= most, place, lazy_text(-most, " ... ", most), number);
}

/// Where objects lie in space and points of their surfaces; nothing where no object has either.
inline void points_to_tensors(std::span<const TrainingObject> objects, TensorFile& file) {
    std::vector<float> places, points;
    std::vector<std::uint32_t> offsets{0};
    for (const TrainingObject& o : objects) {
        places.insert(places.end(), {o.centre_m.x, o.centre_m.y, o.centre_m.z, o.size_m});
        for (const Vec3f& p : o.points_m) points.insert(points.end(), {p.x, p.y, p.z});
        offsets.push_back(static_cast<std::uint32_t>(points.size() / 3));
    }
    if (points.empty() && std::all_of(places.begin(), places.end(), [](float p) { return p == 0; })) return;
    file.tensors["object_places"] = make_tensor<float>(places, {objects.size(), 4});
    file.tensors["object_points"] = make_tensor<float>(points, {points.size() / 3, 3});
    file.tensors["object_point_offsets"] = offsets_tensor(offsets);
}

[[nodiscard]] inline std::vector<TrainingObject> with_points_from_tensors(std::vector<TrainingObject> objects,
                                                                          const TensorFile& file) {
    if (!file.tensors.contains("object_places")) return objects;
    constexpr float most_m = 1e6f;
    const auto places = values<float>(file, "object_places", {objects.size(), 4});
    const auto points = values<float>(file, "object_points", {any_length, 3});
    const auto offsets = offsets_from_tensor(file, "object_point_offsets", objects.size(), points.size() / 3);
    check_numbers(places, most_m, lazy_text(file.source, ": object_places"));
    check_numbers(points, most_m, lazy_text(file.source, ": object_points"));
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const float* place = places.data() + 4 * i;
        expect<FileError>(place[2] >= 0 && place[3] >= 0,
                          lazy_text(file.source, ": depth and size of an object"), "0 or more",
                          lazy_text(place[2], ", ", place[3]));
        objects[i].centre_m = {place[0], place[1], place[2]};
        objects[i].size_m = place[3];
        for (std::size_t p = offsets[i]; p < offsets[i + 1]; ++p)
            objects[i].points_m.push_back({points[3 * p], points[3 * p + 1], points[3 * p + 2]});
    }
    return objects;
}

/// Offset, quaternion and scale a row; nothing where there are no frames.
inline void frames_to_tensors(std::span<const OccurrenceFrame> frames, TensorFile& file) {
    if (frames.empty()) return;
    std::vector<float> rows;
    for (const auto& [offset, rotation, scale_m] : frames)
        rows.insert(rows.end(),
                    {offset.x, offset.y, offset.z, rotation.w, rotation.x, rotation.y, rotation.z, scale_m});
    file.tensors["occurrence_frames"] = make_tensor<float>(rows, {frames.size(), 8});
}

/// @param occurrences  each of which points to a frame, where there are any
[[nodiscard]] inline std::vector<OccurrenceFrame> frames_from_tensors(
    const TensorFile& file, std::span<const Occurrence> occurrences) {
    if (!file.tensors.contains("occurrence_frames")) return {};
    const auto rows = values<float>(file, "occurrence_frames", {any_length, 8});
    check_numbers(rows, 1e6f, lazy_text(file.source, ": occurrence_frames"));
    std::vector<OccurrenceFrame> frames;
    for (std::size_t i = 0; 8 * i < rows.size(); ++i) {
        const float* r = rows.data() + 8 * i;
        expect<FileError>(
            std::abs(r[3] * r[3] + r[4] * r[4] + r[5] * r[5] + r[6] * r[6] - 1) < 1e-3f && r[7] >= 0,
            lazy_text(file.source, ": occurrence_frames"), "unit quaternions, scales of 0 or more",
            lazy_text(r[3], ", ", r[4], ", ", r[5], ", ", r[6], "; ", r[7]));
        frames.push_back({{r[0], r[1], r[2]}, {r[3], r[4], r[5], r[6]}, r[7]});
    }
    for (const Occurrence& o : occurrences)
        expect<FileError>(o.feature < frames.size(), lazy_text(file.source, ": feature of an occurrence"),
                          lazy_text("below ", frames.size(), ", the number of frames"), o.feature);
    return frames;
}

/// Nothing where there is no judge.
inline void mask_judge_to_tensors(const MaskJudge& judge, TensorFile& file) {
    if (judge.empty()) return;
    const auto& [examples, mean, deviation, weights, bias, shape_bin_m] = judge;
    std::vector<float> looks, regression;
    std::vector<std::uint32_t> what;
    for (const auto& [look, class_index, object] : examples) {
        looks.insert(looks.end(), look.color.begin(), look.color.end());
        looks.insert(looks.end(), look.shape.begin(), look.shape.end());
        what.insert(what.end(), {class_index, object});
    }
    for (const MaskCues& row : {mean, deviation, weights})
        regression.insert(regression.end(), row.begin(), row.end());
    file.tensors["mask_looks"] =
        make_tensor<float>(looks, {examples.size(), color_histogram_bins + shape_bins});
    file.tensors["mask_classes"] = make_tensor<std::uint32_t>(what, {examples.size(), 2});
    file.tensors["mask_regression"] = make_tensor<float>(regression, {3, mask_cue_count});
    file.tensors["mask_numbers"] = make_tensor<float>(std::array{bias, shape_bin_m}, {2});
}

[[nodiscard]] inline MaskJudge mask_judge_from_tensors(const TensorFile& file,
                                                       std::span<const TrainingObject> objects) {
    MaskJudge judge;
    if (!file.tensors.contains("mask_looks")) return judge;
    const auto looks = values<float>(file, "mask_looks", {any_length, color_histogram_bins + shape_bins});
    const std::size_t count = looks.size() / (color_histogram_bins + shape_bins);
    const auto what = values<std::uint32_t>(file, "mask_classes", {count, 2});
    const auto regression = values<float>(file, "mask_regression", {3, mask_cue_count});
    const auto numbers = values<float>(file, "mask_numbers", {2});
    check_numbers(looks, 1.001f, lazy_text(file.source, ": mask_looks"));
    for (const auto& part : {regression, numbers})
        check_numbers(part, 1e9f, lazy_text(file.source, ": judge of masks"));
    for (std::size_t i = 0; i < count; ++i) {
        MaskExample example{.class_index = what[2 * i], .object = what[2 * i + 1]};
        const bool background = example.class_index == MaskExample::background;
        expect<FileError>(background ? example.object == MaskExample::background
                                     : example.object < objects.size() &&
                                           objects[example.object].class_index == example.class_index,
                          lazy_text(file.source, ": mask_classes"), "background, or the class of an object",
                          lazy_text(example.class_index, " of object ", example.object));
        const float* look = looks.data() + i * (color_histogram_bins + shape_bins);
        std::copy_n(look, color_histogram_bins, example.look.color.begin());
        std::copy_n(look + color_histogram_bins, shape_bins, example.look.shape.begin());
        judge.examples.push_back(example);
    }
    std::copy_n(regression.begin(), mask_cue_count, judge.mean.begin());
    std::copy_n(regression.begin() + mask_cue_count, mask_cue_count, judge.deviation.begin());
    std::copy_n(regression.begin() + 2 * mask_cue_count, mask_cue_count, judge.weights.begin());
    for (const float deviation : judge.deviation)
        expect<FileError>(deviation > 0, lazy_text(file.source, ": deviation of a cue"), "above 0",
                          deviation);
    judge.bias = numbers[0], judge.shape_bin_m = numbers[1];
    expect<FileError>(judge.shape_bin_m > 0, lazy_text(file.source, ": shape_bin_m"), "above 0",
                      judge.shape_bin_m);
    return judge;
}

}  // namespace ism::detail
