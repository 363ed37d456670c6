// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/model/model.hpp"
#include "ism/train/information_gain.hpp"
#include "ism/train/set_occurrences.hpp"
#include "ism/train/vote_agreement.hpp"

namespace ism {

/// @brief What tells which words are worth keeping.
enum class WordMeasure {
    occurrences,       ///< how often the word was seen (as T_Q, the smallest cluster size)
    information_gain,  ///< what it tells about the class (Eq 3)
    vote_agreement,    ///< how much of what it votes is right: class, centre and scale; see vote_agreement()
};

/// @brief What each word is worth: one number a word, 0 or more; larger is better.
[[nodiscard]] inline std::vector<double> word_worth(const Shapes& shapes, WordMeasure measure,
                                                    unsigned threads = 0) {
    if (measure == WordMeasure::vote_agreement) return vote_agreement(shapes, threads);
    const std::size_t words = shapes.first.size() - 1, classes = shapes.class_names.size();
    std::vector<double> counts(words * classes, 0), seen(words, 0);
    for (std::size_t w = 0; w < words; ++w)
        for (const Occurrence& o : shapes.of_word(w)) counts[w * classes + o.class_index] += 1, seen[w] += 1;
    return measure == WordMeasure::occurrences ? seen : information_gain(counts, classes);
}

/// @brief The words that are worth at least so much, in rising order.
[[nodiscard]] inline std::vector<std::uint32_t> words_worth(std::span<const double> worth, double least) {
    std::vector<std::uint32_t> chosen;
    for (std::uint32_t w = 0; w < worth.size(); ++w)
        if (worth[w] >= least) chosen.push_back(w);
    return chosen;
}

/// @brief The `count` words worth most (of equal ones the first), or all, in rising order.
[[nodiscard]] inline std::vector<std::uint32_t> best_words(std::span<const double> worth, std::size_t count) {
    std::vector<std::uint32_t> chosen(worth.size());
    std::iota(chosen.begin(), chosen.end(), 0u);
    if (count >= worth.size()) return chosen;
    std::stable_sort(chosen.begin(), chosen.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return worth[a] > worth[b]; });
    chosen.resize(count);
    std::sort(chosen.begin(), chosen.end());
    return chosen;
}

/// @brief A model with these words and their occurrences alone, weighed again, before its judge of boxes is
/// learnt.
/// @param chosen  words in rising order
/// @throws Error where none is chosen, or the model already has a judge, which counts all its words.
template <Detector D, Descriptor Desc>
[[nodiscard]] Model<D, Desc> keep_words(const Model<D, Desc>& model, std::span<const std::uint32_t> chosen) {
    expect(!chosen.empty(), "words to keep", "1 or more", 0);
    expect(model.shapes.appearance.empty(), "words to keep", "a model without a judge of boxes",
           "one with a judge, which has to be learnt after");
    Model<D, Desc> kept{.extractor = model.extractor, .codebook = {}, .shapes = {}, .memory = model.memory};
    kept.codebook.max_sq_distance = model.codebook.max_sq_distance;
    kept.shapes.class_names = model.shapes.class_names;
    kept.shapes.objects = model.shapes.objects;
    kept.shapes.first = {0};
    for (const std::uint32_t w : chosen) {
        kept.codebook.words.push_back(model.codebook.words.row(w));
        kept.codebook.mean_sq_length.push_back(model.codebook.mean_sq_length[w]);
        kept.codebook.group.push_back(model.codebook.group[w]);
        kept.codebook.sizes.push_back(model.codebook.sizes[w]);
        const auto own = model.shapes.of_word(w);
        kept.shapes.occurrences.insert(kept.shapes.occurrences.end(), own.begin(), own.end());
        kept.shapes.first.push_back(static_cast<std::uint32_t>(kept.shapes.occurrences.size()));
    }
    detail::weigh_occurrences(kept.shapes);
    return kept;
}

}  // namespace ism
