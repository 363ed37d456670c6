// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "extractors.hpp"
#include "learning.hpp"
#include "spaces.hpp"

#include "ism/core/thread_pool.hpp"
#include "ism/dataset/coco.hpp"
#include "ism/dataset/read_images.hpp"

namespace bench {

/// @brief The features that `ism train` learns from by default.
/// @param features  with pixels templates can be learnt from them
[[nodiscard]] inline ism::TrainingFeatures features_as_program(const ism::Dataset& set, unsigned threads,
                                                               const ism::TrainingFeatureOptions& features = {
                                                                   .pixels = true}) {
    return program::extract_training_features(
        set.class_names, ism::training_set(set),
        {program::make_extractor(program::default_detector, program::default_descriptor)},
        {.features = features, .threads = threads});
}

/// @brief What `ism train` learns from colour images with its defaults.
[[nodiscard]] inline ism::Model learn_as_program(const ism::Dataset& set, unsigned threads) {
    const ism::TrainingFeatures features = features_as_program(set, threads);
    const ism::TrainOptions options{.threads = threads};
    return program::learn_templates(program::learn(features, options), features, options);
}

/// @brief What figures are told for: test.json of a set's folder, or val.json, with the classes of a model.
[[nodiscard]] inline ism::Dataset held_out(const std::filesystem::path& folder,
                                           const std::vector<std::string>& class_names) {
    const bool has_test = std::filesystem::exists(folder / "test.json");
    return ism::select_classes(ism::read_dataset(folder / (has_test ? "test.json" : "val.json")),
                               class_names);
}

/// @brief Votes judged by the words in their boxes, or by nothing ("none"): a search without templates.
[[nodiscard]] inline program::SearchOptions votes_in(std::string_view space,
                                                     std::string_view rescorer = "boxes") {
    program::SearchOptions search;
    search.space = space, search.rescorer = rescorer, search.verifier = "mdl", search.segmenter = "patches";
    return search;
}

/// @brief A search with templates that tells every hypothesis.
[[nodiscard]] inline program::SearchOptions all_by_templates() {
    program::SearchOptions search;
    search.space = "jism", search.rescorer = "template", search.min_score = 0;
    return search;
}

/// @brief Searches all images of a set, shared out among threads.
[[nodiscard]] inline std::vector<ism::Detections> find_as_program(const ism::Model& model,
                                                                  const ism::Dataset& set,
                                                                  const program::SearchOptions& search,
                                                                  unsigned threads) {
    std::vector<ism::Detections> found(set.images.size());
    ism::parallel_for(set.images.size(), threads, [&](std::size_t i) {
        ism::ThreadPool one(1);
        found[i] = program::Matcher(model, one).find(ism::read_frame(set.images[i]), search);
    });
    return found;
}

}  // namespace bench
