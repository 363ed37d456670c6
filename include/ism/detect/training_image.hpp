// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
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

}  // namespace ism
