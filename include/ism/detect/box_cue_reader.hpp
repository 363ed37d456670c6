// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "ism/core/color_bins.hpp"
#include "ism/core/image.hpp"
#include "ism/detect/box_colors.hpp"
#include "ism/detect/voted_boxes.hpp"
#include "ism/hog/describe_cells.hpp"
#include "ism/hog/fisher_vector.hpp"
#include "ism/hog/hog_pyramid.hpp"
#include "ism/hog/search_box.hpp"
#include "ism/model/box_classifier.hpp"
#include "ism/model/box_cues.hpp"
#include "ism/model/figure_colors.hpp"
#include "ism/model/patch_classifier.hpp"

namespace ism {

/// @brief What judges boxes beside templates. What is not given has nothing to say.
struct BoxJudges {
    const BoxClassifier* words = nullptr;
    const PatchClassifier* patches = nullptr;
    std::span<const ClassFigure> figures = {};  ///< of each class; where they are not given no colours speak
    std::span<const FigureColors> colors = {};  ///< of each class
    std::span<const TypicalSize> sizes = {};    ///< of each class
};

/// @brief What an image shows to those who judge boxes on it.
struct JudgedImage {
    const HogPyramid& pyramid;
    ImageView<const Rgb> color;
    const VotedBoxes& voted;
    const WordMap& words;
};

/// @brief Reads in an image what speaks for and against boxes, in training as in detection. Several threads
/// may ask one reader.
class BoxCueReader {
public:
    /// @param judges, image  what they point to has to stay as long as this
    BoxCueReader(const BoxJudges& judges, const JudgedImage& image) : judges_(judges), image_(image) {
        if (judges_.patches) encoder_.emplace(judges_.patches->mixture);
    }

    /// @brief What speaks for a class in a box that its template found; of patches only where the judges know
    /// the class.
    [[nodiscard]] BoxCues cues(std::uint32_t class_index, const SearchedBox& found,
                               CellScratch& scratch) const {
        const Box& box = found.box;
        BoxCues cues{.margin = found.score,
                     .vote_weight = image_.voted.weight(class_index, box),
                     .vote_share = image_.voted.share(class_index, box)};
        if (judges_.words) cues.word_logit = judges_.words->logit(class_index, image_.words.histogram(box));
        if (judges_.patches && judges_.patches->knows(class_index))
            cues.patch_margin =
                judges_.patches->margin(class_index, encoder_->encode(image_.pyramid, box, scratch));
        if (class_index < judges_.figures.size()) {
            const BoxColors shown = box_colors(image_.color, box, judges_.figures[class_index], to_lab_);
            cues.color_overlap = color_overlap(shown);
            if (class_index < judges_.colors.size())
                cues.color_odds = color_odds(shown, judges_.colors[class_index]);
        }
        if (class_index < judges_.sizes.size())
            cues.log_size =
                log_size(box, image_.color.width(), image_.color.height(), judges_.sizes[class_index]);
        return cues;
    }

private:
    BoxJudges judges_;
    JudgedImage image_;
    std::optional<FisherEncoder> encoder_;
    LabTable to_lab_;
};

}  // namespace ism
