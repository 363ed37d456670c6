// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ism/model/box_classifier.hpp"
#include "ism/model/calibration.hpp"
#include "ism/model_file/shape_tensors.hpp"
#include "ism/model_file/tensor.hpp"

/// What judges hypotheses, as tensors.
namespace ism::detail {

inline void box_classifier_to_tensors(const BoxClassifier& classifier, TensorFile& file) {
    std::vector<std::uint32_t> bins;
    std::vector<float> weights;
    for (const SparseEntry& weight : classifier.weights.values()) {
        bins.push_back(weight.index);
        weights.push_back(weight.value);
    }
    file.tensors["box_classifier_offsets"] = offsets_tensor(classifier.weights.offsets());
    file.tensors["box_classifier_bins"] = make_tensor<std::uint32_t>(bins, {bins.size()});
    file.tensors["box_classifier_weights"] = make_tensor<float>(weights, {weights.size()});
    file.tensors["box_classifier_bias"] = make_tensor<float>(classifier.bias, {classifier.bias.size()});
}

/// Reads what box_classifier_to_tensors() wrote, for this number of words and classes; it may be empty.
[[nodiscard]] inline BoxClassifier box_classifier_from_tensors(const TensorFile& file, std::size_t words,
                                                               std::size_t classes) {
    const auto bias = values<float>(file, "box_classifier_bias", {any_length});
    expect<FileError>(bias.empty() || bias.size() == classes, lazy_text(file.source, ": box_classifier_bias"),
                      lazy_text("0 or ", classes, " numbers"), bias.size());
    const auto weights = values<float>(file, "box_classifier_weights", {any_length});
    const auto bins = values<std::uint32_t>(file, "box_classifier_bins", {weights.size()});
    const auto offsets = offsets_from_tensor(file, "box_classifier_offsets", bias.size(), weights.size());
    for (const auto& numbers : {bias, weights})
        for (const float number : numbers)
            expect<FileError>(std::isfinite(number), lazy_text(file.source, ": box classifier"),
                              "finite numbers", number);
    BoxClassifier classifier;
    for (std::size_t c = 0; c < bias.size(); ++c) {
        std::vector<SparseEntry> own;
        for (std::size_t i = offsets[c]; i < offsets[c + 1]; ++i) {
            expect<FileError>(
                bins[i] < BoxClassifier::cells * words && (own.empty() || own.back().index < bins[i]),
                lazy_text(file.source, ": box_classifier_bins"),
                lazy_text("rising numbers below ", BoxClassifier::cells * words), bins[i]);
            own.push_back({bins[i], weights[i]});
        }
        classifier.push_back(own, bias[c]);
    }
    return classifier;
}

inline void calibration_to_tensors(const Calibration& calibration, TensorFile& file) {
    std::vector<double> curves;
    for (const auto& [slope, offset] : calibration.curves) curves.insert(curves.end(), {slope, offset});
    file.tensors["calibration"] = make_tensor<double>(curves, {calibration.curves.size(), 2});
}

[[nodiscard]] inline Calibration calibration_from_tensors(const TensorFile& file, std::size_t classes) {
    const auto curves = values<double>(file, "calibration", {any_length, 2});
    expect<FileError>(curves.empty() || curves.size() == 2 * classes, lazy_text(file.source, ": calibration"),
                      lazy_text("0 or ", classes, " curves"), curves.size() / 2);
    Calibration calibration;
    for (std::size_t c = 0; 2 * c < curves.size(); ++c) {
        expect<FileError>(std::isfinite(curves[2 * c]) && std::isfinite(curves[2 * c + 1]),
                          lazy_text(file.source, ": calibration"), "finite numbers",
                          lazy_text(curves[2 * c], ", ", curves[2 * c + 1]));
        calibration.curves.push_back({curves[2 * c], curves[2 * c + 1]});
    }
    return calibration;
}

}  // namespace ism::detail
