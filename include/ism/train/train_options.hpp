// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/function.hpp"
#include "ism/core/progress.hpp"

namespace ism {

struct ShapeModel;

/// @brief How features are collected from training images.
struct TrainingFeatureOptions {
    std::size_t max_features =
        40000;                      ///< of all objects together: each gives its share, the strongest, or 30
    bool choose_upsampling = true;  ///< small objects are enlarged; false: as the extractor says
    bool views = true;    ///< also keep all features of the images, which box classifier and calibration need
    bool pixels = false;  ///< also keep the images' colours, which templates need
    bool depth =
        false;  ///< also keep what images with depth and camera tell of it, which learn_metric() needs

    /// @brief Whether views of the mirrored images are kept too, for the classifier of words. Templates look
    /// at both sides themselves, and learn_metric() reads none of them.
    [[nodiscard]] constexpr bool mirror() const { return views && !pixels && !depth; }
};

/// @brief Whether classes share words.
enum class CodebookKind {
    joint,      ///< one codebook of all classes (the paper's)
    per_class,  ///< each class has words of its own, as separate models have
};

/// @brief How words are made.
struct CodebookOptions {
    CodebookKind kind = CodebookKind::joint;
    double min_similarity = 0.82;      ///< clustering and matching cut-off; 1 = equal, 0 = unrelated
    std::size_t min_cluster_size = 2;  ///< smaller clusters make no word (T_Q + 1)
    std::size_t max_features = 30000;  ///< of more features a random part is clustered; all are matched
    std::uint64_t seed = 1;            ///< chooses that part
};

/// @brief What each word of a model is worth: one number a word, 0 or more; larger is better. See
/// word_occurrences(), word_information_gain() and vote_agreement().
using WordWorth = Function<std::vector<double>(const ShapeModel& shapes, unsigned threads)>;

/// @brief Which words stay.
struct WordSelection {
    double min_information_gain = 0;  ///< words that tell less about the class are dropped (T_IG)
    std::size_t max_words = 0;        ///< of more words the best stay; 0 = all
    WordWorth worth = {};             ///< what is best; none = word_information_gain()
};

/// @brief How the classifier of boxes is fitted, on labelled boxes and on hypotheses in training images whose
/// own objects cast no votes.
struct BoxClassifierOptions {
    double regularisation = 1e-3;       ///< of the squared weights
    double tolerance = 0.01;            ///< of the probabilities, for an end
    int max_rounds = 100;               ///< over all boxes
    std::size_t max_hypotheses = 5000;  ///< of all images together, at least 3 an image
    std::size_t max_others = 100;       ///< boxes of other classes that a class also learns from
    double same_iou = 0.5;              ///< a hypothesis that overlaps an object so far shows it
    double other_iou = 0.3;             ///< one that overlaps all less is background; between is left out
};

/// @brief How a model is trained.
struct TrainOptions {
    TrainingFeatureOptions features = {};
    CodebookOptions codebook = {};
    WordSelection selection = {};
    std::optional<BoxClassifierOptions> box_classifier = BoxClassifierOptions{};  ///< none = votes alone
    bool calibrate = true;  ///< also learn how scores become probabilities
    unsigned threads = 0;   ///< 0 = all hardware threads
    Progress progress = {};
};

/// @brief Validates options.
/// @throws Error for one out of range.
inline void check(const CodebookOptions& options) {
    expect(options.min_similarity > -1 && options.min_similarity <= 1, "CodebookOptions::min_similarity",
           "above -1, at most 1", options.min_similarity);
    expect(options.min_cluster_size > 0, "CodebookOptions::min_cluster_size", "1 or more", 0);
    expect(options.max_features > 1, "CodebookOptions::max_features", "2 or more", options.max_features);
}

/// @brief Validates options.
/// @throws Error for one out of range.
inline void check(const BoxClassifierOptions& options) {
    expect(options.regularisation >= 1e-12 && options.regularisation <= 1e6,
           "BoxClassifierOptions::regularisation", "1e-12 ... 1e6", options.regularisation);
    expect(options.tolerance >= 0, "BoxClassifierOptions::tolerance", "0 or more", options.tolerance);
    expect(options.max_rounds >= 0, "BoxClassifierOptions::max_rounds", "0 or more", options.max_rounds);
    expect(options.same_iou > 0 && options.same_iou <= 1, "BoxClassifierOptions::same_iou",
           "above 0, at most 1", options.same_iou);
    expect(options.other_iou >= 0 && options.other_iou <= options.same_iou, "BoxClassifierOptions::other_iou",
           "0 ... same_iou", options.other_iou);
}

/// @brief Validates options.
/// @throws Error for one out of range.
inline void check(const TrainOptions& options) {
    expect(options.features.max_features > 0, "TrainingFeatureOptions::max_features", "1 or more", 0);
    check(options.codebook);
    expect(options.selection.min_information_gain >= 0, "WordSelection::min_information_gain", "0 or more",
           options.selection.min_information_gain);
    if (options.box_classifier) check(*options.box_classifier);
}

}  // namespace ism
