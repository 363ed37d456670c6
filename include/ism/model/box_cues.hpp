// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "ism/config.hpp"

namespace ism {

/// @brief Samples along a side of a box of any aspect at which a figure is known.
inline constexpr int figure_samples = 32;
inline constexpr std::size_t figure_numbers = std::size_t(figure_samples) * figure_samples;

/// @brief Where in its box an object of a class is to be expected: share of figure, 0 … 1, of each sample,
/// row after row.
using ClassFigure = std::vector<float>;

/// @brief What speaks for and against an object of a class in a box.
struct BoxCues {
    double margin = 0;         ///< of the template
    double word_logit = 0;     ///< of the words in the box, see BoxClassifier
    double vote_weight = 0;    ///< of the votes that stand for about this box
    double color_overlap = 1;  ///< of figure and ground, 0 … 1, see color_overlap()
};

/// @brief How many margins of a template each other cue is worth.
struct CueWeights {
    double words = 0;   ///< a logit of the words
    double votes = 0;   ///< e times the vote weight
    double colors = 0;  ///< colours of figure and ground that have nothing in common
    [[nodiscard]] bool operator==(const CueWeights&) const = default;

    /// @brief The margin of all cues together.
    [[nodiscard]] double margin(const BoxCues& cues) const {
        return cues.margin + words * cues.word_logit + votes * std::log(0.1 + cues.vote_weight) -
               colors * cues.color_overlap;
    }
};

}  // namespace ism
