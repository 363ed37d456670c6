// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "toy_cars.hpp"

#include "ism/dataset/coco_results.hpp"
#include "ism/detect/detection.hpp"
#include "ism/evaluate/evaluate.hpp"
#include "ism/evaluate/voting_confidence.hpp"
#include "ism/model/model.hpp"
#include "ism/train/training_set.hpp"

namespace reproduce {

/// The vote spaces that are compared.
inline constexpr std::array<std::string_view, 6> depth_spaces = {"ism",    "jism",   "ji3sm1",
                                                                 "ji3sm2", "ji3sm3", "metric"};
inline constexpr std::size_t metric_index = 5;
/// … and the last of them with segments and the judge of masks.
inline constexpr std::size_t judged_index = 6, way_count = 7;
inline constexpr std::array<std::string_view, way_count> way_names = {
    "ism", "jism", "ji3sm1", "ji3sm2", "ji3sm3", "metric, votes", "metric, segments and judge"};

/// What the paper's spaces need, and what votes in metres need.
struct DepthModels {
    ism::Model words, metric;
};
[[nodiscard]] DepthModels learn_both(const std::vector<std::string>& class_names, const ism::TrainingSet& set,
                                     unsigned threads);

/// What the ways found in some pictures, way by way: results, and of each labelled object of a space how far
/// votes agree.
struct DepthOutcome {
    std::array<std::vector<ism::Result>, way_count> results;
    std::array<std::vector<ism::VotingConfidence>, depth_spaces.size()> confidence;
    std::array<double, way_count> ms{};  ///< a picture
};

/// Searches pictures in some of the ways.
/// @param ways          indices of way_names
/// @param with_reading  features without a depth reading are left out in every way
[[nodiscard]] DepthOutcome search_depth(const DepthModels& models, std::span<const Shot> shots,
                                        std::span<const std::size_t> ways, bool with_reading,
                                        unsigned threads);

/// What a space shows between two objects: hypotheses of at least `t_ratio` of the strongest.
struct Between {
    bool of_both =
        false;         ///< one with its centre between theirs, of whose weight each casts at least a fifth
    bool any = false;  ///< one in the middle half of the way from one centre to the other
};
[[nodiscard]] std::array<Between, depth_spaces.size()> shown_between(const DepthModels& models,
                                                                     const Shot& shot, double t_ratio);

/// What one way finds in a picture.
[[nodiscard]] ism::Detections found_in(const DepthModels& models, const Shot& shot, std::size_t way);

/// Scores as parts of the strongest of their image, as T_ratio cuts them.
[[nodiscard]] std::vector<ism::Result> relative_scores(std::vector<ism::Result> results);

}  // namespace reproduce
