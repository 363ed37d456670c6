// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "commands.hpp"

#include "ism/dataset/dataset.hpp"
#include "ism/detect/detection.hpp"
#include "ism/detect/frame_matcher.hpp"
#include "ism/feature/dense_grid.hpp"
#include "ism/feature/difference_of_gaussians.hpp"
#include "ism/feature/harris_laplace.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"
#include "ism/model/model.hpp"
#include "ism/train/train.hpp"

namespace program {

/// A model whose detector and descriptor are known only at run time.
using AnyModel =
    std::variant<ism::Model<ism::DifferenceOfGaussians, ism::Sift>,
                 ism::Model<ism::DifferenceOfGaussians, ism::RootSift>,
                 ism::Model<ism::HarrisLaplace, ism::Sift>, ism::Model<ism::HarrisLaplace, ism::RootSift>,
                 ism::Model<ism::HessianLaplace, ism::Sift>, ism::Model<ism::HessianLaplace, ism::RootSift>,
                 ism::Model<ism::DenseGrid, ism::Sift>, ism::Model<ism::DenseGrid, ism::RootSift>>;

/// What training works on.
struct Lessons {
    const ism::Dataset& dataset;
    ism::TrainOptions options;
    std::filesystem::path add_to = {};  ///< model that learns more; empty = a new one
};

/// Finds the features of a picture and matches them to words: one picture at a time.
using PictureMatcher = std::function<ism::MatchedFeatures(const ism::Frame&)>;

// One of these for each detector and descriptor, compiled in models_*.cpp.
template <ism::Detector D, ism::Descriptor Desc>
[[nodiscard]] ism::Model<D, Desc> learn(const Lessons& lessons);
template <ism::Detector D, ism::Descriptor Desc>
[[nodiscard]] ism::Model<D, Desc> load(const std::filesystem::path& path);
template <ism::Detector D, ism::Descriptor Desc>
void save(const std::filesystem::path& path, const ism::Model<D, Desc>& model);
template <ism::Detector D, ism::Descriptor Desc>
[[nodiscard]] PictureMatcher make_matcher(const ism::Model<D, Desc>& model, unsigned threads);

/// A model of the detector and descriptor of these names.
[[nodiscard]] AnyModel learn_any(std::string_view detector, std::string_view descriptor,
                                 const Lessons& lessons);
/// The model of a file.
[[nodiscard]] AnyModel load_any(const std::filesystem::path& path);

[[nodiscard]] inline const ism::Shapes& shapes_of(const AnyModel& model) {
    return std::visit([](const auto& m) -> const ism::Shapes& { return m.shapes; }, model);
}
/// Refers to the model.
[[nodiscard]] inline PictureMatcher make_any_matcher(const AnyModel& model, unsigned threads) {
    return std::visit([&](const auto& m) { return make_matcher(m, threads); }, model);
}
inline void save_any(const std::filesystem::path& path, const AnyModel& model) {
    std::visit([&](const auto& m) { save(path, m); }, model);
}

/// Detects objects in the vote space of this name.
[[nodiscard]] ism::Detections find_objects(ism::MatchedFeatures matched, const ism::Shapes& shapes,
                                           const ism::Frame& frame, const SearchOptions& search,
                                           unsigned threads);
/// Whether a vote space uses depth.
[[nodiscard]] bool needs_depth(std::string_view space);
/// The part of the strongest score that the library keeps.
[[nodiscard]] double default_keep();

}  // namespace program
