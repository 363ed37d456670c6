// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ism/model/model.hpp"
#include "ism/train/grow_appearance.hpp"
#include "ism/train/grow_model.hpp"
#include "ism/train/harvest.hpp"
#include "ism/train/learn_appearance.hpp"
#include "ism/train/remembered_boxes.hpp"
#include "ism/train/training_image.hpp"

namespace ism {

/// @brief How classes are added.
struct AddOptions {
    std::size_t max_features = 40000;          ///< of the new objects together; see HarvestOptions
    std::size_t min_cluster_size = 2;          ///< see GrowOptions
    std::size_t max_cluster_features = 30000;  ///< see GrowOptions
    std::uint64_t seed = 1;                    ///< see GrowOptions
    bool appearance = true;                    ///< also learn to judge boxes of the new classes
    unsigned threads = 0;                      ///< 0 = all the machine has
    Progress progress = {};
};

/// @brief Teaches a model the classes of `count` more images, or more examples of classes it has (the same
/// names), without the images it was trained with: see grow_model(). The model's way to find and describe
/// features stays, its upsampling too, so that objects should be about as large in pixels as the first ones.
/// A model that was trained with TrainOptions::memory loses little against training with all images at once,
/// one without loses more. The judges of boxes of present classes stay as they are; those of new classes are
/// learnt from the new images and from what the model remembers of all its objects. Who has all images at
/// hand can learn all judges again by learn_appearance(): the model's objects are those of before, then those
/// of the new images.
/// @param class_names  names of the classes that LabelledObject::class_index points to
/// @throws Error as harvest() and grow_model() do.
template <Detector D, Descriptor Desc, TrainingSource Source>
[[nodiscard]] Model<D, Desc> add_classes(const Model<D, Desc>& model,
                                         std::span<const std::string> class_names, std::size_t count,
                                         const Source& source, const AddOptions& options = {}) {
    const HarvestOptions harvesting{.max_features = options.max_features,
                                    .choose_upsampling = false,
                                    .threads = options.threads,
                                    .progress = options.progress};
    const auto added = harvest(class_names, count, source, model.extractor, harvesting);
    auto [grown, word_now, class_now] = grow_model(model, added,
                                                   {.min_cluster_size = options.min_cluster_size,
                                                    .max_cluster_features = options.max_cluster_features,
                                                    .seed = options.seed,
                                                    .threads = options.threads});
    if (!options.appearance || model.shapes.appearance.empty()) return std::move(grown);

    const std::size_t words = grown.codebook.size(), classes = grown.shapes.class_names.size();
    grown.shapes.appearance = moved_appearance(model.shapes.appearance, word_now, words);
    if (classes == model.shapes.class_names.size()) return std::move(grown);
    const std::size_t known = model.shapes.objects.size();
    std::vector<std::uint32_t> first_object = added.first_object;
    for (std::uint32_t& first : first_object) first += static_cast<std::uint32_t>(known);
    const auto renamed = [&source, &now = class_now](std::size_t i) {
        TrainingImage image = source(i);
        for (LabelledObject& object : image.objects) object.class_index = now[object.class_index];
        return image;
    };
    auto samples =
        detail::appearance_samples(grown, first_object, renamed, {}, options.threads, options.progress);
    auto remembered = remembered_boxes(grown.shapes);
    std::move(remembered.begin(), remembered.end(), std::back_inserter(samples));
    grown.shapes.appearance = with_new_judges(std::move(grown.shapes.appearance), std::move(samples), words,
                                              classes, {}, options.threads);
    return std::move(grown);
}

/// @brief Teaches a model the classes of images in memory.
template <Detector D, Descriptor Desc>
[[nodiscard]] Model<D, Desc> add_classes(const Model<D, Desc>& model,
                                         std::span<const std::string> class_names,
                                         std::span<const TrainingImage> images,
                                         const AddOptions& options = {}) {
    const auto source = [&](std::size_t i) -> const TrainingImage& { return images[i]; };
    return add_classes(model, class_names, images.size(), source, options);
}

}  // namespace ism
