// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "ism/codebook/match.hpp"
#include "ism/core/lists.hpp"
#include "ism/model/model.hpp"
#include "ism/train/fit_box_classifier.hpp"
#include "ism/train/fit_calibration.hpp"
#include "ism/train/learn_words.hpp"
#include "ism/train/occurrence_weights.hpp"
#include "ism/train/select_words.hpp"
#include "ism/train/train_options.hpp"
#include "ism/train/training_boxes.hpp"
#include "ism/train/training_features.hpp"

namespace ism {

namespace detail {

/// Words of each channel, and at each the training features that match it.
[[nodiscard]] inline Model learn_occurrences(const TrainingFeatures& features, const TrainOptions& options) {
    Model model{.channels = {},
                .shapes = {.class_names = features.class_names,
                           .category_ids = features.category_ids,
                           .objects = features.objects},
                .training = features.summary};
    std::vector<Occurrence> seen;
    std::vector<Match> matches;
    for (std::size_t c = 0; c < features.settings.size(); ++c) {
        const TrainingSamples& samples = features.samples[c];
        const double max_sq_distance =
            2 * (1 - options.codebook.min_similarity) * features.settings[c].sq_length;
        if (options.progress) options.progress("clustering", c, features.settings.size());
        model.channels.push_back(
            {features.settings[c], learn_words(samples, features.class_names.size(), max_sq_distance,
                                               options.codebook, options.threads)});
        if (options.progress) options.progress("clustering", c + 1, features.settings.size());
        const Codebook& codebook = model.channels[c].codebook;
        const auto first_word = static_cast<std::uint32_t>(model.first_word(c));
        for (Match match : match(codebook, samples.descriptors, options.threads)) {
            const bool own_class =
                codebook.groups()[match.word] == samples.occurrences[match.feature].class_index;
            if (options.codebook.kind == CodebookKind::per_class && !own_class) continue;
            match.feature += static_cast<std::uint32_t>(seen.size());
            match.word += first_word;
            matches.push_back(match);
        }
        append(seen, samples.occurrences);
    }
    model.shapes.occurrences = group_by_word(seen, matches, model.words());
    weigh_occurrences(model.shapes);
    return model;
}

/// Keeps the words of at least so much information gain about the class.
[[nodiscard]] inline Model keep_informative(const Model& model, double min_information_gain) {
    const auto gain = word_information_gain(model.shapes);
    const double best = *std::max_element(gain.begin(), gain.end());
    expect(best >= min_information_gain, "training: least information gain",
           lazy_text("at most that of the best word, ", best), min_information_gain);
    return keep_words(model, words_worth(gain, min_information_gain));
}

/// Keeps the `max_words` words of most worth.
[[nodiscard]] inline Model keep_best(const Model& model, const WordSelection& selection, unsigned threads) {
    const auto worth = selection.worth ? selection.worth(model.shapes, threads)
                                       : word_information_gain(model.shapes, threads);
    expect(worth.size() == model.words(), "WordSelection::worth: numbers, one a word", model.words(),
           worth.size());
    return keep_words(model, best_words(worth, selection.max_words));
}

/// The words that the options ask for.
[[nodiscard]] inline Model select_words(Model model, const WordSelection& selection, unsigned threads) {
    const double least = selection.min_information_gain;
    Model informative = least > 0 ? keep_informative(model, least) : std::move(model);
    return selection.max_words > 0 ? keep_best(informative, selection, threads) : std::move(informative);
}

}  // namespace detail

/// @brief Learns a model from training features: the descriptors of objects are clustered into words, then
/// each is matched to all words within the threshold, and each match is an occurrence; classifier of boxes
/// and calibration are learnt from the features of whole images, where these were kept.
/// @tparam Space  in which the model votes in those images; that of detection, unless it needs depth
/// @throws Error where an option is out of range or no word is left.
template <ImageVoteSpace Space = Jism>
[[nodiscard]] Model learn(const TrainingFeatures& features, const TrainOptions& options = {}) {
    check(options);
    expect(!features.objects.empty() && features.feature_count() > 0, "training: objects and features",
           "1 or more", 0);
    Model model = detail::select_words(detail::learn_occurrences(features, options), options.selection,
                                       options.threads);
    if (features.views.empty() || (!options.box_classifier && !options.calibrate)) return model;

    const std::size_t words = model.words(), classes = model.shapes.class_names.size();
    const auto classifier_options = options.box_classifier.value_or(BoxClassifierOptions{});
    const auto boxes = training_boxes<Space>(model, features, classifier_options.max_hypotheses,
                                             options.threads, options.progress);
    if (options.calibrate)
        model.calibration = fit_calibration(boxes, halves_of_views(features), words, classes, options);
    if (options.box_classifier)
        model.box_classifier = fit_box_classifier(boxes, words, classes, classifier_options, options.threads);
    return model;
}

}  // namespace ism
