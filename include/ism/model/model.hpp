// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "ism/codebook/codebook.hpp"
#include "ism/feature/feature_settings.hpp"
#include "ism/hog/box_template.hpp"
#include "ism/model/box_classifier.hpp"
#include "ism/model/box_cues.hpp"
#include "ism/model/calibration.hpp"
#include "ism/model/figure_colors.hpp"
#include "ism/model/mask_exemplar.hpp"
#include "ism/model/mask_judge.hpp"
#include "ism/model/patch_classifier.hpp"
#include "ism/model/placing.hpp"
#include "ism/model/shape_model.hpp"
#include "ism/model/typical_mask.hpp"

namespace ism {

/// @brief A kind of features and the words they are matched to. A model may have several: words of different
/// descriptors vote together.
struct Channel {
    FeatureSettings features;  ///< how they are found and described
    Codebook codebook = {};
    /// How many of the nearest words a feature votes through, whatever the threshold, each with as much
    /// weight as it is nearer than the next one (McCann and Lowe 2012); 0 = all within the threshold.
    std::size_t neighbours = 0;
};

/// @brief What training saw, to be told.
struct TrainingSummary {
    std::size_t images = 0;          ///< background images included
    std::size_t features_found = 0;  ///< on the objects
    std::size_t features_used = 0;   ///< the strongest of them, where there were more than the limit
    [[nodiscard]] bool operator==(const TrainingSummary&) const = default;
};

/// @brief What training gives and detection needs, whatever the vote space, as plain data. Words are numbered
/// through all channels: those of a channel follow those of the channel before.
struct Model {
    std::vector<Channel> channels = {};
    ShapeModel shapes = {};
    BoxClassifier box_classifier = {};             ///< may be empty
    Calibration calibration = {};                  ///< of votes and box classifier; may be empty
    std::vector<BoxTemplate> templates = {};       ///< one a class; may be empty
    PatchClassifier patch_classifier = {};         ///< of boxes that templates placed; may be empty
    CueWeights cue_weights = {};                   ///< of what judges boxes with the templates
    std::vector<ClassFigure> figures = {};         ///< of each class; may be empty
    std::vector<TypicalSize> typical_sizes = {};   ///< of each class; may be empty
    Calibration template_calibration = {};         ///< of templates with the other cues; may be empty
    std::vector<MaskExemplar> exemplars = {};      ///< whose masks are lent; may be empty
    std::vector<FigureColors> figure_colors = {};  ///< of each class; may be empty
    std::vector<TypicalMask> typical_masks = {};   ///< of each class; may be empty
    std::vector<Placing> placings = {};            ///< of each class; may be empty
    MaskJudge mask_judge = {};                     ///< of regions of RGB-D images; may be empty
    TrainingSummary training = {};
    std::vector<Model> rgbd = {};  ///< none or one: the model of learn_metric() for frames with depth

    /// @brief Number of words of all channels.
    [[nodiscard]] std::size_t words() const { return first_word(channels.size()); }
    /// @brief Number of the first word of a channel.
    [[nodiscard]] std::size_t first_word(std::size_t channel) const {
        std::size_t words = 0;
        for (std::size_t c = 0; c < channel; ++c) words += channels[c].codebook.size();
        return words;
    }
    /// @brief FigureColors of a class; empty where they are not known.
    [[nodiscard]] std::span<const float> figure_colors_of(std::size_t class_index) const {
        if (class_index >= figure_colors.size()) return {};
        return figure_colors[class_index];
    }
    /// @brief How boxes of a class are placed; the usual way where it is not known.
    [[nodiscard]] Placing placing_of(std::size_t class_index) const {
        return class_index < placings.size() ? placings[class_index] : Placing{};
    }
};

/// @brief A model whose detector and descriptor the compiler knows: what train() returns and detect() takes.
/// A model of other features is another type.
template <Detector D, Descriptor Desc>
struct TypedModel : Model {
    TypedModel() = default;
    /// @throws Error where the model has other features, or several channels.
    explicit TypedModel(Model model) : Model(std::move(model)) { (void)extractor(); }

    /// @brief How its features are found.
    [[nodiscard]] Extractor<D, Desc> extractor() const {
        expect(channels.size() == 1, "model: channels of words", 1, channels.size());
        return extractor_from<D, Desc>(channels[0].features);
    }
};

}  // namespace ism
