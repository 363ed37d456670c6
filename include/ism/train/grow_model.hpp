// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ism/codebook/match.hpp"
#include "ism/core/random.hpp"
#include "ism/model/model.hpp"
#include "ism/train/grow_codebook.hpp"
#include "ism/train/harvest.hpp"
#include "ism/train/learn_words.hpp"
#include "ism/train/move_occurrences.hpp"
#include "ism/train/set_occurrences.hpp"

namespace ism {

/// @brief How a model grows. Similarity is that of the model.
struct GrowOptions {
    std::size_t min_cluster_size = 2;          ///< smaller clusters of new features make no word
    std::size_t max_cluster_features = 30000;  ///< of more new features a random part is clustered
    std::uint64_t seed = 1;                    ///< chooses that part
    unsigned threads = 0;                      ///< 0 = all the machine has
};

/// @brief A model that has learnt more, and where the words and classes of it are.
template <Detector D, Descriptor Desc>
struct GrownModel {
    Model<D, Desc> model;                  ///< without a judge of boxes
    std::vector<std::uint32_t> word_now;   ///< of each word of the model of before
    std::vector<std::uint32_t> class_now;  ///< of each class of the harvest
};

namespace detail {

/// The index of each name in `names`, which it is put into where it is not.
[[nodiscard]] inline std::vector<std::uint32_t> join_names(std::vector<std::string>& names,
                                                           std::span<const std::string> added) {
    std::vector<std::uint32_t> index;
    for (const std::string& name : added) {
        const auto found = std::find(names.begin(), names.end(), name);
        index.push_back(static_cast<std::uint32_t>(found - names.begin()));
        if (found == names.end()) names.push_back(name);
    }
    return index;
}

/// @throws Error unless a harvest can be added to a model.
template <Detector D, Descriptor Desc>
void check_growth(const Model<D, Desc>& model, const Harvest<D, Desc>& added, const GrowOptions& options) {
    expect(options.min_cluster_size > 0, "growing a model: smallest cluster size", "1 or more", 0);
    expect(options.max_cluster_features > 1, "growing a model: most features to cluster", "2 or more",
           options.max_cluster_features);
    expect(!added.seen.empty() && !added.objects.empty(), "growing a model: new objects and features",
           "1 or more", 0);
    expect(added.descriptors.size() == added.seen.size(), "growing a model: descriptors", added.seen.size(),
           added.descriptors.size());
    expect(added.extractor.options.upsampling == model.extractor.options.upsampling,
           "growing a model: upsampling of the new images (see HarvestOptions::choose_upsampling)",
           model.extractor.options.upsampling, added.extractor.options.upsampling);
    for (const Occurrence& o : added.seen) {
        expect(o.class_index < added.class_names.size(), "growing a model: class of a feature",
               lazy_text("below ", added.class_names.size()), o.class_index);
        expect(o.object < added.objects.size(), "growing a model: object of a feature",
               lazy_text("below ", added.objects.size()), o.object);
    }
    for (const Occurrence& o : model.shapes.occurrences)
        expect(model.memory.empty() || o.feature < model.memory.size(), "growing a model: feature",
               lazy_text("below the ", model.memory.size(), " that are kept"), o.feature);
    for (const std::uint32_t group : model.codebook.group)
        expect(group == 0, "growing a model: its codebook", "a joint one", "one of words for each class");
}

}  // namespace detail

/// @brief Teaches a model more objects, of new classes or of classes it has (the same names), without the
/// images it was trained with. New features grow the codebook (see grow_codebook()) and are matched to all
/// words. Features of before are matched again where the model has kept their descriptors
/// (TrainOptions::memory). Else their occurrences move with their words, but none is at a new word, so that
/// new classes win too often. Weights are taken again.
/// @param added  from harvest() with the model's extractor and `choose_upsampling` off
/// @throws Error where there is no new object or the codebook is not joint.
template <Detector D, Descriptor Desc>
[[nodiscard]] GrownModel<D, Desc> grow_model(const Model<D, Desc>& model, const Harvest<D, Desc>& added,
                                             const GrowOptions& options = {}) {
    detail::check_growth(model, added, options);
    std::vector<std::size_t> rows(added.descriptors.size());
    std::iota(rows.begin(), rows.end(), std::size_t(0));
    if (rows.size() > options.max_cluster_features) {
        Random random(options.seed);
        rows = detail::random_part(rows.size(), options.max_cluster_features, random);
    }
    auto grown = grow_codebook(model.codebook,
                               detail::chosen_as_float(added.descriptors, std::span<const std::size_t>(rows)),
                               options.min_cluster_size, options.threads);

    Shapes shapes = model.shapes;
    shapes.appearance = {};
    std::vector<std::uint32_t> class_now = detail::join_names(shapes.class_names, added.class_names);
    auto all = detail::moved_occurrences(model, grown.word_now, grown.codebook, options.threads);
    std::uint32_t features = static_cast<std::uint32_t>(model.memory.size());
    for (const Occurrence& o : model.shapes.occurrences) features = std::max(features, o.feature + 1);
    for (const Match& match : match(grown.codebook, added.descriptors, options.threads)) {
        Occurrence o = added.seen[match.feature];
        o.class_index = class_now[o.class_index];
        o.object += static_cast<std::uint32_t>(model.shapes.objects.size());
        o.feature = features + match.feature;
        all.push_back({match.word, o});
    }
    for (TrainingObject object : added.objects) {
        object.class_index = class_now[object.class_index];
        shapes.objects.push_back(std::move(object));
    }
    detail::set_occurrences(shapes, std::move(all), grown.codebook.size());
    detail::weigh_occurrences(shapes);
    GrownModel<D, Desc> result{.model = {.extractor = model.extractor,
                                         .codebook = std::move(grown.codebook),
                                         .shapes = std::move(shapes)},
                               .word_now = std::move(grown.word_now),
                               .class_now = std::move(class_now)};
    if (!model.memory.empty()) {
        result.model.memory = model.memory;
        for (std::size_t i = 0; i < added.descriptors.size(); ++i)
            result.model.memory.push_back(added.descriptors.row(i));
    }
    return result;
}

}  // namespace ism
