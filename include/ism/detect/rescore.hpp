// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <utility>
#include <vector>

#include "ism/detect/detection.hpp"
#include "ism/detect/scene.hpp"
#include "ism/model/box_classifier.hpp"

namespace ism {

/// @brief Judges hypotheses by more than their votes. To model it, write a small struct with its options as
/// members and `std::vector<Detection> rescore(std::vector<Detection>, const Scene&) const`, which gives new
/// scores, 0 or more, and may also drop hypotheses, add some, or move their boxes. What it learns in training
/// it reads from the scene's model.
template <class R>
concept Rescorer = std::copyable<R> &&
    requires(const R& rescorer, std::vector<Detection> hypotheses, const Scene& scene) {
    { rescorer.rescore(std::move(hypotheses), scene) } -> std::same_as<std::vector<Detection>>;
};

/// @brief Leaves hypotheses with the score of their votes (the paper's way), whose probability is not known.
struct NoRescorer {
    [[nodiscard]] std::vector<Detection> rescore(std::vector<Detection> hypotheses, const Scene&) const {
        return hypotheses;
    }
};

/// @brief Multiplies the score of a hypothesis by the probability that its box shows its class, where the
/// model has a classifier of boxes, and tells the probability of this score, where the model knows it.
struct BoxClassifierScore {
    [[nodiscard]] std::vector<Detection> rescore(std::vector<Detection> hypotheses,
                                                 const Scene& scene) const {
        const BoxClassifier& classifier = scene.model.box_classifier;
        const WordMap words(scene.features, scene.matches, scene.model.words());
        scene.pool.for_each(hypotheses.size(), [&](std::size_t i, unsigned) {
            Detection& one = hypotheses[i];
            if (!classifier.empty())
                one.score *= classifier.probability(one.class_index, words.histogram(one.box));
            one.probability = scene.model.calibration.probability(one.class_index, one.score);
        });
        return hypotheses;
    }
};

}  // namespace ism
