// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ism/core/parallel.hpp"
#include "ism/detect/training_image.hpp"
#include "ism/feature/depth.hpp"
#include "ism/feature/extract.hpp"
#include "ism/vote/occurrence.hpp"

namespace ism {

/// @brief Told now and then while long work goes on: what is being done, how much of it is done, how much
/// there is. May be called from any of the threads, one at a time.
using Progress = std::function<void(std::string_view stage, std::size_t done, std::size_t total)>;

/// @brief Something that gives training image i, for any i and from several threads at once.
template <class S>
concept TrainingSource = requires(const S& source, std::size_t i) {
    { source(i) } -> std::convertible_to<TrainingImage>;
};

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
        expect(object.class_index < classes, join_text(image.name, ": class of an object"),
               join_text("an index below ", classes), object.class_index);
        expect(std::isfinite(box.x) && std::isfinite(box.y) && std::isfinite(box.area()) && box.width > 0 &&
                   box.height > 0,
               join_text(image.name, ": box of an object"), "finite numbers, positive sides",
               join_text(box.x, ", ", box.y, ", ", box.width, ", ", box.height));
        if (object.mask.empty()) continue;
        expect(object.mask.width() == gray.width() && object.mask.height() == gray.height(),
               join_text(image.name, ": mask size"), size_text(gray), size_text(object.mask));
        expect(mask_area(object.mask) > 1, join_text(image.name, ": mask"), "at least 2 figure pixels",
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

/// How much images should be enlarged before features are searched, so that the middle one of the objects has
/// enough of them: small objects are brought to 150 px, large ones stay.
[[nodiscard]] inline double choose_upsampling(std::vector<double> object_sizes_px) {
    constexpr double wanted_px = 150, most = 4;
    const auto middle = object_sizes_px.begin() + std::ptrdiff_t(object_sizes_px.size() / 2);
    std::nth_element(object_sizes_px.begin(), middle, object_sizes_px.end());
    return std::clamp(wanted_px / *middle, 1.0, most);
}

}  // namespace detail

/// @brief How features are collected from training images.
struct HarvestOptions {
    std::size_t max_features = 40000;  ///< of all objects together; each gives its strongest, at least 30
    bool choose_upsampling = true;     ///< small objects are enlarged; false: as the extractor says
    unsigned threads = 0;              ///< 0 = all the machine has
    Progress progress = {};
};

/// @brief Finds and describes the features on the objects of `count` images that `source` gives. Small
/// objects are enlarged before, unless `choose_upsampling` is off. `source` is called twice for each image,
/// from several threads.
/// @param class_names  names of the classes that LabelledObject::class_index points to
/// @throws Error where an image cannot be learnt from, or a class has no object or no feature.
template <Detector D, Descriptor Desc, TrainingSource Source>
[[nodiscard]] Harvest<D, Desc> harvest(std::span<const std::string> class_names, std::size_t count,
                                       const Source& source, const Extractor<D, Desc>& extractor = {},
                                       const HarvestOptions& options = {}) {
    expect(!class_names.empty(), "training: number of classes", "1 or more", 0);
    expect(count > 0, "training: number of images", "1 or more", 0);
    std::mutex mutex;
    std::size_t done = 0;
    const auto tell = [&](std::string_view stage) {
        if (!options.progress) return;
        const std::lock_guard lock(mutex);
        options.progress(stage, ++done, count);
    };

    // Look at all images once: are they good, and how large are the objects?
    std::vector<std::vector<std::pair<std::size_t, double>>> class_and_size(count);
    parallel_for(count, options.threads, [&](std::size_t i) {
        const TrainingImage image = source(i);
        detail::check_training_image(image, class_names.size());
        for (const LabelledObject& object : image.objects)
            class_and_size[i].emplace_back(object.class_index, std::sqrt(object.box.area()));
        tell("looking at images");
    });
    std::vector<double> sizes_px;
    std::vector<std::size_t> objects_of(class_names.size(), 0), features_of(class_names.size(), 0);
    for (const auto& image : class_and_size)
        for (const auto& [c, size_px] : image) {
            sizes_px.push_back(size_px);
            ++objects_of[c];
        }
    for (std::size_t c = 0; c < class_names.size(); ++c)
        expect(objects_of[c] > 0, join_text("training: objects of class ", class_names[c]), "1 or more", 0);

    Harvest<D, Desc> all{.extractor = extractor,
                         .class_names = {class_names.begin(), class_names.end()},
                         .objects = {},
                         .first_object = {0},
                         .seen = {},
                         .descriptors = {}};
    if (options.choose_upsampling) all.extractor.options.upsampling *= detail::choose_upsampling(sizes_px);

    const std::size_t most_an_object = std::max<std::size_t>(30, options.max_features / sizes_px.size());
    done = 0;
    std::vector<Harvest<D, Desc>> parts(count);
    parallel_for(count, options.threads, [&](std::size_t i) {
        if (!class_and_size[i].empty())
            parts[i] = detail::harvest_image(source(i), all.extractor, most_an_object);
        tell("extracting features");
    });
    for (Harvest<D, Desc>& part : parts) {
        for (std::size_t i = 0; i < part.seen.size(); ++i) {
            Occurrence occurrence = part.seen[i];
            occurrence.object += static_cast<std::uint32_t>(all.objects.size());
            occurrence.feature = static_cast<std::uint32_t>(all.seen.size());
            ++features_of[occurrence.class_index];
            all.seen.push_back(occurrence);
            all.descriptors.push_back(part.descriptors.row(i));
        }
        std::move(part.objects.begin(), part.objects.end(), std::back_inserter(all.objects));
        all.first_object.push_back(static_cast<std::uint32_t>(all.objects.size()));
        part = {};
    }
    for (std::size_t c = 0; c < class_names.size(); ++c)
        expect(features_of[c] > 0, join_text("training: features on objects of class ", class_names[c]),
               "1 or more", 0);
    return all;
}

}  // namespace ism
