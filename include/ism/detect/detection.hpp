// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "ism/core/camera.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/feature/feature.hpp"

namespace ism {

/// @brief One vote that a hypothesis stands on: which feature cast it, through which word and occurrence.
struct Support {
    std::uint32_t feature = 0;     ///< index of the feature in the image
    std::uint32_t word = 0;        ///< index of the matched word in the codebook
    std::uint32_t occurrence = 0;  ///< index of the occurrence in the model
    float weight = 0;              ///< what it adds to the score
};

/// @brief Which pixels belong to an object. All images are of one size and cover the part of the picture
/// whose first pixel is (x, y).
struct Segmentation {
    int x = 0, y = 0;  ///< where the part begins, pixels of the picture
    GrayImage figure;  ///< p(figure) carried by the support, ≥ 0; 0 where no patch reaches
    GrayImage ground;  ///< p(ground) carried by the support, ≥ 0
    Mask mask;         ///< 1 where figure outweighs ground
};

/// @brief The whole-picture mask of a segmentation; what reaches outside the picture is cut off.
[[nodiscard]] inline Mask whole_mask(const Segmentation& part, int width, int height) {
    Mask whole(width, height);
    for (int y = 0; y < part.mask.height(); ++y)
        for (int x = 0; x < part.mask.width(); ++x)
            if (part.mask(x, y) != 0 && whole.contains(part.x + x, part.y + y))
                whole(part.x + x, part.y + y) = 1;
    return whole;
}

/// @brief An object found in a picture.
struct Detection {
    std::size_t class_index = 0;       ///< into the model's class names
    double score = 0;                  ///< larger is surer; comparable between pictures and classes
    Point2 centre;                     ///< of the object, pixels
    Box box;                           ///< pixels; may reach outside the picture
    double scale = 1;                  ///< s: the object's size relative to the reference size
    double depth_m = no_depth;         ///< along the optical axis, metres; NaN = not known
    std::optional<Point3> position_m;  ///< in the camera frame; where camera and depth are known
    Segmentation segmentation;         ///< figure and ground maps and mask
    std::vector<Support> support;      ///< why it was found, strongest first
};

/// @brief All that was found in a picture, with the features it was found by.
struct Detections {
    std::vector<Detection> objects;  ///< strongest first
    std::vector<Feature> features;   ///< what Support::feature points into
};

}  // namespace ism
