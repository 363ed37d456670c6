// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "extractors_body.hpp"

#include "ism/feature/harris_laplace.hpp"

namespace program {

template std::optional<ism::AnyExtractor> extractor_of<ism::HarrisLaplace>(std::string_view,
                                                                           const ism::FeatureSettings*);

}  // namespace program
