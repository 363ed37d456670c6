// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "ism/dataset/dataset.hpp"
#include "ism/feature/any_extractor.hpp"
#include "ism/model/model.hpp"
#include "ism/train/train_options.hpp"
#include "ism/train/training_set.hpp"

namespace program {

// What training decides by its images, for the program as for the Python module.

/// Leaves out classes that are listed, as exports do, and that no object shows; none where that would be all.
/// @return their names
[[nodiscard]] std::vector<std::string> leave_out_unused(ism::Dataset& dataset);

/// How a model takes objects to lie.
struct Orientation {
    bool free = false;        ///< features have directions: objects are found however they are turned
    bool templates = true;    ///< whether templates can judge what is found so
    std::string why_so = {};  ///< what training objects tell, to be told; empty where they were not asked
};

/// @param how  "auto": as training objects lie; "upright" or "free"
/// @throws ism::Error for another word.
[[nodiscard]] Orientation choose_orientation(const std::string& how, std::span<const std::string> class_names,
                                             const ism::TrainingSet& set,
                                             const std::vector<ism::AnyExtractor>& extractors,
                                             unsigned threads);

/// Images that the model for depth can be learnt from.
struct DepthImages {
    std::size_t with_depth = 0;            ///< how many have depth
    std::vector<std::size_t> usable = {};  ///< of these, those that also have a camera, by their places
};

/// Learns the model for frames with depth from the images that have it, where every class has such images.
/// @return why it was left out; empty where it was learnt or no image has depth
[[nodiscard]] std::string add_depth(ism::Model& model, const ism::TrainingSet& set, const DepthImages& images,
                                    const ism::TrainOptions& options);

/// What to tell of a model whose probabilities say little; empty where they say enough.
[[nodiscard]] std::string doubt_of_probabilities(const ism::Model& model);

}  // namespace program
