// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "extractors.hpp"

#include <algorithm>

#include "commands.hpp"
#include "input.hpp"

#include "ism/feature/dense_grid.hpp"
#include "ism/feature/difference_of_gaussians.hpp"
#include "ism/feature/harris_laplace.hpp"
#include "ism/feature/hessian_laplace.hpp"

namespace program {

namespace {

ism::AnyExtractor make(std::string_view detector, std::string_view descriptor,
                       const ism::FeatureSettings* settings) {
    std::optional<ism::AnyExtractor> found;
    const auto try_one = [&]<class D>(D) {
        if (D::name == detector) found = extractor_of<D>(descriptor, settings);
    };
    try_one(ism::DifferenceOfGaussians{});
    try_one(ism::HarrisLaplace{});
    try_one(ism::HessianLaplace{});
    try_one(ism::DenseGrid{});
    ism::expect(found.has_value(), "features",
                ism::lazy_text("detector ", list_text(detector_names), " and descriptor ",
                               list_text(descriptor_names)),
                ism::lazy_text(detector, " and ", descriptor));
    return *found;
}

}  // namespace

ism::AnyExtractor make_extractor(std::string_view detector, std::string_view descriptor) {
    return make(detector, descriptor, nullptr);
}

ism::AnyExtractor make_extractor(const ism::FeatureSettings& settings) {
    return make(settings.detector, settings.descriptor, &settings);
}

std::vector<ism::AnyExtractor> extractors_of(const ism::Model& model) {
    std::vector<ism::AnyExtractor> extractors;
    for (const ism::Channel& channel : model.channels) extractors.push_back(make_extractor(channel.features));
    return extractors;
}

}  // namespace program
