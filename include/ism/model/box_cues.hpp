// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "ism/core/geometry.hpp"

namespace ism {

/// @brief Samples along a side of a box of any aspect at which a figure is known.
inline constexpr int figure_samples = 32;
inline constexpr std::size_t figure_numbers = std::size_t(figure_samples) * figure_samples;

/// @brief Where in its box an object of a class is to be expected: share of figure, 0 … 1, of each sample,
/// row after row.
using ClassFigure = std::vector<float>;

/// @brief How large objects of a class were in training: logarithms of areas of boxes, medians.
struct TypicalSize {
    double log_px = 0;    ///< square pixels
    double log_part = 0;  ///< parts of their picture
    [[nodiscard]] bool operator==(const TypicalSize&) const = default;
};

/// @brief How small a box is for its class: the logarithm of its area beside what is typical, 0 where it is
/// no smaller. What is small in a wide picture may have all its pixels, and what has few may be all of a
/// small picture: the larger of both counts.
[[nodiscard]] inline double log_size(const Box& box, int width, int height, const TypicalSize& typical) {
    const double log_px = std::log(box.area()), log_part = log_px - std::log(double(width) * double(height));
    return std::min(0.0, std::max(log_px - typical.log_px, log_part - typical.log_part));
}

/// @brief What speaks for and against an object of a class in a box.
struct BoxCues {
    double margin = 0;         ///< of the template
    double word_logit = 0;     ///< of the words in the box, see BoxClassifier
    double patch_margin = 0;   ///< of what its patches look like, see PatchClassifier
    double vote_weight = 0;    ///< of the votes that stand for about this box
    double vote_share = 1;     ///< of the class in that of all classes, see VotedBoxes::share()
    double color_overlap = 1;  ///< of figure and ground, 0 … 1, see color_overlap()
    double color_odds = 0;     ///< of figure and ground, by the colours of the class, see color_odds()
    double log_size = 0;       ///< 0 or less, see log_size(): false boxes are mostly small
};

/// @brief What each cue adds to the margin of all, or, together with `any`, which is the same for all boxes
/// of a class, to the logarithm of the odds that a box shows it.
struct BoxReasons {
    double look = 0;  ///< the template
    double patches = 0, words = 0, votes = 0;
    double share = 0;     ///< of the class in all votes there
    double contrast = 0;  ///< colours shared with what is around
    double colors = 0;    ///< those of the class
    double size = 0;
    double any = 0;
    double rivals = 0;  ///< what else may be at the same place, see yield_to_rivals()
    double mask = 0;    ///< what was cut out, see weigh_masks(); only in logarithms of odds

    [[nodiscard]] bool empty() const { return look == 0 && any == 0; }
    [[nodiscard]] double sum() const {
        return look + patches + words + votes + share + contrast + colors + size + any + rivals + mask;
    }
    /// @brief Margins in logarithms of odds, by the curve of a class (Calibration).
    [[nodiscard]] BoxReasons in_odds(double slope, double offset) const {
        return {.look = slope * look,
                .patches = slope * patches,
                .words = slope * words,
                .votes = slope * votes,
                .share = slope * share,
                .contrast = slope * contrast,
                .colors = slope * colors,
                .size = slope * size,
                .any = offset,
                .rivals = slope * rivals};
    }
};

/// @brief How many margins of a template each other cue is worth.
struct CueWeights {
    double patches = 0;   ///< a margin of the patches below 0: they speak against boxes, not for them
    double words = 0;     ///< a logit of the words
    double votes = 0;     ///< e times the vote weight
    double share = 0;     ///< e times the share in the votes of all classes
    double contrast = 0;  ///< colours of figure and ground that have nothing in common
    double colors = 0;    ///< a logarithm of odds of the colours of the class
    double size = 0;      ///< e times the area, up to what is typical
    [[nodiscard]] bool operator==(const CueWeights&) const = default;

    /// @brief What each cue adds to the margin of all.
    [[nodiscard]] BoxReasons reasons(const BoxCues& cues) const {
        return {.look = cues.margin,
                .patches = patches * std::min(0.0, cues.patch_margin),
                .words = words * cues.word_logit,
                .votes = votes * std::log(0.1 + cues.vote_weight),
                .share = share * std::log(cues.vote_share),
                .contrast = -contrast * cues.color_overlap,
                .colors = colors * cues.color_odds,
                .size = size * cues.log_size};
    }
    /// @brief The margin of all cues together.
    [[nodiscard]] double margin(const BoxCues& cues) const { return reasons(cues).sum(); }
};

}  // namespace ism
