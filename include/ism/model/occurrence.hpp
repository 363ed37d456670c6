// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ism/core/image.hpp"
#include "ism/feature/feature.hpp"
#include "ism/model/appearance.hpp"

namespace ism {

/// @brief The size every training object is brought to, pixels: the root of its box's area. Scale 1 in the
/// vote spaces means an object of this size, whatever size it had in its training image (Zhang and Kjellström
/// scale their training images to one width).
inline constexpr double reference_size_px = 200;

/// @brief Pixels of the reference size that one cell of a stored object mask covers, along each side.
inline constexpr double mask_cell_px = 2;

/// @brief One place on a training object where a word was seen (O_i of Eqs 1 and 4). Positions and scales are
/// those at the reference size.
struct Occurrence {
    float x = 0, y = 0;        ///< x_i, y_i: from the object's centre to the feature, pixels
    float scale = 1;           ///< s_i: of the feature, pixels
    float depth_m = no_depth;  ///< of the feature behind the object's centre, metres; NaN = not known
    float weight = 1;          ///< p(occurrence | word); those of one word and group add up to 1
    std::uint32_t class_index = 0;
    std::uint32_t object = 0;   ///< the training object it was seen on
    std::uint32_t feature = 0;  ///< number of the training feature it comes from
};

/// @brief A training object at the reference size. The mask patch of an occurrence is the part of its
/// object's mask around the occurrence.
struct TrainingObject {
    std::uint32_t class_index = 0;
    float width = 0, height = 0;  ///< of its box, pixels at the reference size; the centre is the box's
    float size_px = 0;            ///< root of its box's area in the training image
    Mask mask;                    ///< the box in cells of mask_cell_px: share of figure, 0 … 255
    std::string image;            ///< name of the training image, to tell why something was found
};

/// @brief The part of a model that knows classes: on which objects, and where on them, each word occurs, and
/// what boxes of a class hold.
struct Shapes {
    std::vector<std::string> class_names;
    std::vector<TrainingObject> objects;
    std::vector<Occurrence> occurrences;  ///< those of one word after those of another
    std::vector<std::uint32_t> first;     ///< word w has occurrences first[w] … first[w + 1] − 1
    Appearance appearance;                ///< judges hypotheses; may be empty

    [[nodiscard]] std::span<const Occurrence> of_word(std::size_t word) const {
        return std::span(occurrences).subspan(first[word], first[word + 1] - first[word]);
    }
    [[nodiscard]] std::span<Occurrence> of_word(std::size_t word) {
        return std::span(occurrences).subspan(first[word], first[word + 1] - first[word]);
    }
};

}  // namespace ism
