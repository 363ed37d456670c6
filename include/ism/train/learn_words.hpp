// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "ism/codebook/build_codebook.hpp"
#include "ism/core/random.hpp"
#include "ism/train/train_options.hpp"
#include "ism/train/training_features.hpp"

namespace ism {

/// @brief A random part of `count` of the numbers below `total`, in rising order.
[[nodiscard]] inline std::vector<std::uint32_t> random_part(std::size_t total, std::size_t count,
                                                            Random& random) {
    std::vector<std::uint32_t> part;
    for (std::uint32_t i = 0; i < total && part.size() < count; ++i)
        if (random.uniform() * double(total - i) < double(count - part.size())) part.push_back(i);
    return part;
}

/// @brief Clusters the features on training objects into words: those of all classes together, or those of
/// one class after another.
/// @throws Error where no word is left.
[[nodiscard]] inline Codebook learn_words(const TrainingSamples& samples, std::size_t classes,
                                          double max_sq_distance, const CodebookOptions& options,
                                          unsigned threads = 0) {
    const bool joint = options.kind == CodebookKind::joint;
    const std::size_t dimension = samples.descriptors.dimension();
    Random random(options.seed);
    Codebook codebook(dimension, max_sq_distance);
    for (std::uint32_t group = 0; group < (joint ? 1 : classes); ++group) {
        std::vector<std::uint32_t> rows;
        for (std::uint32_t i = 0; i < samples.occurrences.size(); ++i)
            if (joint || samples.occurrences[i].class_index == group) rows.push_back(i);
        if (rows.size() > options.max_features) {
            std::vector<std::uint32_t> part = random_part(rows.size(), options.max_features, random);
            for (std::uint32_t& row : part) row = rows[row];
            rows = std::move(part);
        }
        Descriptors<float> chosen(dimension);
        chosen.reserve(rows.size());
        for (const std::uint32_t row : rows) chosen.push_back(samples.descriptors.row(row));
        add_words(codebook, chosen, options.min_cluster_size, group, threads);
    }
    return codebook;
}

}  // namespace ism
