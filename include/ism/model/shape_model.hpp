// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
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
    std::vector<std::int64_t> category_ids =
        {};  ///< the training file's number of each class; empty = not known
    std::vector<TrainingObject> objects = {};
    Grouped<Occurrence> occurrences = {};
    std::vector<OccurrenceFrame> frames = {};  ///< Occurrence::feature points to one; empty = none

    /// @brief Occurrence number i, counted through all words: what Support::occurrence points to.
    [[nodiscard]] const Occurrence& occurrence(std::size_t i) const { return occurrences.values()[i]; }
};

/// @brief The number of each class in results: that of the training file, or 1, 2, … where that is not known.
[[nodiscard]] inline std::vector<std::int64_t> result_category_ids(const ShapeModel& shapes) {
    std::vector<std::int64_t> ids = shapes.category_ids;
    for (std::size_t c = ids.size(); c < shapes.class_names.size(); ++c) ids.push_back(std::int64_t(c) + 1);
    return ids;
}

}  // namespace ism
