// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "ism/codebook/word_index.hpp"
#include "ism/core/error.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/model/model.hpp"
#include "ism/train/depth_views.hpp"
#include "ism/train/training_features.hpp"
#include "ism/train/training_surface.hpp"
#include "ism/vote/placement.hpp"

namespace ism {

/// @brief How a model for votes in metres is learnt.
struct MetricOptions {
    std::size_t neighbours = 12;  ///< nearest training features that a feature votes through
};

namespace detail {

/// The features of a training image, each a word of its own.
struct MetricWords {
    std::vector<std::optional<Occurrence>> occurrences = {};  // none = background
    std::vector<OccurrenceFrame> frames = {};                 // of each feature
    std::vector<TrainingObject> objects = {};                 // those that the image shows
};

[[nodiscard]] inline MetricWords metric_words(const TrainingView& view, const TrainingFeatures& all) {
    ThreadPool pool(1);
    const TrainingDepth& depth = *view.depth;
    const Surface surface = surface_of(depth.depth_m, depth.camera, pool);
    const std::vector<Feature>& features = view.channels.front().features;
    MetricWords words;
    for (std::size_t i = 0; i < view.labels.size(); ++i)
        words.objects.push_back(
            with_points(all.objects[view.first_object + i], view.labels[i].box, depth.masks[i],
                        depth.positions_m.empty() ? std::nullopt : depth.positions_m[i], surface));
    const auto under = masks_under(features, depth.masks);
    for (std::size_t f = 0; f < features.size(); ++f) {
        words.occurrences.emplace_back();
        words.frames.emplace_back();
        if (!under[f]) continue;
        const ObjectLabel& label = view.labels[*under[f]];
        const TrainingObject& object = words.objects[*under[f]];
        Occurrence o = as_occurrence(features[f], upright_in(label.box));
        o.class_index = label.class_index;
        o.object = view.first_object + *under[f];
        o.depth_m = object.size_m > 0 ? features[f].depth_m - object.centre_m.z : no_depth;
        words.occurrences.back() = o;
        const auto frame = local_frame(surface, features[f].x, features[f].y, features[f].angle);
        if (frame && object.size_m > 0)
            words.frames.back() = occurrence_frame(features[f], *frame, object, depth.camera);
    }
    return words;
}

}  // namespace detail

/// @brief Learns a model whose words are the training features themselves, those beside objects as words of
/// background: features vote through the nearest of them, in the space Metric by their local frames. Learnt
/// from training features of one channel with TrainingFeatureOptions::depth; images without depth or camera
/// are left out.
/// @throws Error where no image with depth and camera is left, or there are several channels.
[[nodiscard]] inline Model learn_metric(const TrainingFeatures& features, const MetricOptions& options = {},
                                        unsigned threads = 0) {
    expect(features.settings.size() == 1, "metric model: channels", 1, features.settings.size());
    const std::vector<const TrainingView*> views = depth_views(features).views;
    expect(options.neighbours >= 1 && options.neighbours <= 1000, "MetricOptions::neighbours", "1 ... 1000",
           options.neighbours);
    std::vector<detail::MetricWords> parts(views.size());
    parallel_for(views.size(), threads,
                 [&](std::size_t i) { parts[i] = detail::metric_words(*views[i], features); });

    Model model{
        .channels = {{features.settings[0], Codebook(features.settings[0].dimension, 2), options.neighbours}},
        .shapes = {.class_names = features.class_names,
                   .category_ids = features.category_ids,
                   .objects = features.objects},
        .training = features.summary};
    Codebook& codebook = model.channels[0].codebook;
    for (std::size_t i = 0; i < views.size(); ++i) {
        std::move(parts[i].objects.begin(), parts[i].objects.end(),
                  model.shapes.objects.begin() + views[i]->first_object);
        const Descriptors<float>& descriptors = views[i]->channels[0].descriptors;
        for (std::size_t f = 0; f < descriptors.size(); ++f) {
            codebook.push_back_descriptor(descriptors.row(f));
            std::vector<Occurrence> seen;
            if (parts[i].occurrences[f]) {
                seen.push_back(*parts[i].occurrences[f]);
                seen.back().feature = static_cast<std::uint32_t>(model.shapes.frames.size());
                model.shapes.frames.push_back(parts[i].frames[f]);
            }
            model.shapes.occurrences.push_back(seen);
        }
    }
    return model;
}

}  // namespace ism
