// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "ism/feature/descriptor.hpp"
#include "ism/feature/detector.hpp"
#include "ism/feature/range.hpp"
#include "ism/feature/resize.hpp"

namespace ism {

/// @brief Options of extraction beside those of detector and descriptor.
struct ExtractOptions {
    ScaleSpaceOptions scale_space = {};
    double upsampling = 1;         ///< the image is resized by this factor before; 1/16 … 16
    bool oriented = false;         ///< features get dominant directions, and may multiply
    std::size_t max_features = 0;  ///< at most this many, strong and spread over the image; 0 = all
};

/// @brief Validates `options`.
/// @throws Error where one is out of range.
inline void check(const ExtractOptions& options) {
    check(options.scale_space);
    detail::expect_range("upsampling", options.upsampling, min_resize, max_resize);
}

/// @brief How features are extracted from an image: a detector, a descriptor, options.
template <Detector D, Descriptor Desc>
struct Extractor {
    using DetectorType = D;
    using DescriptorType = Desc;
    D detector = {};
    Desc descriptor = {};
    ExtractOptions options = {};
};

/// @brief Validates an extractor: its options, and those of its detector and descriptor where these have a
/// check() of their own (it is optional: a function `check(const MyDetector&)` beside the type that throws
/// Error). What is read from a file passes here as what is set in a program does.
/// @throws Error where one is out of range.
template <Detector D, Descriptor Desc>
void check(const Extractor<D, Desc>& extractor) {
    check(extractor.options);
    if constexpr (requires { check(extractor.detector); }) check(extractor.detector);
    if constexpr (requires { check(extractor.descriptor); }) check(extractor.descriptor);
}

}  // namespace ism
