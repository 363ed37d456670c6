// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/hog/patch_mixture.hpp"
#include "ism/model/patch_classifier.hpp"
#include "ism/model_file/tensor.hpp"

/// What judges boxes by their patches, as tensors.
namespace ism::detail {

inline void patch_classifier_to_tensors(const PatchClassifier& classifier, TensorFile& file) {
    const auto& [mixture, weights, bias] = classifier;
    std::vector<float> all_weights;
    for (const std::vector<float>& of_class : weights)
        all_weights.insert(all_weights.end(), of_class.begin(), of_class.end());
    const std::size_t gaussians = mixture.weights.size();
    file.tensors["patch_mean"] = make_tensor<float>(mixture.mean, {mixture.mean.size()});
    file.tensors["patch_axes"] = make_tensor<float>(mixture.axes, {mixture.mean.size(), patch_axes});
    file.tensors["patch_gaussian_weights"] = make_tensor<float>(mixture.weights, {gaussians});
    file.tensors["patch_gaussian_means"] = make_tensor<float>(mixture.means, {gaussians, patch_axes});
    file.tensors["patch_gaussian_spreads"] = make_tensor<float>(mixture.spreads, {gaussians, patch_axes});
    file.tensors["patch_weights"] =
        make_tensor<float>(all_weights, {weights.size(), PatchMixture::vector_numbers});
    file.tensors["patch_bias"] = make_tensor<float>(bias, {bias.size()});
}

/// Reads what patch_classifier_to_tensors() wrote, for this number of classes; it may be empty.
[[nodiscard]] inline PatchClassifier patch_classifier_from_tensors(const TensorFile& file,
                                                                   std::size_t classes) {
    const auto bias = values<float>(file, "patch_bias", {any_length});
    expect<FileError>(bias.empty() || bias.size() == classes, lazy_text(file.source, ": patch_bias"),
                      lazy_text("0 or ", classes, " numbers"), bias.size());
    const std::size_t gaussians = bias.empty() ? 0 : PatchMixture::gaussians,
                      numbers = bias.empty() ? 0 : patch_numbers;
    const auto mean = values<float>(file, "patch_mean", {numbers});
    const auto axes = values<float>(file, "patch_axes", {numbers, patch_axes});
    const auto gaussian_weights = values<float>(file, "patch_gaussian_weights", {gaussians});
    const auto means = values<float>(file, "patch_gaussian_means", {gaussians, patch_axes});
    const auto spreads = values<float>(file, "patch_gaussian_spreads", {gaussians, patch_axes});
    const auto weights = values<float>(file, "patch_weights", {bias.size(), PatchMixture::vector_numbers});
    for (const auto& part : {bias, mean, axes, means, weights})
        for (const float number : part)
            expect<FileError>(std::isfinite(number), lazy_text(file.source, ": classifier of patches"),
                              "finite numbers", number);
    for (const auto& part : {gaussian_weights, spreads})
        for (const float number : part)
            expect<FileError>(number >= 1e-9f && number <= 1e9f,
                              lazy_text(file.source, ": Gaussians of patches"), "weights and spreads above 0",
                              number);
    PatchClassifier classifier{.mixture = {.mean = {mean.begin(), mean.end()},
                                           .axes = {axes.begin(), axes.end()},
                                           .weights = {gaussian_weights.begin(), gaussian_weights.end()},
                                           .means = {means.begin(), means.end()},
                                           .spreads = {spreads.begin(), spreads.end()}},
                               .bias = {bias.begin(), bias.end()}};
    for (std::size_t c = 0; c < bias.size(); ++c) {
        const auto own = weights.subspan(c * PatchMixture::vector_numbers, PatchMixture::vector_numbers);
        classifier.weights.emplace_back(own.begin(), own.end());
    }
    return classifier;
}

}  // namespace ism::detail
