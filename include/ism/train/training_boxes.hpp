// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "ism/core/geometry.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/progress.hpp"
#include "ism/core/shared.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/recognition.hpp"
#include "ism/model/box_classifier.hpp"
#include "ism/train/train_options.hpp"
#include "ism/train/training_features.hpp"

namespace ism {

/// @brief A box of a training image to learn from: a labelled one, or that of a hypothesis.
struct TrainingBox {
    static constexpr std::uint32_t background = std::numeric_limits<std::uint32_t>::max();
    std::vector<SparseEntry> histogram = {};  ///< of the words in it
    std::uint32_t true_class = background;    ///< of the object that it overlaps most, however little
    std::uint32_t predicted_class = 0;        ///< of the hypothesis; of a labelled box its own
    double overlap = 1;                       ///< with that object, IoU
    double score = std::nan("");              ///< of the hypothesis' votes; NaN for a labelled box
    std::size_t view = 0;                     ///< of TrainingFeatures

    [[nodiscard]] bool is_hypothesis() const { return !std::isnan(score); }
};

namespace detail {

/// The words of a model, made ready for match(), by channel.
using WordIndices = std::vector<Shared<const WordIndex>>;

[[nodiscard]] inline WordIndices word_indices(const Model& model) {
    WordIndices words;
    for (const Channel& channel : model.channels)
        words.push_back(Shared<const WordIndex>::make(channel.codebook));
    return words;
}

/// The features of a training image with their matches to the words of a model.
[[nodiscard]] inline Scene training_scene(const TrainingView& view, const Model& model,
                                          const WordIndices& words, const Frame& blank, ThreadPool& pool) {
    Scene scene{.frame = blank, .model = model, .pool = pool};
    for (std::size_t c = 0; c < words.size(); ++c) {
        const auto& [features, descriptors] = view.channels[c];
        add_channel(scene, features, match(*words[c], descriptors, pool), model.first_word(c));
    }
    return scene;
}

/// The votes in a training image without those of its own objects.
template <ImageVoteSpace Space>
[[nodiscard]] std::vector<Vote<Space::dimension>> votes_of_others(const TrainingView& view,
                                                                  const Scene& scene,
                                                                  const DetectOptions& search) {
    VoteLimits limits = vote_limits(scene, search);
    limits.without_first = view.first_object, limits.without_end = view.end_object;
    return cast_votes<Space>(scene, search.matching, limits);
}

/// What they find.
template <ImageVoteSpace Space>
[[nodiscard]] std::vector<Detection> find_hypotheses_of_others(const TrainingView& view, const Scene& scene,
                                                               const DetectOptions& search) {
    return find_hypotheses<EpanechnikovKernel, Space::dimension>(
        scene, votes_of_others<Space>(view, scene, search), default_bandwidth<Space>(), search);
}

[[nodiscard]] inline TrainingBox labelled_box(const ObjectLabel& label, const WordMap& words) {
    return {.histogram = words.histogram(label.box),
            .true_class = label.class_index,
            .predicted_class = label.class_index};
}

/// A hypothesis, with the object that it overlaps most.
[[nodiscard]] inline TrainingBox hypothesis_box(std::uint32_t class_index, const Box& box, double score,
                                                const std::vector<ObjectLabel>& labels,
                                                const WordMap& words) {
    TrainingBox result{
        .histogram = words.histogram(box), .predicted_class = class_index, .overlap = 0, .score = score};
    for (const ObjectLabel& label : labels)
        if (const double shared = iou(box, label.box); shared > result.overlap) {
            result.overlap = shared;
            result.true_class = label.class_index;
        }
    return result;
}

/// The boxes of one image: those labelled, and those of hypotheses found without votes of its own objects.
template <ImageVoteSpace Space>
[[nodiscard]] std::vector<TrainingBox> boxes_of_view(const TrainingView& view, const Scene& scene,
                                                     const DetectOptions& search) {
    const WordMap words(scene.features, scene.matches, scene.model.words());
    std::vector<TrainingBox> boxes;
    for (const ObjectLabel& label : view.labels) boxes.push_back(labelled_box(label, words));
    for (const Detection& guess : find_hypotheses_of_others<Space>(view, scene, search)) {
        TrainingBox box = hypothesis_box(guess.class_index, guess.box, guess.score, view.labels, words);
        if (box.overlap >= right_iou || !is_ignored(guess.box, view.ignored)) boxes.push_back(std::move(box));
    }
    return boxes;
}

}  // namespace detail

/// @brief The boxes of all training images to learn from: what is labelled, and what the model finds in each
/// image when it has not seen its objects (leave one image out). Background images give hypotheses too.
/// @param model  learnt from the same training features
/// @tparam Space  in which it votes
/// @return by view; the same for any number of threads
template <ImageVoteSpace Space = Jism>
[[nodiscard]] std::vector<TrainingBox> training_boxes(const Model& model, const TrainingFeatures& features,
                                                      std::size_t max_hypotheses, unsigned threads = 0,
                                                      const Progress& progress = {}) {
    const std::size_t views = features.views.size();
    if (views == 0) return {};
    const std::size_t images = std::max<std::size_t>(1, features.summary.images);
    const DetectOptions search{.max_candidates = std::max<std::size_t>(3, max_hypotheses / images)};
    const detail::WordIndices words = detail::word_indices(model);
    std::vector<std::vector<TrainingBox>> parts(views);
    ProgressCounter counter(progress, "trying on training images", views);
    parallel_for(views, threads, [&](std::size_t v) {
        const TrainingView& view = features.views[v];
        const Frame blank{.gray = GrayImage(view.width, view.height)};
        ThreadPool pool(1);
        parts[v] = detail::boxes_of_view<Space>(view, detail::training_scene(view, model, words, blank, pool),
                                                search);
        for (TrainingBox& box : parts[v]) box.view = v;
        counter.step();
    });
    std::vector<TrainingBox> boxes;
    for (auto& part : parts)
        for (TrainingBox& box : part) boxes.push_back(std::move(box));
    return boxes;
}

}  // namespace ism
