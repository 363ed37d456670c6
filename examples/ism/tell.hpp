// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ism/dataset/coco_results.hpp"

namespace program {

/// What was found in an image, to be told.
struct FoundInImage {
    std::string name;                           ///< of the image
    std::optional<std::int64_t> image_id = {};  ///< of a data set
    int width = 0, height = 0;                  ///< pixels
    std::vector<ism::Result> results = {};      ///< strongest first
    std::optional<ism::Result> next_best = {};  ///< the most probable of what --min-score left out
    bool best_is_cut_out = false;               ///< so that its mask has judged it
};

/// One line an object, its fields separated by tabulators: image, class, probability, x, y, width, height,
/// depth, X, Y, Z, scatter of their votes; "-" where something is not known.
[[nodiscard]] std::string object_lines(const FoundInImage& found);

/// The objects of all images as a table for people; without the images' names where there is one alone.
[[nodiscard]] std::string object_table(std::span<const FoundInImage> found);

/// An image as a line of JSON: file, width, height, detections; image_id of a data set, next_best where
/// nothing was told.
[[nodiscard]] std::string json_line(const FoundInImage& found);

/// "photo.jpg: nothing found; the best guess is car, 12 %, …".
[[nodiscard]] std::string nothing_found_text(const FoundInImage& found);

}  // namespace program
