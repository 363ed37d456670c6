// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/core/thread_pool.hpp"
#include "ism/model/shape_model.hpp"
#include "ism/vote/axes.hpp"
#include "ism/vote/kernel.hpp"

namespace ism {

/// @brief How well the votes of one training feature through occurrences of its word on other objects agree
/// with where its own object is: the share that names the right class and falls near the centre
/// and scale, 0 … 1; 0 where no other object has the word.
/// @param word      the occurrences of one word
/// @param of_class  number of all occurrences of each class: every class counts alike
[[nodiscard]] inline double right_vote_share(std::span<const Occurrence> word, const Occurrence& feature,
                                             std::span<const double> of_class) {
    double all = 0, right = 0;
    for (const Occurrence& other : word) {
        if (other.object == feature.object) continue;
        const double weight = 1 / of_class[other.class_index];
        all += weight;
        if (other.class_index != feature.class_index) continue;
        const double ratio = double(feature.scale) / other.scale;
        const double u = (feature.x - other.x * ratio) / X::bandwidth;
        const double v = (feature.y - other.y * ratio) / Y::bandwidth;
        const double w = (ratio - 1) / Scale::bandwidth;
        right += weight * EpanechnikovKernel::profile(static_cast<float>(u * u + v * v + w * w));
    }
    return all > 0 ? right / all : 0;
}

/// @brief What each word is good for: the part of all training features, every class counting alike, that
/// this word leads to the right vote. Unlike the information gain it asks not only which class a word tells,
/// but also whether it tells where. In words of more than `max_features` so many, evenly chosen, are asked.
/// @return one number a word, 0 or more
[[nodiscard]] inline std::vector<double> vote_agreement(const ShapeModel& shapes, unsigned threads = 0,
                                                        std::size_t max_features = 500) {
    std::vector<double> of_class(shapes.class_names.size(), 0);
    for (const Occurrence& o : shapes.occurrences.values()) of_class[o.class_index] += 1;
    const std::size_t words = shapes.occurrences.size();
    std::vector<double> agreement(words);
    parallel_for(words, threads, [&](std::size_t w) {
        const std::span<const Occurrence> word = shapes.occurrences[w];
        const std::size_t step =
            std::max<std::size_t>(1, word.size() / std::max<std::size_t>(1, max_features));
        double sum = 0;
        std::size_t asked = 0;
        for (std::size_t i = 0; i < word.size(); i += step, ++asked)
            sum += right_vote_share(word, word[i], of_class) / of_class[word[i].class_index];
        if (asked > 0) agreement[w] = sum * double(word.size()) / double(asked);
    });
    return agreement;
}

}  // namespace ism
