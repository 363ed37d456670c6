// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "ism/core/grouped.hpp"
#include "ism/model/occurrence.hpp"
#include "ism/model/occurrence_frame.hpp"
#include "ism/model/training_object.hpp"

namespace ism {

/// @brief The Implicit Shape Model proper: on which objects, and where on them, each word was seen
/// ("spatial occurrence distributions", Leibe et al. 2008). occurrences[w] are those of word w, in the order
/// of their features; each occurrence points to one of `objects`.
struct ShapeModel {
    std::vector<std::string> class_names = {};
    std::vector<TrainingObject> objects = {};
    Grouped<Occurrence> occurrences = {};
    std::vector<OccurrenceFrame> frames = {};  ///< Occurrence::feature points to one; empty = none

    /// @brief Occurrence number i, counted through all words: what Support::occurrence points to.
    [[nodiscard]] const Occurrence& occurrence(std::size_t i) const { return occurrences.values()[i]; }
};

}  // namespace ism
