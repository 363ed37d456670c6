// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "extractors_body.hpp"

#include "ism/feature/difference_of_gaussians.hpp"

namespace program {

template std::optional<ism::AnyExtractor> extractor_of<ism::DifferenceOfGaussians>(
    std::string_view, const ism::FeatureSettings*);

}  // namespace program
