// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/order.hpp"
#include "ism/model/model.hpp"
#include "ism/train/information_gain.hpp"
#include "ism/train/occurrence_weights.hpp"

namespace ism {

/// @brief How often each word was seen. A WordWorth.
[[nodiscard]] inline std::vector<double> word_occurrences(const ShapeModel& shapes,
                                                          unsigned /*threads*/ = 0) {
    std::vector<double> counts;
    for (std::size_t w = 0; w < shapes.occurrences.size(); ++w)
        counts.push_back(double(shapes.occurrences[w].size()));
    return counts;
}

/// @brief What each word tells about the class (Eq 3). A WordWorth.
[[nodiscard]] inline std::vector<double> word_information_gain(const ShapeModel& shapes,
                                                               unsigned /*threads*/ = 0) {
    const std::size_t words = shapes.occurrences.size(), classes = shapes.class_names.size();
    std::vector<double> counts(words * classes, 0);
    for (std::size_t w = 0; w < words; ++w)
        for (const Occurrence& o : shapes.occurrences[w]) counts[w * classes + o.class_index] += 1;
    return information_gain(counts, classes);
}

/// @brief The words that are worth at least `least`, in rising order.
[[nodiscard]] inline std::vector<std::uint32_t> words_worth(const std::vector<double>& worth, double least) {
    std::vector<std::uint32_t> chosen;
    for (std::uint32_t w = 0; w < worth.size(); ++w)
        if (worth[w] >= least) chosen.push_back(w);
    return chosen;
}

/// @brief The `count` words worth most (of equal ones the first), or all, in rising order.
[[nodiscard]] inline std::vector<std::uint32_t> best_words(const std::vector<double>& worth,
                                                           std::size_t count) {
    std::vector<std::uint32_t> chosen(worth.size());
    std::iota(chosen.begin(), chosen.end(), 0u);
    if (count >= worth.size()) return chosen;
    detail::sort_by(chosen, [&](std::uint32_t word) { return detail::falling(worth[word]); });
    chosen.resize(count);
    detail::sort_by(chosen, [](std::uint32_t word) { return word; });
    return chosen;
}

/// @brief A model with these words and their occurrences alone, weighed again, before what counts all its
/// words is learnt.
/// @param chosen  words in rising order
/// @throws Error where a channel has none, or the model already has what is learnt from all its words or does
/// not vote through words: a classifier of boxes, templates, exemplars, votes in metres.
[[nodiscard]] inline Model keep_words(const Model& model, const std::vector<std::uint32_t>& chosen) {
    expect(model.box_classifier.empty() && model.calibration.empty(), "words to keep",
           "a model without classifier and calibration", "one with them, which have to be learnt after");
    expect(model.templates.empty() && model.exemplars.empty() && model.shapes.frames.empty(), "words to keep",
           "a model of words alone", "one with templates, exemplars or votes in metres");
    Model kept{.channels = {},
               .shapes = {.class_names = model.shapes.class_names,
                          .category_ids = model.shapes.category_ids,
                          .objects = model.shapes.objects}};
    kept.training = model.training;
    auto next = chosen.begin();
    for (std::size_t c = 0; c < model.channels.size(); ++c) {
        const std::size_t first = model.first_word(c), end = model.first_word(c + 1);
        std::vector<std::uint32_t> words;
        for (; next != chosen.end() && *next < end; ++next) {
            words.push_back(*next - static_cast<std::uint32_t>(first));
            kept.shapes.occurrences.push_back(model.shapes.occurrences[*next]);
        }
        expect(!words.empty(), lazy_text("words to keep of channel ", c), "1 or more", 0);
        kept.channels.push_back({model.channels[c].features, model.channels[c].codebook.select(words)});
    }
    weigh_occurrences(kept.shapes);
    return kept;
}

}  // namespace ism
