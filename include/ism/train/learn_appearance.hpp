// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "ism/train/appearance_samples.hpp"
#include "ism/train/fit_appearance.hpp"

namespace ism {

/// @brief Learns what boxes of each class hold: from the labelled boxes, and from what the model finds in
/// each training image when it has not seen its objects (leave one image out), background images included.
/// @param first_object  image i has the objects first_object[i] … first_object[i + 1] − 1 of the model
/// @param source        gives the images that the model was learnt from
/// @throws Error where `first_object` does not fit the model.
template <Detector D, Descriptor Desc, TrainingSource Source>
[[nodiscard]] Appearance learn_appearance(const Model<D, Desc>& model,
                                          std::span<const std::uint32_t> first_object, const Source& source,
                                          const AppearanceOptions& options = {}, unsigned threads = 0,
                                          const Progress& progress = {}) {
    const auto samples = detail::appearance_samples(model, first_object, source, options, threads, progress);
    return fit_appearance(samples, model.codebook.size(), model.shapes.class_names.size(), options, threads);
}

}  // namespace ism
