// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "learning.hpp"
#include "spaces.hpp"

#include "ism/dataset/dataset.hpp"

namespace bench {

/// @brief The features that `ism train` learns from by default.
/// @param features  with pixels templates can be learnt from them
[[nodiscard]] ism::TrainingFeatures features_as_program(const ism::Dataset& set, unsigned threads,
                                                        const ism::TrainingFeatureOptions& features = {
                                                            .pixels = true});

/// @brief What `ism train` learns from colour images with its defaults.
[[nodiscard]] ism::Model learn_as_program(const ism::Dataset& set, unsigned threads);

/// @brief Votes judged by the words in their boxes, or by nothing ("none"): a search without templates.
[[nodiscard]] program::SearchOptions votes_in(std::string_view space, std::string_view rescorer = "boxes");

/// @brief A search with templates that tells every hypothesis.
[[nodiscard]] program::SearchOptions all_by_templates();

/// @brief Searches all images of a set, shared out among threads.
[[nodiscard]] std::vector<ism::Detections> find_as_program(const ism::Model& model, const ism::Dataset& set,
                                                           const program::SearchOptions& search,
                                                           unsigned threads);

}  // namespace bench
