// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "ism/feature/any_extractor.hpp"
#include "ism/model/model.hpp"
#include "ism/train/extract_training_features.hpp"
#include "ism/train/learn.hpp"
#include "ism/train/train_options.hpp"
#include "ism/train/training_set.hpp"

namespace ism {

/// @brief Learns a model from labelled images: extract_training_features(), then learn(). Background images
/// are allowed.
/// @tparam Space      as of learn()
/// @param class_names  names of the classes that labels point to
/// @throws Error where an image cannot be learnt from, a class has no object or no feature, an option is out
/// of range, or no word is left.
template <Detector D, Descriptor Desc, ImageVoteSpace Space = Jism>
[[nodiscard]] TypedModel<D, Desc> train(std::span<const std::string> class_names, const TrainingSet& set,
                                        const TrainOptions& options = {},
                                        const Extractor<D, Desc>& extractor = {}) {
    check(options);
    TrainingFeatureOptions collecting = options.features;
    collecting.views = collecting.views && (options.box_classifier || options.calibrate);
    return TypedModel<D, Desc>(
        learn<Space>(extract_training_features(class_names, set, {AnyExtractor(extractor)}, collecting,
                                               options.threads, options.progress),
                     options));
}

/// @brief Learns a model from images in memory.
template <Detector D, Descriptor Desc, ImageVoteSpace Space = Jism>
[[nodiscard]] TypedModel<D, Desc> train(std::span<const std::string> class_names,
                                        std::span<const TrainingImage> images,
                                        const TrainOptions& options = {},
                                        const Extractor<D, Desc>& extractor = {}) {
    return train<D, Desc, Space>(class_names, training_set(images), options, extractor);
}

}  // namespace ism
