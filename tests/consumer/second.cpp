// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT

// A second source of one program: what it defines once more has to be the same.
#include <cstddef>

#include "ism/ism.hpp"

std::size_t features_elsewhere(const ism::GrayImage& image);
std::size_t features_elsewhere(const ism::GrayImage& image) {
    ism::FeatureExtractor<ism::HessianLaplace, ism::RootSift> extractor;
    return extractor.extract(image.view()).features.size();
}
