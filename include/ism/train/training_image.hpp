// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "ism/core/frame.hpp"
#include "ism/core/geometry.hpp"

namespace ism {

/// @brief One labelled object of a training image.
struct LabelledObject {
    std::size_t class_index = 0;  ///< into the class names given to train()
    Box box;                      ///< pixels
    Mask mask = {};               ///< of the image's size; empty: the box is the mask
};

/// @brief An image to learn from. Without objects it is background.
struct TrainingImage {
    Frame frame;
    std::vector<LabelledObject> objects = {};
    std::string name = {};  ///< for messages; a file name, say
};

/// @brief An image with its labels as a mirror shows it: left and right exchanged.
[[nodiscard]] inline TrainingImage mirrored(TrainingImage image) {
    const int width = image.frame.gray.width();
    image.frame.gray = mirrored(std::move(image.frame.gray));
    image.frame.color = mirrored(std::move(image.frame.color));
    image.frame.depth_m = mirrored(std::move(image.frame.depth_m));
    if (image.frame.camera) image.frame.camera->cx = width - 1 - image.frame.camera->cx;
    for (LabelledObject& object : image.objects) {
        object.box.x = width - object.box.x - object.box.width;
        object.mask = mirrored(std::move(object.mask));
    }
    return image;
}

}  // namespace ism
