// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ism/core/camera.hpp"
#include "ism/core/region_mask.hpp"
#include "ism/feature/feature.hpp"
#include "ism/feature/feature_settings.hpp"
#include "ism/model/model.hpp"
#include "ism/train/training_image.hpp"

namespace ism {

/// @brief Features on training objects: where on which object each was, and row i describes occurrence i.
/// Their weights mean nothing yet.
struct TrainingSamples {
    std::vector<Occurrence> occurrences;
    Descriptors<float> descriptors;
};

/// @brief What is kept of a training image with depth and camera.
struct TrainingDepth {
    DepthMap depth_m = {};
    Camera camera = {};
    std::vector<RegionMask> masks = {};                   ///< of the labelled objects
    std::vector<std::string> instances = {};              ///< theirs; empty texts where not known
    std::vector<std::optional<Point3>> positions_m = {};  ///< theirs, where labels tell them; empty = nowhere
};

/// @brief All features of a training image or of its mirror image, beside the objects too.
struct TrainingView {
    int width = 0, height = 0;  ///< of the image, pixels
    std::vector<ObjectLabel> labels = {};
    std::vector<Box> ignored = {};                   ///< TrainingImage::ignored
    std::uint32_t first_object = 0, end_object = 0;  ///< those of TrainingFeatures that the image shows
    bool mirrored = false;  ///< it shows the image of the view before as a mirror shows it
    std::vector<FeatureSet<float>> channels = {};
    RgbImage pixels = {};                     ///< of the image; empty = not kept
    std::optional<TrainingDepth> depth = {};  ///< where the image has depth and camera; none = not kept
};

/// @brief All that training takes from images: what learn() makes a model of, without them. It can be kept,
/// joined with that of other images, and learnt from again with other options.
struct TrainingFeatures {
    std::vector<std::string> class_names = {};
    std::vector<std::int64_t> category_ids = {};  ///< the file's number of each class; empty = not known
    std::vector<TrainingObject> objects = {};
    std::vector<FeatureSettings> settings =
        {};  ///< of each channel, with the upsampling chosen from the data
    std::vector<TrainingSamples> samples =
        {};                                ///< of each channel; features are numbered through all channels
    std::vector<TrainingView> views = {};  ///< image by image; empty = not kept
    TrainingSummary summary = {};

    /// @brief Number of features on objects, of all channels.
    [[nodiscard]] std::size_t feature_count() const {
        std::size_t count = 0;
        for (const TrainingSamples& channel : samples) count += channel.occurrences.size();
        return count;
    }
};

namespace detail {

/// Numbers the features through all channels.
inline void number_features(std::vector<TrainingSamples>& samples) {
    std::uint32_t feature = 0;
    for (TrainingSamples& channel : samples)
        for (Occurrence& o : channel.occurrences) o.feature = feature++;
}

/// @param what  is learnt, for the message
/// @throws Error where the model was not learnt from the features.
inline void expect_same_objects(const Model& model, const TrainingFeatures& features, const char* what) {
    expect(model.shapes.objects.size() == features.objects.size(), lazy_text(what, ": objects of the model"),
           features.objects.size(), model.shapes.objects.size());
}

/// Joins what images gave, in their order; classes are the same in all.
[[nodiscard]] inline TrainingFeatures join_images(TrainingFeatures all, std::vector<TrainingFeatures> parts) {
    for (TrainingFeatures& part : parts) {
        const auto objects = static_cast<std::uint32_t>(all.objects.size());
        for (std::size_t c = 0; c < part.samples.size(); ++c)
            for (std::size_t i = 0; i < part.samples[c].occurrences.size(); ++i) {
                Occurrence o = part.samples[c].occurrences[i];
                o.object += objects;
                all.samples[c].occurrences.push_back(o);
                all.samples[c].descriptors.push_back(part.samples[c].descriptors.row(i));
            }
        for (TrainingObject& object : part.objects) all.objects.push_back(std::move(object));
        for (TrainingView& view : part.views) {
            view.first_object += objects, view.end_object += objects;
            all.views.push_back(std::move(view));
        }
        all.summary.images += part.summary.images;
        all.summary.features_found += part.summary.features_found;
        all.summary.features_used += part.summary.features_used;
        part = {};
    }
    number_features(all.samples);
    return all;
}

}  // namespace detail

}  // namespace ism
