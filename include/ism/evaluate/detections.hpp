// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "ism/dataset/dataset.hpp"
#include "ism/detect/detection.hpp"
#include "ism/evaluate/coco.hpp"
#include "ism/evaluate/evaluate.hpp"

namespace ism {

/// @brief What was found in image number `image`, for evaluate().
[[nodiscard]] inline std::vector<FoundObject> found_objects(std::span<const Detection> detections,
                                                            std::size_t image) {
    std::vector<FoundObject> found;
    found.reserve(detections.size());
    for (const Detection& d : detections)
        found.push_back({.image = image, .class_index = d.class_index, .box = d.box, .score = d.score});
    return found;
}

/// @brief Measures detections, those of each image of a data set in its order, against the data set. The
/// classes of the model must be those of the data set in its order: select_classes() puts them so. Crowds are
/// ignored, boxes are clipped to their image, and what lies outside of it is not counted nor judged; masks
/// are compared where the data set has them, two at a time in memory.
/// @throws Error where there are detections of more or fewer images, of a class that the data set lacks, or a
/// score or box is not finite; FileError as read_mask() does.
template <MatchRule R>
[[nodiscard]] Evaluation evaluate(const Dataset& dataset, std::span<const Detections> detections,
                                  const R& rule) {
    expect(detections.size() == dataset.images.size(), "images with detections", dataset.images.size(),
           detections.size());
    const detail::DatasetTruth truth = detail::truth_of(dataset);
    std::vector<FoundObject> found;
    std::vector<const Segmentation*> segmentations;
    for (std::size_t i = 0; i < detections.size(); ++i) {
        const std::vector<FoundObject> objects = found_objects(detections[i].objects, i);
        for (std::size_t k = 0; k < objects.size(); ++k) {
            FoundObject object = objects[k];
            check(object);
            object.box = clipped(object.box, dataset.images[i].width, dataset.images[i].height);
            if (!(object.box.area() > 0)) continue;
            found.push_back(object);
            segmentations.push_back(&detections[i].objects[k].segmentation);
        }
    }
    const auto overlap = [&](std::size_t f, std::size_t t) {
        const DatasetImage& image = dataset.images[truth.where[t].first];
        const Mask mask = read_mask(image, image.objects[truth.where[t].second]);
        if (mask.empty()) return std::numeric_limits<double>::quiet_NaN();
        return mask_iou(whole_mask(*segmentations[f], image.width, image.height), mask);
    };
    return evaluate(truth.objects, found, dataset.images.size(), dataset.class_names, rule, overlap);
}

/// @brief The same with a rule chosen at run time.
/// @throws Error as above, and for a threshold that is not above 0 and at most 1.
[[nodiscard]] inline Evaluation evaluate(const Dataset& dataset, std::span<const Detections> detections,
                                         const EvaluateOptions& options = {}) {
    return detail::with_rule(options, [&](const auto& rule) { return evaluate(dataset, detections, rule); });
}

}  // namespace ism
