// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ism/codebook/byte_codebook.hpp"
#include "ism/codebook/match.hpp"
#include "ism/core/random.hpp"
#include "ism/detect/harvest.hpp"
#include "ism/detect/learn_appearance.hpp"
#include "ism/detect/model.hpp"
#include "ism/detect/select_words.hpp"
#include "ism/detect/set_occurrences.hpp"

namespace ism {

/// @brief Whether classes share words.
enum class CodebookKind {
    joint,      ///< one codebook of all classes (the paper's)
    per_class,  ///< each class has words of its own, as separate models have
};

/// @brief How a model is trained.
struct TrainOptions {
    double min_similarity = 0.82;      ///< clustering and matching cut-off; 1 = equal, 0 = unrelated
    std::size_t min_cluster_size = 2;  ///< smaller clusters make no word (T_Q + 1)
    double min_information_gain = 0;   ///< words that tell less about the class are dropped (T_IG)
    std::size_t max_words = 0;         ///< of more words the best by `measure` stay; 0 = all
    WordMeasure measure = WordMeasure::vote_agreement;
    CodebookKind codebook = CodebookKind::joint;
    std::size_t max_features = 40000;  ///< see HarvestOptions
    std::size_t max_cluster_features =
        30000;               ///< of more features a random part is clustered; all are matched
    std::uint64_t seed = 1;  ///< chooses that part
    bool memory = false;     ///< also keep the descriptors, so that the model can grow well: see Model
    bool appearance = true;  ///< also learn what boxes of each class hold, to judge hypotheses
    unsigned threads = 0;    ///< 0 = all the machine has
    Progress progress = {};
};

namespace detail {

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
               join_text("at most that of the best word, ", best), options.min_information_gain);
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
