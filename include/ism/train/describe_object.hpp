// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ism/core/camera.hpp"
#include "ism/core/frame.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/order.hpp"
#include "ism/core/vec3.hpp"
#include "ism/feature/feature.hpp"
#include "ism/model/figure_reach.hpp"
#include "ism/model/occurrence.hpp"
#include "ism/model/training_object.hpp"
#include "ism/train/training_image.hpp"

/// One labelled object, brought to the reference size.
namespace ism {

/// @brief The mask of an object, or its box as one.
/// @param width, height  of the image
[[nodiscard]] inline Mask object_mask(const LabelledObject& object, int width, int height) {
    if (!object.mask.empty()) return object.mask;
    Mask mask(width, height);
    const auto inside = [](double px, int end) { return int(std::clamp(px, 0.0, double(end))); };
    const Box& box = object.box;  // of whose pixels the middles lie in it
    const int left = inside(std::ceil(box.x - 0.5), width),
              right = inside(std::floor(box.x + box.width - 0.5) + 1, width);
    const int top = inside(std::ceil(box.y - 0.5), height),
              bottom = inside(std::floor(box.y + box.height - 0.5) + 1, height);
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x) mask(x, y) = 1;
    return mask;
}

/// @brief An object at the reference size.
/// @param mask   of the image's size
/// @param image  name of the image
[[nodiscard]] inline TrainingObject describe_object(const ObjectLabel& label, const Mask& mask,
                                                    const std::string& image) {
    const Box& box = label.box;
    const double size_px = std::sqrt(box.area()), to_reference = reference_size_px / size_px;
    TrainingObject result{.class_index = label.class_index,
                          .width = static_cast<float>(box.width * to_reference),
                          .height = static_cast<float>(box.height * to_reference),
                          .size_px = static_cast<float>(size_px),
                          .mask = {},
                          .image = image};
    const auto cells = [](double side_px) {
        constexpr double most_cells = 4096;  // of very thin boxes
        return static_cast<int>(std::lround(std::clamp(side_px / mask_cell_px, 1.0, most_cells)));
    };
    const int columns = cells(result.width), rows = cells(result.height);
    result.mask = Mask(columns, rows);
    constexpr int samples = 3;  // a side of a cell
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            int figure = 0;
            for (int sub = 0; sub < samples * samples; ++sub) {
                const double u = (column + (sub % samples + 0.5) / samples) / columns;
                const double v = (row + (sub / samples + 0.5) / samples) / rows;
                const int x = static_cast<int>(std::floor(box.x + u * box.width));
                const int y = static_cast<int>(std::floor(box.y + v * box.height));
                figure += mask.contains(x, y) && mask(x, y) != 0;
            }
            result.mask(column, row) = static_cast<std::uint8_t>(255 * figure / (samples * samples));
        }
    result.reach = figure_reach(result.mask, result.width, result.height);
    return result;
}

/// @brief Whether a training object has a mask, labelled or cut out since (masks_from_boxes()), and not just
/// its whole box in place of one.
/// @param width, height  of the image
[[nodiscard]] inline bool has_mask(const TrainingObject& object, const ObjectLabel& label, int width,
                                   int height) {
    return label.masked ||
           describe_object(label, object_mask({.box = label.box}, width, height), {}).mask != object.mask;
}

/// @brief Median depth of an object's figure, metres; no_depth without readings.
/// @param mask  of the image's size
[[nodiscard]] inline float object_depth(const Frame& frame, const Mask& mask) {
    std::vector<float> readings;
    for (int y = 0; y < frame.depth_m.height(); ++y)
        for (int x = 0; x < frame.depth_m.width(); ++x)
            if (mask(x, y) != 0 && is_depth(frame.depth_m(x, y))) readings.push_back(frame.depth_m(x, y));
    if (readings.empty()) return no_depth;
    return detail::nth_smallest(readings, readings.size() / 2);
}

/// @brief Tells where an object lies in the camera frame and how large it is; unchanged where neither its
/// position nor its depth is known.
/// @param position_m  of its middle, where the label tells it
/// @param depth_m     else the depth at which the ray through the middle of its box ends
[[nodiscard]] inline TrainingObject placed_in_space(TrainingObject object, const Box& box,
                                                    const std::optional<Point3>& position_m, double depth_m,
                                                    const Camera& camera) {
    if (!position_m && !is_depth(depth_m)) return object;
    object.centre_m = to_vec3f(position_m ? *position_m : back_project(camera, box.centre(), depth_m));
    object.size_m = static_cast<float>(std::sqrt(box.area()) * object.centre_m.z / camera.fx);
    return object;
}

/// @brief Indices of the features on a mask, in order.
[[nodiscard]] inline std::vector<std::uint32_t> features_on(const Mask& mask,
                                                            const std::vector<Feature>& features) {
    std::vector<std::uint32_t> on;
    for (std::uint32_t i = 0; i < features.size(); ++i) {
        const int x = static_cast<int>(std::lround(features[i].x)),
                  y = static_cast<int>(std::lround(features[i].y));
        if (mask.contains(x, y) && mask(x, y) != 0) on.push_back(i);
    }
    return on;
}

/// @brief The `most` strongest of some features, in order.
[[nodiscard]] inline std::vector<std::uint32_t> strongest(std::vector<std::uint32_t> chosen,
                                                          const std::vector<Feature>& features,
                                                          std::size_t most) {
    if (chosen.size() <= most) return chosen;
    detail::sort_by(chosen, [&](std::uint32_t i) { return detail::falling(features[i].strength); });
    detail::keep_first(chosen, most);
    detail::sort_by(chosen, [](std::uint32_t i) { return i; });
    return chosen;
}

}  // namespace ism
