// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ism/dataset/coco.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/detect/detect.hpp"
#include "ism/detect/proposals.hpp"
#include "ism/detect/template_score.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"
#include "ism/train/extract_training_features.hpp"
#include "ism/train/learn.hpp"
#include "ism/train/learn_templates.hpp"

namespace bench {

/// @brief What `ism train` learns with its defaults.
using ProgramModel = ism::TypedModel<ism::HessianLaplace, ism::RootSift>;

[[nodiscard]] inline ProgramModel learn_as_program(const ism::Dataset& set, unsigned threads,
                                                   const ism::TemplateOptions& templates = {}) {
    ism::TrainOptions options;
    options.threads = threads, options.features.pixels = true;
    const auto features = ism::extract_training_features(
        set.class_names, ism::training_set(set), {ism::Extractor<ism::HessianLaplace, ism::RootSift>{}},
        options.features, threads);
    return ProgramModel(ism::learn_templates(ism::learn(features, options), features, templates, threads));
}

/// @brief What figures are told for: test.json of a set's folder, or val.json, with the classes of a model.
[[nodiscard]] inline ism::Dataset held_out(const std::filesystem::path& folder,
                                           const std::vector<std::string>& class_names) {
    const bool has_test = std::filesystem::exists(folder / "test.json");
    return ism::select_classes(ism::read_dataset(folder / (has_test ? "test.json" : "val.json")),
                               class_names);
}

/// @brief How `ism detect` searches with templates by its defaults.
template <ism::Rescorer R = ism::TemplateScore>
using ProgramRecognition =
    ism::Recognition<ism::Jism, ism::EpanechnikovKernel, R, ism::PatchSegmenter, ism::NonMaximumSuppression>;

template <ism::Rescorer R = ism::TemplateScore>
[[nodiscard]] ProgramRecognition<R> recognition_of_program(R rescorer = {}) {
    return {.options = ism::proposal_options(),
            .bandwidth = ism::proposal_bandwidth<ism::Jism>(),
            .rescorer = rescorer,
            .verifier = {.max_inside = 0.5, .across_classes = false}};
}

}  // namespace bench
