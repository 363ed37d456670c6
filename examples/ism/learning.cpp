// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "learning.hpp"

#include <utility>

#include "extractors.hpp"

#include "ism/train/extract_training_features.hpp"
#include "ism/train/learn.hpp"
#include "ism/train/learn_exemplars.hpp"
#include "ism/train/learn_mask_judge.hpp"
#include "ism/train/learn_metric.hpp"
#include "ism/train/learn_templates.hpp"
#include "ism/train/masks_from_boxes.hpp"
#include "ism/train/metric_extractor.hpp"
#include "ism/train/orientation.hpp"

namespace program {

ism::TrainingFeatures extract_training_features(std::span<const std::string> class_names,
                                                const ism::TrainingSet& set,
                                                const std::vector<ism::AnyExtractor>& extractors,
                                                const ism::TrainOptions& options) {
    return ism::extract_training_features(class_names, set, extractors, options.features, options.threads,
                                          options.progress);
}

ism::SharedFeatures shared_features(std::span<const std::string> class_names, const ism::TrainingSet& set,
                                    const std::vector<ism::AnyExtractor>& extractors, unsigned threads) {
    return ism::shared_features(class_names, set, extractors, threads);
}

ism::Model learn(const ism::TrainingFeatures& features, const ism::TrainOptions& options) {
    return ism::learn(features, options);
}

ism::Model learn_templates(ism::Model model, const ism::TrainingFeatures& features,
                           const ism::TrainOptions& options) {
    return learn_templates(std::move(model), features, options, {});
}

ism::Model learn_templates(ism::Model model, const ism::TrainingFeatures& features,
                           const ism::TrainOptions& options, const ism::TemplateOptions& templates) {
    model = ism::masks_from_boxes(std::move(model), features, options.threads, options.progress);
    model = ism::learn_exemplars(std::move(model), features, 300, options.threads);
    return ism::learn_templates(std::move(model), features, templates, options.threads, options.progress);
}

ism::Model learn_rgbd(std::span<const std::string> class_names, const ism::TrainingSet& set,
                      const ism::TrainOptions& options) {
    const ism::TrainingFeatures features = ism::extract_training_features(
        class_names, set, {make_extractor(ism::settings_of(ism::metric_extractor()))},
        {.max_features = options.features.max_features,
         .choose_upsampling = false,
         .pixels = true,
         .depth = true},
        options.threads, options.progress);
    return ism::learn_mask_judge(ism::learn_metric(features, {}, options.threads), features, {},
                                 options.threads, options.progress);
}

}  // namespace program
