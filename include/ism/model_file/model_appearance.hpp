// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ism/model/appearance.hpp"
#include "ism/model_file/tensor.hpp"

/// The judge of boxes as tensors.
namespace ism::detail {

inline void appearance_to_tensors(const Appearance& appearance, TensorFile& file) {
    std::vector<std::uint32_t> bins;
    std::vector<float> weights;
    for (const BinValue& weight : appearance.weights) {
        bins.push_back(weight.bin);
        weights.push_back(weight.value);
    }
    file.tensors["appearance_first"] =
        make_tensor<std::uint32_t>(appearance.first, {appearance.first.size()});
    file.tensors["appearance_bins"] = make_tensor<std::uint32_t>(bins, {bins.size()});
    file.tensors["appearance_weights"] = make_tensor<float>(weights, {weights.size()});
    file.tensors["appearance_bias"] = make_tensor<float>(appearance.bias, {appearance.bias.size()});
}

/// Reads what appearance_to_tensors() wrote, for so many words and classes; it may be empty.
[[nodiscard]] inline Appearance appearance_from_tensors(const TensorFile& file, std::size_t words,
                                                        std::size_t classes) {
    const auto bias = values<float>(file, "appearance_bias", {any_length});
    expect<FileError>(bias.empty() || bias.size() == classes, lazy_text(file.source, ": appearance_bias"),
                      lazy_text("0 or ", classes, " numbers"), bias.size());
    const auto first = values<std::uint32_t>(file, "appearance_first", {bias.size() + 1});
    const auto weights = values<float>(file, "appearance_weights", {any_length});
    const auto bins = values<std::uint32_t>(file, "appearance_bins", {weights.size()});
    expect<FileError>(first.front() == 0 && first.back() == weights.size(),
                      lazy_text(file.source, ": appearance_first"), lazy_text("0 to ", weights.size()),
                      lazy_text(first.front(), " to ", first.back()));
    for (const auto& numbers : {bias, weights})
        for (const float number : numbers)
            expect<FileError>(std::isfinite(number), lazy_text(file.source, ": appearance"), "finite numbers",
                              number);
    Appearance appearance;
    for (std::size_t c = 0; c < bias.size(); ++c) {
        expect<FileError>(first[c] <= first[c + 1] && first[c + 1] <= weights.size(),
                          lazy_text(file.source, ": appearance_first"), "rising numbers",
                          lazy_text(first[c], " before ", first[c + 1]));
        std::vector<BinValue> own;
        for (std::size_t i = first[c]; i < first[c + 1]; ++i) {
            expect<FileError>(
                bins[i] < Appearance::cells * words && (own.empty() || own.back().bin < bins[i]),
                lazy_text(file.source, ": appearance_bins"),
                lazy_text("rising numbers below ", Appearance::cells * words), bins[i]);
            own.push_back({bins[i], weights[i]});
        }
        appearance.push_back(own, bias[c]);
    }
    return appearance;
}

}  // namespace ism::detail
