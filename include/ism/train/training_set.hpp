// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/core/function.hpp"
#include "ism/train/training_image.hpp"

namespace ism {

/// @brief Labelled images to learn from. Labels are asked for first and open no file; each image is then
/// asked for once, by several threads side by side.
struct TrainingSet {
    std::size_t size = 0;  ///< number of images
    Function<std::vector<ObjectLabel>(std::size_t i)> labels;
    Function<TrainingImage(std::size_t i)> image;
    std::vector<std::int64_t> category_ids = {};  ///< the file's number of each class; empty = none
};

/// @brief Images in memory as a training set.
/// @param images  have to stay as long as the set
[[nodiscard]] inline TrainingSet training_set(std::span<const TrainingImage> images) {
    return {.size = images.size(),
            .labels =
                [images](std::size_t i) {
                    std::vector<ObjectLabel> labels;
                    for (const LabelledObject& object : images[i].objects) labels.push_back(object.label());
                    return labels;
                },
            .image = [images](std::size_t i) { return images[i]; }};
}

}  // namespace ism
