// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "support/data_sets.hpp"
#include "support/program_model.hpp"

#include "ism/core/frame.hpp"
#include "ism/core/random.hpp"
#include "ism/dataset/read_images.hpp"
#include "ism/detect/hypotheses.hpp"
#include "ism/vote/cast.hpp"

namespace bench {

/// @brief Place, scale, depth and scaled depth: five axes, one label.
using FiveAxes = ism::VoteSpace<ism::X, ism::Y, ism::Scale, ism::Depth, ism::ScaledDepth>;

/// @brief Five axes and the class.
using FiveAxesAndClass = ism::VoteSpace<ism::X, ism::Y, ism::Scale, ism::Depth, ism::ScaledDepth, ism::Class>;

/// @brief Votes of every class that a model trained on osd/train.json casts in each image of osd/val.json,
/// with soft matching, in the five axes.
[[nodiscard]] inline std::vector<std::vector<ism::Vote<5>>> osd_votes(const std::filesystem::path& data) {
    const ism::Dataset lessons = read_set(data / "osd" / "train.json");
    const ism::Model model = program::learn(features_as_program(lessons, 0, {}),
                                            {.box_classifier = std::nullopt, .calibrate = false});
    ism::ThreadPool pool(0);
    program::Matcher matcher(model, pool);
    std::vector<std::vector<ism::Vote<5>>> votes;
    for (const ism::DatasetImage& image : read_set(data / "osd" / "val.json").images) {
        const ism::Frame frame = ism::read_frame(image);
        votes.push_back(ism::cast_votes<FiveAxesAndClass>(matcher.scene(frame, "jism"), ism::MatchMode::all,
                                                          {.width = double(frame.gray.width()),
                                                           .height = double(frame.gray.height()),
                                                           .min_scale = 0.2,
                                                           .max_scale = 4}));
    }
    return votes;
}

/// @brief So many votes of all images drawn at random, as if of one picture and one class.
[[nodiscard]] inline std::vector<ism::Vote<5>> pooled(const std::vector<std::vector<ism::Vote<5>>>& images,
                                                      std::size_t count) {
    std::vector<ism::Vote<5>> all;
    for (const auto& image : images) all.insert(all.end(), image.begin(), image.end());
    ism::expect(all.size() >= count, "votes of all images", ism::lazy_text("at least ", count), all.size());
    ism::Random random(1);
    for (std::size_t i = 0; i < count; ++i) std::swap(all[i], all[i + random.index(all.size() - i)]);
    all.resize(count);
    for (auto& vote : all) vote.label = 0;
    return all;
}

/// @brief The first axes of votes.
template <std::size_t Dimension>
[[nodiscard]] std::vector<ism::Vote<Dimension>> first_axes(const std::vector<ism::Vote<5>>& votes) {
    std::vector<ism::Vote<Dimension>> part;
    for (const auto& vote : votes) {
        part.push_back({.at = {},
                        .scale = vote.scale,
                        .weight = vote.weight,
                        .label = vote.label,
                        .feature = vote.feature,
                        .word = vote.word,
                        .occurrence = vote.occurrence});
        std::copy_n(vote.at.begin(), Dimension, part.back().at.begin());
    }
    return part;
}

}  // namespace bench
