// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "extractors_body.hpp"

#include "ism/feature/hessian_laplace.hpp"

namespace program {

template std::optional<ism::AnyExtractor> extractor_of<ism::HessianLaplace>(std::string_view,
                                                                            const ism::FeatureSettings*);

}  // namespace program
