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

inline void training_to_tensors(const TrainingFeatures& all, TensorFile& file) {
    // A member that is added to TrainingFeatures does not compile here until it is kept too, or is known to
    // be in the model.
    [[maybe_unused]] const auto& [class_names, category_ids, objects, settings, samples, views, summary] =
        all;
    for (std::size_t c = 0; c < samples.size(); ++c) {
        const std::string prefix = join_text("training_", c, "_");
        occurrences_to_tensors(samples[c].occurrences, prefix, file);
        file.tensors[prefix + "descriptors"] =
            make_tensor<float>(samples[c].descriptors.values(),
                               {samples[c].descriptors.size(), samples[c].descriptors.dimension()});
        std::vector<Feature> features;
        std::vector<float> descriptors;
        std::vector<std::uint32_t> offsets = {0};
        for (const TrainingView& view : views) {
            const auto& channel = view.channels[c];
            features.insert(features.end(), channel.features.begin(), channel.features.end());
            descriptors.insert(descriptors.end(), channel.descriptors.values().begin(),
                               channel.descriptors.values().end());
            offsets.push_back(static_cast<std::uint32_t>(features.size()));
        }
        features_to_tensor(features, prefix + "view_features", file);
        descriptors_to_bytes(descriptors, samples[c].descriptors.dimension(), prefix + "view_descriptors",
                             file);
        file.tensors[prefix + "view_offsets"] = offsets_tensor(offsets);
    }
    std::vector<std::uint32_t> sides, classes, offsets = {0};
    std::vector<std::uint8_t> masked;
    std::vector<double> boxes, ignored;
    std::vector<std::uint32_t> ignored_offsets = {0};
    const auto add_box = [](const Box& box, std::vector<double>& to) {
        to.insert(to.end(), {box.x, box.y, box.width, box.height});
    };
    for (const TrainingView& view : views) {
        sides.insert(sides.end(), {std::uint32_t(view.width), std::uint32_t(view.height), view.first_object,
                                   view.end_object, std::uint32_t(view.mirrored)});
        for (const ObjectLabel& label : view.labels) {
            classes.push_back(label.class_index);
            masked.push_back(label.masked);
            add_box(label.box, boxes);
        }
        for (const Box& region : view.ignored) add_box(region, ignored);
        offsets.push_back(static_cast<std::uint32_t>(classes.size()));
        ignored_offsets.push_back(static_cast<std::uint32_t>(ignored.size() / 4));
    }
    std::vector<std::uint8_t> pixels;
    std::vector<std::uint32_t> with_pixels;
    for (const TrainingView& view : views) {
        with_pixels.push_back(!view.pixels.empty());
        for (const Rgb c : view.pixels.pixels()) pixels.insert(pixels.end(), {c.r, c.g, c.b});
    }
    file.tensors["training_pixels"] = make_tensor<std::uint8_t>(pixels, {pixels.size() / 3, 3});
    file.tensors["training_with_pixels"] = make_tensor<std::uint32_t>(with_pixels, {views.size()});
    file.tensors["training_views"] = make_tensor<std::uint32_t>(sides, {views.size(), 5});
    file.tensors["training_labels"] = make_tensor<std::uint32_t>(classes, {classes.size()});
    file.tensors["training_boxes"] = make_tensor<double>(boxes, {classes.size(), 4});
    file.tensors["training_masked"] = make_tensor<std::uint8_t>(masked, {masked.size()});
    file.tensors["training_label_offsets"] = offsets_tensor(offsets);
    if (ignored.empty()) return;
    file.tensors["training_ignored"] = make_tensor<double>(ignored, {ignored.size() / 4, 4});
    file.tensors["training_ignored_offsets"] = offsets_tensor(ignored_offsets);
}

/// @param model  of the same file
[[nodiscard]] inline TrainingFeatures training_from_tensors(const TensorFile& file, const Model& model) {
    if (!file.tensors.contains("training_views"))
        throw FileError(file.source +
                        ": expected a model with training features, got one without (train with "
                        "--growable)");
    TrainingFeatures all{.class_names = model.shapes.class_names,
                         .category_ids = model.shapes.category_ids,
                         .objects = model.shapes.objects};
    all.summary = model.training;
    const std::size_t classes = all.class_names.size();
    const auto sides = values<std::uint32_t>(file, "training_views", {any_length, 5});
    const std::size_t views = sides.size() / 5;
    const auto labels = values<std::uint32_t>(file, "training_labels", {any_length});
    const auto boxes = values<double>(file, "training_boxes", {labels.size(), 4});
    const bool tells_masks = file.tensors.contains("training_masked");
    const auto masked = tells_masks ? values<std::uint8_t>(file, "training_masked", {labels.size()})
                                    : std::span<const std::uint8_t>();
    const auto offsets = offsets_from_tensor(file, "training_label_offsets", views, labels.size());
    const auto with_pixels = values<std::uint32_t>(file, "training_with_pixels", {views});
    const auto pixels = values<std::uint8_t>(file, "training_pixels", {any_length, 3});
    std::span<const double> ignored;
    std::vector<std::uint32_t> ignored_offsets(views + 1, 0);
    if (file.tensors.contains("training_ignored")) {
        ignored = values<double>(file, "training_ignored", {any_length, 4});
        ignored_offsets = offsets_from_tensor(file, "training_ignored_offsets", views, ignored.size() / 4);
    }
    const auto box_at = [](std::span<const double> numbers, std::size_t i) {
        return Box{numbers[4 * i], numbers[4 * i + 1], numbers[4 * i + 2], numbers[4 * i + 3]};
    };
    std::size_t next_pixel = 0;
    for (std::size_t v = 0; v < views; ++v) {
        const std::uint32_t* side = sides.data() + 5 * v;
        expect<FileError>(is_image_size(side[0], side[1]), lazy_text(file.source, ": size of an image"),
                          image_size_limits, lazy_text(side[0], "x", side[1]));
        expect<FileError>(side[2] <= side[3] && side[3] <= all.objects.size(),
                          lazy_text(file.source, ": objects of an image"),
                          lazy_text("up to ", all.objects.size()), lazy_text(side[2], " to ", side[3]));
        TrainingView view{.width = int(side[0]),
                          .height = int(side[1]),
                          .first_object = side[2],
                          .end_object = side[3],
                          .mirrored = side[4] != 0};
        for (std::size_t i = offsets[v]; i < offsets[v + 1]; ++i) {
            const ObjectLabel label{labels[i], box_at(boxes, i), tells_masks && masked[i] != 0};
            at_place(join_text(file.source, ", image ", v),
                     [&] { check(label, classes, view.width, view.height); });
            view.labels.push_back(label);
        }
        for (std::size_t i = ignored_offsets[v]; i < ignored_offsets[v + 1]; ++i) {
            at_place(join_text(file.source, ", image ", v),
                     [&] { check_labelled_box(box_at(ignored, i), view.width, view.height); });
            view.ignored.push_back(box_at(ignored, i));
        }
        if (with_pixels[v] != 0) {
            const std::size_t count = std::size_t(view.width) * std::size_t(view.height);
            expect<FileError>(next_pixel + count <= pixels.size() / 3,
                              lazy_text(file.source, ": training_pixels"),
                              lazy_text(next_pixel + count, " or more"), pixels.size() / 3);
            view.pixels = RgbImage(view.width, view.height);
            for (Rgb& c : view.pixels.pixels()) {
                c = {pixels[3 * next_pixel], pixels[3 * next_pixel + 1], pixels[3 * next_pixel + 2]};
                ++next_pixel;
            }
        }
        all.views.push_back(std::move(view));
    }
    std::uint32_t feature = 0;
    for (std::size_t c = 0; c < model.channels.size(); ++c) {
        const std::string prefix = join_text("training_", c, "_");
        all.settings.push_back(model.channels[c].features);
        const std::size_t dimension = all.settings[c].dimension;
        TrainingSamples samples{occurrences_from_tensors(file, prefix, all.objects),
                                Descriptors<float>(dimension)};
        const std::size_t count = samples.occurrences.size();
        for (const Occurrence& o : samples.occurrences)
            expect<FileError>(o.feature == feature++, lazy_text(file.source, ": training features"),
                              "numbers that count up", o.feature);
        const auto numbers = values<float>(file, prefix + "descriptors", {count, dimension});
        for (const float number : numbers)
            expect<FileError>(std::isfinite(number), lazy_text(file.source, ": descriptors"),
                              "finite numbers", number);
        samples.descriptors =
            Descriptors<float>(dimension, std::vector<float>(numbers.begin(), numbers.end()));
        all.samples.push_back(std::move(samples));

        const std::vector<Feature> features = features_from_tensor(file, prefix + "view_features");
        const auto descriptors =
            descriptors_from_bytes(file, prefix + "view_descriptors", features.size(), dimension);
        const auto first = offsets_from_tensor(file, prefix + "view_offsets", views, features.size());
        for (std::size_t v = 0; v < views; ++v) {
            FeatureSet<float> set{{features.begin() + first[v], features.begin() + first[v + 1]},
                                  Descriptors<float>(dimension)};
            for (std::size_t i = first[v]; i < first[v + 1]; ++i)
                set.descriptors.push_back(descriptors.row(i));
            all.views[v].channels.push_back(std::move(set));
        }
    }
    return all;
}

}  // namespace ism::detail
