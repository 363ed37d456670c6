// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "ism/core/frame.hpp"
#include "ism/dataset/dataset.hpp"
#include "ism/train/training_image.hpp"

namespace ism {

/// @brief What and where the objects of an image of a data set are; crowds are left out.
[[nodiscard]] inline std::vector<ObjectLabel> object_labels(const DatasetImage& image) {
    std::vector<ObjectLabel> labels;
    for (const DatasetAnnotation& object : image.objects)
        if (!object.crowd)
            labels.push_back(
                {.class_index = object.class_index, .box = object.box, .masked = object.masked()});
    return labels;
}

/// @brief An image of a data set to learn from, with the masks of its objects; crowds are to be ignored.
/// @param frame  its pixels
/// @throws FileError as read_mask() does.
[[nodiscard]] inline TrainingImage to_training_image(const DatasetImage& image, Frame frame) {
    TrainingImage training{
        .frame = std::move(frame), .name = image.file.string(), .ignored = ignored_boxes(image)};
    for (const DatasetAnnotation& object : image.objects)
        if (!object.crowd)
            training.objects.push_back({.class_index = object.class_index,
                                        .box = object.box,
                                        .mask = read_mask(image, object),
                                        .instance = object.instance,
                                        .position_m = object.position_m});
    return training;
}

}  // namespace ism
