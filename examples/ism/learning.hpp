// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ism/feature/any_extractor.hpp"
#include "ism/train/train_options.hpp"
#include "ism/train/training_features.hpp"
#include "ism/train/training_set.hpp"

namespace ism {
struct SharedFeatures;
struct TemplateOptions;
}  // namespace ism

namespace program {

// What the library computes under these names (extract_training_features(), learn(), learn_templates() and
// with it masks_from_boxes() and learn_exemplars()), compiled once for all who ask for it.
[[nodiscard]] ism::TrainingFeatures extract_training_features(
    std::span<const std::string> class_names, const ism::TrainingSet& set,
    const std::vector<ism::AnyExtractor>& extractors, const ism::TrainOptions& options);
[[nodiscard]] ism::SharedFeatures shared_features(std::span<const std::string> class_names,
                                                  const ism::TrainingSet& set,
                                                  const std::vector<ism::AnyExtractor>& extractors,
                                                  unsigned threads);
[[nodiscard]] ism::Model learn(const ism::TrainingFeatures& features, const ism::TrainOptions& options);
[[nodiscard]] ism::Model learn_templates(ism::Model model, const ism::TrainingFeatures& features,
                                         const ism::TrainOptions& options);
[[nodiscard]] ism::Model learn_templates(ism::Model model, const ism::TrainingFeatures& features,
                                         const ism::TrainOptions& options,
                                         const ism::TemplateOptions& templates);
/// A model for frames with depth: extract_training_features() with metric_extractor(), learn_metric(),
/// learn_mask_judge().
[[nodiscard]] ism::Model learn_rgbd(std::span<const std::string> class_names, const ism::TrainingSet& set,
                                    const ism::TrainOptions& options);

}  // namespace program
