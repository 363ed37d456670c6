// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "extractors_body.hpp"

#include "ism/feature/dense_grid.hpp"

namespace program {

template std::optional<ism::AnyExtractor> extractor_of<ism::DenseGrid>(std::string_view,
                                                                       const ism::FeatureSettings*);

}  // namespace program
