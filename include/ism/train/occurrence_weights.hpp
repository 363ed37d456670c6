// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/codebook/codebook.hpp"
#include "ism/core/grouped.hpp"
#include "ism/model/shape_model.hpp"

namespace ism {

/// @brief The occurrences of each word: every match of a training feature is one, in the order of features.
/// @param features  one occurrence a feature; Match::feature points into them
[[nodiscard]] inline Grouped<Occurrence> group_by_word(const std::vector<Occurrence>& features,
                                                       const std::vector<Match>& matches, std::size_t words) {
    std::vector<std::uint32_t> offsets(words + 1, 0);
    for (const Match& match : matches) ++offsets[match.word + 1];
    for (std::size_t w = 0; w < words; ++w) offsets[w + 1] += offsets[w];
    std::vector<Occurrence> occurrences(matches.size());
    std::vector<std::uint32_t> next(offsets.begin(), offsets.end() - 1);
    for (const Match& match : matches) occurrences[next[match.word]++] = features[match.feature];
    return {std::move(occurrences), std::move(offsets)};
}

/// @brief Gives each occurrence its weight p(occurrence | word): a feature shares one vote among its words,
/// every class counts alike however many features it was trained with, and those of a word add up to 1.
inline void weigh_occurrences(ShapeModel& shapes) {
    std::uint32_t features = 0;
    for (const Occurrence& o : shapes.occurrences.values()) features = std::max(features, o.feature + 1);
    std::vector<double> words_of(features, 0), of_class(shapes.class_names.size(), 0);
    for (const Occurrence& o : shapes.occurrences.values()) words_of[o.feature] += 1;
    for (const Occurrence& o : shapes.occurrences.values())
        of_class[o.class_index] += 1 / words_of[o.feature];
    const auto base = [&](const Occurrence& o) {
        return 1 / (words_of[o.feature] * of_class[o.class_index]);
    };
    for (std::size_t w = 0; w < shapes.occurrences.size(); ++w) {
        const std::span<Occurrence> word = shapes.occurrences[w];
        double sum = 0;
        for (const Occurrence& o : word) sum += base(o);
        for (Occurrence& o : word) o.weight = static_cast<float>(base(o) / sum);
    }
}

}  // namespace ism
