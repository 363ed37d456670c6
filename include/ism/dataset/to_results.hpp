// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/dataset/coco_results.hpp"
#include "ism/dataset/dataset.hpp"
#include "ism/dataset/rle.hpp"
#include "ism/detect/detection.hpp"
#include "ism/model/shape_model.hpp"

namespace ism {

/// @brief The detections in an image of a data set as results for write_results(), with masks of the image's
/// size and boxes clipped to it; what is not in the image at all is left out.
/// @param category_ids the data set's number of each class of the model, in the order of the model's classes
/// @throws Error where a detection's class has no number, or the image's size is not allowed.
[[nodiscard]] inline std::vector<Result> to_results(const Detections& detections, const DatasetImage& image,
                                                    std::span<const std::int64_t> category_ids) {
    std::vector<Result> results;
    results.reserve(detections.objects.size());
    for (const Detection& found : detections.objects) {
        const Box box = clipped(found.box, image.width, image.height);
        if (!(box.area() > 0)) continue;
        expect(found.class_index < category_ids.size(), "class of a detection",
               lazy_text("one of ", category_ids.size(), " categories"), found.class_index);
        results.push_back(
            {.image_id = image.id,
             .category_id = category_ids[found.class_index],
             .box = box,
             .score = found.score,
             .probability = found.probability,
             .segmentation = compress_mask(whole_mask(found.segmentation, image.width, image.height)),
             .position_m = found.position_m,
             .depth_m = found.depth_m,
             .scale = found.scale,
             .position_error_m = found.position_error_m,
             .angle_rad = found.angle});
    }
    return results;
}

/// @brief The same with the category ids of the model (result_category_ids()) and the names of its classes.
[[nodiscard]] inline std::vector<Result> to_results(const Detections& detections, const DatasetImage& image,
                                                    const ShapeModel& shapes) {
    const std::vector<std::int64_t> ids = result_category_ids(shapes);
    std::vector<Result> results = to_results(detections, image, ids);
    for (Result& result : results)
        result.class_name = shapes.class_names[std::size_t(
            std::find(ids.begin(), ids.end(), result.category_id) - ids.begin())];
    return results;
}

}  // namespace ism
