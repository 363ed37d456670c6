// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "ism/feature/any_extractor.hpp"
#include "ism/model/model.hpp"

namespace program {

/// The extractor of a detector and a descriptor, with its defaults.
/// @throws ism::Error where there is none of these names.
[[nodiscard]] ism::AnyExtractor make_extractor(std::string_view detector, std::string_view descriptor);

/// The extractor that settings tell of.
/// @throws ism::Error where the program has none of the names.
[[nodiscard]] ism::AnyExtractor make_extractor(const ism::FeatureSettings& settings);

/// The extractors that a model's features were found by, one a channel.
/// @throws ism::Error where the program has none of the names.
[[nodiscard]] std::vector<ism::AnyExtractor> extractors_of(const ism::Model& model);

/// One detector with each descriptor, compiled in extractors_*.cpp: with the defaults, or as `settings` say.
template <ism::Detector D>
[[nodiscard]] std::optional<ism::AnyExtractor> extractor_of(std::string_view descriptor,
                                                            const ism::FeatureSettings* settings);

}  // namespace program
