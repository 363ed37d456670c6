// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/codebook/build_codebook.hpp"
#include "ism/core/random.hpp"
#include "ism/model/occurrence.hpp"
#include "ism/train/train_options.hpp"

namespace ism::detail {

/// A random part of `count` numbers below `total`, in rising order.
[[nodiscard]] inline std::vector<std::size_t> random_part(std::size_t total, std::size_t count,
                                                          Random& random) {
    std::vector<std::size_t> part;
    for (std::size_t i = 0; i < total && part.size() < count; ++i)
        if (random.uniform() * double(total - i) < double(count - part.size())) part.push_back(i);
    return part;
}

template <std::size_t Dimension, DescriptorScalar Scalar>
[[nodiscard]] Descriptors<float, Dimension> chosen_as_float(const Descriptors<Scalar, Dimension>& all,
                                                            std::span<const std::size_t> rows) {
    Descriptors<float, Dimension> part(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
        std::copy(all.row(rows[i]).begin(), all.row(rows[i]).end(), part.row(i).begin());
    return part;
}

/// The words of all features, or those of each class after those of another.
template <std::size_t Dimension, DescriptorScalar Scalar>
[[nodiscard]] Codebook<Dimension> learn_words(const Descriptors<Scalar, Dimension>& descriptors,
                                              std::span<const Occurrence> seen, std::size_t classes,
                                              double max_sq_distance, const TrainOptions& options) {
    const bool joint = options.codebook == CodebookKind::joint;
    Random random(options.seed);
    Codebook<Dimension> codebook{
        .words = {}, .mean_sq_length = {}, .group = {}, .max_sq_distance = max_sq_distance};
    for (std::uint32_t group = 0; group < (joint ? 1 : classes); ++group) {
        std::vector<std::size_t> rows;
        for (std::size_t i = 0; i < descriptors.size(); ++i)
            if (joint || seen[i].class_index == group) rows.push_back(i);
        if (rows.size() > options.max_cluster_features) {
            std::vector<std::size_t> part = random_part(rows.size(), options.max_cluster_features, random);
            for (std::size_t& row : part) row = rows[row];
            rows = std::move(part);
        }
        const auto words = build_codebook(chosen_as_float(descriptors, std::span<const std::size_t>(rows)),
                                          max_sq_distance, options.min_cluster_size, group, options.threads);
        for (std::size_t w = 0; w < words.size(); ++w) {
            codebook.words.push_back(words.words.row(w));
            codebook.mean_sq_length.push_back(words.mean_sq_length[w]);
            codebook.group.push_back(group);
            codebook.sizes.push_back(words.sizes[w]);
        }
    }
    return codebook;
}

}  // namespace ism::detail
