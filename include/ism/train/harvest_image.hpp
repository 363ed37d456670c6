// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ism/feature/depth.hpp"
#include "ism/feature/extract.hpp"
#include "ism/model/occurrence.hpp"
#include "ism/train/training_image.hpp"

namespace ism {

/// @brief All that training images tell: the objects, and the features on them with their descriptors.
template <Detector D, Descriptor Desc>
struct Harvest {
    Extractor<D, Desc> extractor;  ///< as used, with the upsampling chosen from the data
    std::vector<std::string> class_names;
    std::vector<TrainingObject> objects;
    std::vector<std::uint32_t> first_object;  ///< image i has first_object[i] … first_object[i + 1] − 1
    std::vector<Occurrence> seen;             ///< one for each feature: where on which object it was
    Descriptors<typename Desc::Scalar, Desc::dimension>
        descriptors;  ///< row i describes the feature of seen[i]
};

namespace detail {

/// An object brought to the reference size, without its features.
[[nodiscard]] inline TrainingObject describe_object(const LabelledObject& object, const Mask& mask,
                                                    const std::string& image) {
    const double size_px = std::sqrt(object.box.area()), to_reference = reference_size_px / size_px;
    TrainingObject result{.class_index = static_cast<std::uint32_t>(object.class_index),
                          .width = static_cast<float>(object.box.width * to_reference),
                          .height = static_cast<float>(object.box.height * to_reference),
                          .size_px = static_cast<float>(size_px),
                          .mask = {},
                          .image = image};
    const int columns = std::max(1, static_cast<int>(std::lround(result.width / mask_cell_px)));
    const int rows = std::max(1, static_cast<int>(std::lround(result.height / mask_cell_px)));
    result.mask = Mask(columns, rows);
    constexpr int samples = 3;  // a side of a cell
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            int figure = 0;
            for (int sub = 0; sub < samples * samples; ++sub) {
                const double u = (column + (sub % samples + 0.5) / samples) / columns;
                const double v = (row + (sub / samples + 0.5) / samples) / rows;
                const int x = static_cast<int>(std::floor(object.box.x + u * object.box.width));
                const int y = static_cast<int>(std::floor(object.box.y + v * object.box.height));
                figure += mask.contains(x, y) && mask(x, y) != 0;
            }
            result.mask(column, row) = static_cast<std::uint8_t>(255 * figure / (samples * samples));
        }
    return result;
}

/// The mask of an object, or its box as one.
[[nodiscard]] inline Mask object_mask(const LabelledObject& object, int width, int height) {
    if (!object.mask.empty()) return object.mask;
    Mask mask(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            mask(x, y) = x + 0.5 >= object.box.x && x + 0.5 <= object.box.x + object.box.width &&
                         y + 0.5 >= object.box.y && y + 0.5 <= object.box.y + object.box.height;
    return mask;
}

/// @throws Error unless an image and its objects can be learnt from.
inline void check_training_image(const TrainingImage& image, std::size_t classes) {
    try {
        check(image.frame);
    } catch (const Error& error) {
        throw Error(join_text(image.name, ": ", error.what()));
    }
    const GrayImage& gray = image.frame.gray;
    for (const LabelledObject& object : image.objects) {
        const Box& box = object.box;
        expect(object.class_index < classes, lazy_text(image.name, ": class of an object"),
               lazy_text("an index below ", classes), object.class_index);
        expect(std::isfinite(box.x) && std::isfinite(box.y) && std::isfinite(box.area()) && box.width > 0 &&
                   box.height > 0,
               lazy_text(image.name, ": box of an object"), "finite numbers, positive sides",
               lazy_text(box.x, ", ", box.y, ", ", box.width, ", ", box.height));
        if (object.mask.empty()) continue;
        expect(object.mask.width() == gray.width() && object.mask.height() == gray.height(),
               lazy_text(image.name, ": mask size"), size_text(gray), size_text(object.mask));
        expect(mask_area(object.mask) > 1, lazy_text(image.name, ": mask"), "at least 2 figure pixels",
               mask_area(object.mask));
    }
}

/// Median depth of an object's figure, metres; no_depth without readings.
[[nodiscard]] inline float object_depth(const Frame& frame, const Mask& mask) {
    std::vector<float> readings;
    for (int y = 0; y < frame.depth_m.height(); ++y)
        for (int x = 0; x < frame.depth_m.width(); ++x)
            if (mask(x, y) != 0 && is_depth(frame.depth_m(x, y))) readings.push_back(frame.depth_m(x, y));
    if (readings.empty()) return no_depth;
    const auto middle = readings.begin() + std::ptrdiff_t(readings.size() / 2);
    std::nth_element(readings.begin(), middle, readings.end());
    return *middle;
}

/// Indices of the features on a mask, in order; if there are more than `most`, only the strongest.
[[nodiscard]] inline std::vector<std::size_t> strongest_on(const Mask& mask,
                                                           std::span<const Feature> features,
                                                           std::size_t most) {
    std::vector<std::size_t> on;
    for (std::size_t i = 0; i < features.size(); ++i) {
        const int x = static_cast<int>(std::lround(features[i].x)),
                  y = static_cast<int>(std::lround(features[i].y));
        if (mask.contains(x, y) && mask(x, y) != 0) on.push_back(i);
    }
    if (on.size() <= most) return on;
    std::stable_sort(on.begin(), on.end(), [&](std::size_t a, std::size_t b) {
        return features[a].strength > features[b].strength;
    });
    on.resize(most);
    std::sort(on.begin(), on.end());
    return on;
}

/// What one training image adds, its objects numbered within the image.
template <Detector D, Descriptor Desc>
[[nodiscard]] Harvest<D, Desc> harvest_image(const TrainingImage& image, const Extractor<D, Desc>& extractor,
                                             std::size_t most_an_object) {
    Harvest<D, Desc> result;
    if (image.objects.empty()) return result;
    auto found = extract(image.frame.gray, extractor, 1);
    if (!image.frame.depth_m.empty()) found.features = with_depth(found.features, image.frame.depth_m);
    for (const LabelledObject& object : image.objects) {
        const Mask mask = object_mask(object, image.frame.gray.width(), image.frame.gray.height());
        const float depth_m = image.frame.depth_m.empty() ? no_depth : object_depth(image.frame, mask);
        const auto to_reference = static_cast<float>(reference_size_px / std::sqrt(object.box.area()));
        const Point2 centre = object.box.centre();
        for (const std::size_t i : strongest_on(mask, found.features, most_an_object)) {
            const Feature& feature = found.features[i];
            result.seen.push_back({.x = (feature.x - static_cast<float>(centre.x)) * to_reference,
                                   .y = (feature.y - static_cast<float>(centre.y)) * to_reference,
                                   .scale = feature.scale * to_reference,
                                   .depth_m = feature.depth_m - depth_m,
                                   .weight = 1,
                                   .class_index = static_cast<std::uint32_t>(object.class_index),
                                   .object = static_cast<std::uint32_t>(result.objects.size()),
                                   .feature = 0});
            result.descriptors.push_back(found.descriptors.row(i));
        }
        result.objects.push_back(describe_object(object, mask, image.name));
    }
    return result;
}

}  // namespace detail

}  // namespace ism
