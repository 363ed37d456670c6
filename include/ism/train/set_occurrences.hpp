// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

#include "ism/model/occurrence.hpp"

namespace ism::detail {

/// An occurrence and its word.
struct WordOccurrence {
    std::uint32_t word = 0;
    Occurrence occurrence;
};

/// Sets the occurrences of `words` words. Of a feature that is at a word twice, as where two words of before
/// are one, the first stays.
inline void set_occurrences(Shapes& shapes, std::vector<WordOccurrence> all, std::size_t words) {
    const auto place = [](const WordOccurrence& o) { return std::tuple(o.word, o.occurrence.feature); };
    std::stable_sort(all.begin(), all.end(),
                     [&](const auto& a, const auto& b) { return place(a) < place(b); });
    all.erase(std::unique(all.begin(), all.end(),
                          [&](const auto& a, const auto& b) { return place(a) == place(b); }),
              all.end());
    shapes.occurrences.clear();
    shapes.first.assign(words + 1, 0);
    for (const WordOccurrence& o : all) {
        shapes.occurrences.push_back(o.occurrence);
        ++shapes.first[o.word + 1];
    }
    std::partial_sum(shapes.first.begin(), shapes.first.end(), shapes.first.begin());
}

/// Gives each occurrence its weight p(occurrence | word): a feature shares one vote among its words, every
/// class counts alike however many features it was trained with, and those of a word add up to 1.
inline void weigh_occurrences(Shapes& shapes) {
    std::uint32_t features = 0;
    for (const Occurrence& o : shapes.occurrences) features = std::max(features, o.feature + 1);
    std::vector<double> words_of(features, 0), of_class(shapes.class_names.size(), 0);
    for (const Occurrence& o : shapes.occurrences) words_of[o.feature] += 1;
    for (const Occurrence& o : shapes.occurrences) of_class[o.class_index] += 1 / words_of[o.feature];
    const auto base = [&](const Occurrence& o) {
        return 1 / (words_of[o.feature] * of_class[o.class_index]);
    };
    for (std::size_t w = 0; w + 1 < shapes.first.size(); ++w) {
        const std::span<Occurrence> own = shapes.of_word(w);
        double sum = 0;
        for (const Occurrence& o : own) sum += base(o);
        for (Occurrence& o : own) o.weight = static_cast<float>(base(o) / sum);
    }
}

}  // namespace ism::detail
