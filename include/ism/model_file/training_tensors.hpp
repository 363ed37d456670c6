// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ism/core/lists.hpp"
#include "ism/io/paths.hpp"
#include "ism/model_file/shape_tensors.hpp"
#include "ism/model_file/tensor.hpp"
#include "ism/train/training_features.hpp"

/// Training features as tensors beside a model, which has their classes, objects and settings.
namespace ism::detail {

/// Descriptors in bytes, with what 0 and a step of 1 stand for: a quarter of the memory, and right to half a
/// step. Those on objects, which words are made of, are kept as they are.
inline void descriptors_to_bytes(std::span<const float> numbers, std::size_t dimension,
                                 const std::string& name, TensorFile& file) {
    float low = 0, high = 0;
    if (!numbers.empty()) {
        const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
        low = *least, high = *most;
    }
    const float step = high > low ? (high - low) / 255 : 1;
    std::vector<std::uint8_t> bytes;
    bytes.reserve(numbers.size());
    for (const float number : numbers)
        bytes.push_back(static_cast<std::uint8_t>((number - low) / step + 0.5f));
    file.tensors[name] = make_tensor<std::uint8_t>(bytes, {numbers.size() / dimension, dimension});
    const std::vector<float> range{low, step};
    file.tensors[name + "_range"] = make_tensor<float>(range, {2});
}

[[nodiscard]] inline Descriptors<float> descriptors_from_bytes(const TensorFile& file,
                                                               const std::string& name, std::size_t count,
                                                               std::size_t dimension) {
    const auto bytes = values<std::uint8_t>(file, name, {count, dimension});
    const auto range = values<float>(file, name + "_range", {2});
    expect<FileError>(std::isfinite(range[0]) && std::isfinite(range[1] * 255),
                      lazy_text(file.source, ": ", name), "a finite range",
                      lazy_text(range[0], ", ", range[1]));
    Descriptors<float> descriptors(dimension, count);
    std::transform(bytes.begin(), bytes.end(), descriptors.values().begin(),
                   [&](std::uint8_t byte) { return range[0] + range[1] * float(byte); });
    return descriptors;
}

inline void features_to_tensor(std::span<const Feature> features, const std::string& name, TensorFile& file) {
    std::vector<float> numbers;
    for (const auto& [x, y, scale, angle, strength, depth_m] : features)
        numbers.insert(numbers.end(), {x, y, scale, angle, strength, depth_m});
    file.tensors[name] = make_tensor<float>(numbers, {features.size(), 6});
}

[[nodiscard]] inline std::vector<Feature> features_from_tensor(const TensorFile& file,
                                                               const std::string& name) {
    const auto numbers = values<float>(file, name, {any_length, 6});
    std::vector<Feature> features;
    for (std::size_t i = 0; i < numbers.size(); i += 6) {
        const Feature f{numbers[i],     numbers[i + 1], numbers[i + 2],
                        numbers[i + 3], numbers[i + 4], numbers[i + 5]};
        expect<FileError>(std::abs(f.x) <= 1e7f && std::abs(f.y) <= 1e7f && f.scale >= 1e-6f &&
                              f.scale <= 1e7f && std::abs(f.angle) <= 100,
                          lazy_text(file.source, ": ", name), "places within 1e7 px, scales above 0",
                          lazy_text(f.x, ", ", f.y, ", ", f.scale, ", ", f.angle));
        features.push_back(f);
    }
    return features;
}

/// What channel number c has of objects, and of all features of images.
inline void channel_to_tensors(const TrainingFeatures& all, std::size_t c, TensorFile& file) {
    const TrainingSamples& samples = all.samples[c];
    const std::size_t dimension = samples.descriptors.dimension();
    const std::string prefix = join_text("training_", c, "_");
    occurrences_to_tensors(samples.occurrences, prefix, file);
    file.tensors[prefix + "descriptors"] =
        make_tensor<float>(samples.descriptors.values(), {samples.descriptors.size(), dimension});
    std::vector<Feature> features;
    std::vector<float> descriptors;
    std::vector<std::uint32_t> offsets = {0};
    for (const TrainingView& view : all.views) {
        append(features, view.channels[c].features);
        const auto& rows = view.channels[c].descriptors.values();
        descriptors.insert(descriptors.end(), rows.begin(), rows.end());
        offsets.push_back(static_cast<std::uint32_t>(features.size()));
    }
    features_to_tensor(features, prefix + "view_features", file);
    descriptors_to_bytes(descriptors, dimension, prefix + "view_descriptors", file);
    file.tensors[prefix + "view_offsets"] = offsets_tensor(offsets);
}

/// Labels of images, and what is ignored in them.
inline void labels_to_tensors(std::span<const TrainingView> views, TensorFile& file) {
    std::vector<std::uint32_t> classes, offsets = {0}, ignored_offsets = {0};
    std::vector<std::uint8_t> masked;
    std::vector<double> boxes, ignored;
    const auto add_box = [](const Box& box, std::vector<double>& to) {
        to.insert(to.end(), {box.x, box.y, box.width, box.height});
    };
    for (const TrainingView& view : views) {
        for (const ObjectLabel& label : view.labels) {
            classes.push_back(label.class_index);
            masked.push_back(label.masked);
            add_box(label.box, boxes);
        }
        for (const Box& region : view.ignored) add_box(region, ignored);
        offsets.push_back(static_cast<std::uint32_t>(classes.size()));
        ignored_offsets.push_back(static_cast<std::uint32_t>(ignored.size() / 4));
    }
    file.tensors["training_labels"] = make_tensor<std::uint32_t>(classes, {classes.size()});
    file.tensors["training_boxes"] = make_tensor<double>(boxes, {classes.size(), 4});
    file.tensors["training_masked"] = make_tensor<std::uint8_t>(masked, {masked.size()});
    file.tensors["training_label_offsets"] = offsets_tensor(offsets);
    if (ignored.empty()) return;
    file.tensors["training_ignored"] = make_tensor<double>(ignored, {ignored.size() / 4, 4});
    file.tensors["training_ignored_offsets"] = offsets_tensor(ignored_offsets);
}

inline void training_to_tensors(const TrainingFeatures& all, TensorFile& file) {
    // A member that is added to TrainingFeatures does not compile here until it is kept too, or is known to
    // be in the model.
    [[maybe_unused]] const auto& [class_names, category_ids, objects, settings, samples, views, summary] =
        all;
    for (std::size_t c = 0; c < samples.size(); ++c) channel_to_tensors(all, c, file);
    labels_to_tensors(views, file);
    std::vector<std::uint32_t> sides, with_pixels;
    std::vector<std::uint8_t> pixels;
    for (const TrainingView& view : views) {
        sides.insert(sides.end(), {std::uint32_t(view.width), std::uint32_t(view.height), view.first_object,
                                   view.end_object, std::uint32_t(view.mirrored)});
        with_pixels.push_back(!view.pixels.empty());
        for (const Rgb c : view.pixels.pixels()) pixels.insert(pixels.end(), {c.r, c.g, c.b});
    }
    file.tensors["training_views"] = make_tensor<std::uint32_t>(sides, {views.size(), 5});
    file.tensors["training_with_pixels"] = make_tensor<std::uint32_t>(with_pixels, {views.size()});
    file.tensors["training_pixels"] = make_tensor<std::uint8_t>(pixels, {pixels.size() / 3, 3});
}

/// The images, with neither labels nor pixels nor features.
[[nodiscard]] inline std::vector<TrainingView> views_from_tensors(const TensorFile& file,
                                                                  std::size_t objects) {
    const auto numbers = values<std::uint32_t>(file, "training_views", {any_length, 5});
    std::vector<TrainingView> views;
    for (std::size_t i = 0; i < numbers.size(); i += 5) {
        const std::uint32_t width = numbers[i], height = numbers[i + 1], first = numbers[i + 2],
                            end = numbers[i + 3];
        expect<FileError>(is_image_size(width, height), lazy_text(file.source, ": size of an image"),
                          image_size_limits, lazy_text(width, "x", height));
        expect<FileError>(first <= end && end <= objects, lazy_text(file.source, ": objects of an image"),
                          lazy_text("up to ", objects), lazy_text(first, " to ", end));
        views.push_back({.width = int(width),
                         .height = int(height),
                         .first_object = first,
                         .end_object = end,
                         .mirrored = numbers[i + 4] != 0});
    }
    return views;
}

/// Adds labels to images, and what is ignored in them.
inline void labels_from_tensors(const TensorFile& file, std::size_t classes,
                                std::vector<TrainingView>& views) {
    const auto labels = values<std::uint32_t>(file, "training_labels", {any_length});
    const auto boxes = values<double>(file, "training_boxes", {labels.size(), 4});
    const auto offsets = offsets_from_tensor(file, "training_label_offsets", views.size(), labels.size());
    const bool tells_masks = file.tensors.contains("training_masked");
    const auto masked = tells_masks ? values<std::uint8_t>(file, "training_masked", {labels.size()})
                                    : std::span<const std::uint8_t>();
    std::span<const double> ignored;
    std::vector<std::uint32_t> ignored_offsets(views.size() + 1, 0);
    if (file.tensors.contains("training_ignored")) {
        ignored = values<double>(file, "training_ignored", {any_length, 4});
        ignored_offsets =
            offsets_from_tensor(file, "training_ignored_offsets", views.size(), ignored.size() / 4);
    }
    const auto box_at = [](std::span<const double> numbers, std::size_t i) {
        return Box{numbers[4 * i], numbers[4 * i + 1], numbers[4 * i + 2], numbers[4 * i + 3]};
    };
    for (std::size_t v = 0; v < views.size(); ++v) {
        TrainingView& view = views[v];
        at_place(join_text(file.source, ", image ", v), [&] {
            for (std::size_t i = offsets[v]; i < offsets[v + 1]; ++i) {
                view.labels.push_back({labels[i], box_at(boxes, i), tells_masks && masked[i] != 0});
                check(view.labels.back(), classes, view.width, view.height);
            }
            for (std::size_t i = ignored_offsets[v]; i < ignored_offsets[v + 1]; ++i) {
                view.ignored.push_back(box_at(ignored, i));
                check_labelled_box(view.ignored.back(), view.width, view.height);
            }
        });
    }
}

/// Adds the pixels of those images that have any.
inline void pixels_from_tensors(const TensorFile& file, std::vector<TrainingView>& views) {
    const auto with_pixels = values<std::uint32_t>(file, "training_with_pixels", {views.size()});
    const auto pixels = values<std::uint8_t>(file, "training_pixels", {any_length, 3});
    std::size_t next = 0;
    for (std::size_t v = 0; v < views.size(); ++v) {
        if (with_pixels[v] == 0) continue;
        TrainingView& view = views[v];
        const std::size_t count = std::size_t(view.width) * std::size_t(view.height);
        expect<FileError>(next + count <= pixels.size() / 3, lazy_text(file.source, ": training_pixels"),
                          lazy_text(next + count, " or more"), pixels.size() / 3);
        view.pixels = RgbImage(view.width, view.height);
        for (Rgb& c : view.pixels.pixels()) {
            c = {pixels[3 * next], pixels[3 * next + 1], pixels[3 * next + 2]};
            ++next;
        }
    }
}

/// What channel number c has of objects.
/// @param first_feature  of the channel; those of all channels are counted together
[[nodiscard]] inline TrainingSamples samples_from_tensors(const TensorFile& file, std::size_t c,
                                                          std::size_t dimension,
                                                          std::span<const TrainingObject> objects,
                                                          std::size_t first_feature) {
    const std::string prefix = join_text("training_", c, "_");
    TrainingSamples samples{occurrences_from_tensors(file, prefix, objects), Descriptors<float>(dimension)};
    for (const Occurrence& o : samples.occurrences)
        expect<FileError>(o.feature == first_feature++, lazy_text(file.source, ": training features"),
                          "numbers that count up", o.feature);
    const auto numbers = values<float>(file, prefix + "descriptors", {samples.occurrences.size(), dimension});
    for (const float number : numbers)
        expect<FileError>(std::isfinite(number), lazy_text(file.source, ": descriptors"), "finite numbers",
                          number);
    samples.descriptors = Descriptors<float>(dimension, std::vector<float>(numbers.begin(), numbers.end()));
    return samples;
}

/// Adds to each image all its features of channel number c.
inline void features_from_tensors(const TensorFile& file, std::size_t c, std::size_t dimension,
                                  std::vector<TrainingView>& views) {
    const std::string prefix = join_text("training_", c, "_");
    const std::vector<Feature> features = features_from_tensor(file, prefix + "view_features");
    const auto descriptors =
        descriptors_from_bytes(file, prefix + "view_descriptors", features.size(), dimension);
    const auto first = offsets_from_tensor(file, prefix + "view_offsets", views.size(), features.size());
    for (std::size_t v = 0; v < views.size(); ++v) {
        FeatureSet<float> set{{features.begin() + first[v], features.begin() + first[v + 1]},
                              Descriptors<float>(dimension)};
        for (std::size_t i = first[v]; i < first[v + 1]; ++i) set.descriptors.push_back(descriptors.row(i));
        views[v].channels.push_back(std::move(set));
    }
}

/// @param model  of the same file
[[nodiscard]] inline TrainingFeatures training_from_tensors(const TensorFile& file, const Model& model) {
    if (!file.tensors.contains("training_views"))
        throw FileError(file.source +
                        ": expected a model with training features, got one without (train with "
                        "--growable)");
    TrainingFeatures all{.class_names = model.shapes.class_names,
                         .category_ids = model.shapes.category_ids,
                         .objects = model.shapes.objects,
                         .views = views_from_tensors(file, model.shapes.objects.size()),
                         .summary = model.training};
    labels_from_tensors(file, all.class_names.size(), all.views);
    pixels_from_tensors(file, all.views);
    std::size_t features = 0;
    for (std::size_t c = 0; c < model.channels.size(); ++c) {
        const FeatureSettings& settings = model.channels[c].features;
        all.settings.push_back(settings);
        all.samples.push_back(samples_from_tensors(file, c, settings.dimension, all.objects, features));
        features += all.samples.back().occurrences.size();
        features_from_tensors(file, c, settings.dimension, all.views);
    }
    return all;
}

}  // namespace ism::detail
