// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ism/codebook/byte_codebook.hpp"
#include "ism/codebook/match.hpp"
#include "ism/model/model.hpp"
#include "ism/train/harvest.hpp"
#include "ism/train/learn_appearance.hpp"
#include "ism/train/learn_words.hpp"
#include "ism/train/select_words.hpp"
#include "ism/train/set_occurrences.hpp"
#include "ism/train/train_options.hpp"

namespace ism {

namespace detail {

/// What each word was seen as: every match is an occurrence.
template <Detector D, Descriptor Desc>
[[nodiscard]] Shapes shapes_of(const Harvest<D, Desc>& harvest, std::span<const Match> matches,
                               std::size_t words) {
    std::vector<WordOccurrence> seen;
    seen.reserve(matches.size());
    for (const Match& m : matches) seen.push_back({m.word, harvest.seen[m.feature]});
    Shapes shapes;
    shapes.class_names = harvest.class_names;
    shapes.objects = harvest.objects;
    set_occurrences(shapes, std::move(seen), words);
    return shapes;
}

}  // namespace detail

/// @brief Learns a model from what was harvested: the descriptors are clustered into words, then each is
/// matched to all words within the threshold, and each match is an occurrence.
/// @throws Error where an option is out of range or no word is left.
template <Detector D, Descriptor Desc>
[[nodiscard]] Model<D, Desc> learn(const Harvest<D, Desc>& harvest, const TrainOptions& options = {}) {
    expect(options.min_similarity > -1 && options.min_similarity <= 1, "training: similarity",
           "above -1, at most 1", options.min_similarity);
    expect(options.min_cluster_size > 0, "training: smallest cluster size", "1 or more", 0);
    expect(options.max_cluster_features > 1, "training: most features to cluster", "2 or more",
           options.max_cluster_features);
    const std::size_t classes = harvest.class_names.size();
    const std::span<const Occurrence> seen = harvest.seen;
    const double max_sq_distance = 2 * (1 - options.min_similarity) * Desc::sq_length;
    if (options.progress) options.progress("clustering", 0, 1);
    const auto words = words_as<typename Desc::Scalar>(
        detail::learn_words(harvest.descriptors, seen, classes, max_sq_distance, options));
    if (options.progress) options.progress("clustering", 1, 1);
    std::vector<Match> matches = match(words, harvest.descriptors, options.threads);
    if (options.codebook == CodebookKind::per_class)
        std::erase_if(matches,
                      [&](const Match& m) { return words.group[m.word] != seen[m.feature].class_index; });

    Model<D, Desc> model{.extractor = harvest.extractor,
                         .codebook = words,
                         .shapes = detail::shapes_of(harvest, matches, words.size())};
    if (options.memory) model.memory = harvest.descriptors;
    if (options.min_information_gain > 0) {
        const auto gain = word_worth(model.shapes, WordMeasure::information_gain);
        const double best = *std::max_element(gain.begin(), gain.end());
        expect(best >= options.min_information_gain, "training: least information gain",
               lazy_text("at most that of the best word, ", best), options.min_information_gain);
        model = keep_words(model, words_worth(gain, options.min_information_gain));
    }
    if (options.max_words > 0)
        model = keep_words(
            model, best_words(word_worth(model.shapes, options.measure, options.threads), options.max_words));
    detail::weigh_occurrences(model.shapes);
    return model;
}

/// @brief Learns a model from `count` images that `source` gives (see harvest()). Background images are
/// allowed.
/// @param class_names  names of the classes that LabelledObject::class_index points to
/// @throws Error as harvest() and learn() do.
template <Detector D, Descriptor Desc, TrainingSource Source>
[[nodiscard]] Model<D, Desc> train(std::span<const std::string> class_names, std::size_t count,
                                   const Source& source, const TrainOptions& options = {},
                                   const Extractor<D, Desc>& extractor = {}) {
    const HarvestOptions harvesting{
        .max_features = options.max_features, .threads = options.threads, .progress = options.progress};
    auto harvested = harvest(class_names, count, source, extractor, harvesting);
    auto model = learn(harvested, options);
    const std::vector<std::uint32_t> first_object = std::move(harvested.first_object);
    harvested = {};  // its descriptors are many
    if (options.appearance)
        model.shapes.appearance =
            learn_appearance(model, first_object, source, {}, options.threads, options.progress);
    return model;
}

/// @brief Learns a model from images in memory.
template <Detector D, Descriptor Desc>
[[nodiscard]] Model<D, Desc> train(std::span<const std::string> class_names,
                                   std::span<const TrainingImage> images, const TrainOptions& options = {},
                                   const Extractor<D, Desc>& extractor = {}) {
    const auto source = [&](std::size_t i) -> const TrainingImage& { return images[i]; };
    return train<D, Desc>(class_names, images.size(), source, options, extractor);
}

}  // namespace ism
