// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ism/core/box_check.hpp"
#include "ism/core/error.hpp"
#include "ism/core/frame.hpp"
#include "ism/core/geometry.hpp"

namespace ism {

/// @brief What and where an object is in an image.
struct ObjectLabel {
    std::uint32_t class_index = 0;  ///< into the class names given to train()
    Box box;                        ///< pixels
    bool masked = false;            ///< labelled with a mask, too
};

/// @brief From this IoU on a box is that of a labelled object, in training as where detections are judged.
inline constexpr double right_iou = 0.5;

/// @brief One labelled object of a training image.
struct LabelledObject {
    std::uint32_t class_index = 0;  ///< into the class names given to train()
    Box box;                        ///< pixels
    Mask mask = {};                 ///< of the image's size; empty: the box is the mask
    std::string instance = {};      ///< which thing of the class it is; empty = not known
    /// Of its middle in the camera frame; none: where the ray through the middle of its box meets the median
    /// depth of its mask. Votes for positions in space tell the place that they were taught.
    std::optional<Point3> position_m = {};

    [[nodiscard]] ObjectLabel label() const { return {class_index, box, !mask.empty()}; }
};

/// @brief An image to learn from. Without objects it is background.
struct TrainingImage {
    Frame frame;
    std::vector<LabelledObject> objects = {};
    std::string name = {};  ///< for messages; a file name, say
    /// Boxes that may show objects but teach none: crowds, and what is too hard to see. What lies in them is
    /// no example of what a class is not, either.
    std::vector<Box> ignored = {};
};

/// @brief Whether half of a box or more lies in one of the regions to ignore.
[[nodiscard]] inline bool is_ignored(const Box& box, const std::vector<Box>& ignored) {
    return std::any_of(ignored.begin(), ignored.end(), [&](const Box& region) {
        return intersection(box, region).area() >= 0.5 * box.area();
    });
}

/// @brief Validates a label in an image of `width` × `height` pixels.
/// @throws Error for a class that is not below `classes`, or a box that check_labelled_box() refuses.
inline void check(const ObjectLabel& label, std::size_t classes, int width, int height) {
    expect(label.class_index < classes, "class of an object", lazy_text("an index below ", classes),
           label.class_index);
    check_labelled_box(label.box, width, height);
}

/// @brief Validates a training image and its labels.
/// @throws Error, which names the image, for a frame that check(Frame) refuses, a label that is refused, or a
/// mask of another size or without figure.
inline void check(const TrainingImage& image, std::size_t classes) {
    const GrayImage& gray = image.frame.gray;
    try {
        check(image.frame);
        for (const LabelledObject& object : image.objects) {
            check(object.label(), classes, gray.width(), gray.height());
            if (const std::optional<Point3>& at = object.position_m)
                expect(at->z > 0 && std::abs(at->x) <= 1e6 && std::abs(at->y) <= 1e6 && at->z <= 1e6,
                       "position of an object", "at most 1e6 m off, and before the camera, z above 0",
                       lazy_text(at->x, ", ", at->y, ", ", at->z));
            if (object.mask.empty()) continue;
            expect(object.mask.width() == gray.width() && object.mask.height() == gray.height(), "mask size",
                   size_text(gray), size_text(object.mask));
            const std::size_t area = mask_area(object.mask);
            expect(area > 1, "mask", "at least 2 figure pixels", area);
        }
        for (const Box& region : image.ignored) check_labelled_box(region, gray.width(), gray.height());
    } catch (const Error& error) {
        throw Error(join_text(image.name, ": ", error.what()));
    }
}

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
        if (object.position_m) object.position_m->x *= -1;
    }
    for (Box& region : image.ignored) region.x = width - region.x - region.width;
    return image;
}

}  // namespace ism
