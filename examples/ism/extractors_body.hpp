// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include "extractors.hpp"

#include "ism/feature/sift.hpp"

// The body of the template of extractors.hpp; each extractors_*.cpp compiles it for one detector.
namespace program {

template <ism::Detector D>
std::optional<ism::AnyExtractor> extractor_of(std::string_view descriptor,
                                              const ism::FeatureSettings* settings) {
    const auto make = [&]<class Desc>(Desc) -> ism::AnyExtractor {
        if (settings != nullptr) return ism::extractor_from<D, Desc>(*settings);
        return ism::Extractor<D, Desc>{};
    };
    if (descriptor == ism::Sift::name) return make(ism::Sift{});
    if (descriptor == ism::RootSift::name) return make(ism::RootSift{});
    return {};
}

}  // namespace program
