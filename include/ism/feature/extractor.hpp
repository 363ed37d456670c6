// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "ism/feature/descriptor.hpp"
#include "ism/feature/detector.hpp"

namespace ism {

/// @brief What is done around detector and descriptor.
struct ExtractOptions {
    ScaleSpaceOptions scale_space = {};
    double upsampling = 1;         ///< the image is resized by this factor before; > 0
    bool oriented = false;         ///< features get dominant directions, and may multiply
    std::size_t max_features = 0;  ///< keep so many, strong and spread over the image; 0 = all
};

/// @brief How features are got from an image: a detector, a descriptor, options.
template <Detector D, Descriptor Desc>
struct Extractor {
    using DetectorType = D;
    using DescriptorType = Desc;
    D detector = {};
    Desc descriptor = {};
    ExtractOptions options = {};
};

}  // namespace ism
