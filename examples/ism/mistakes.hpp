// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "ism/dataset/coco_results.hpp"
#include "ism/dataset/dataset.hpp"
#include "ism/show/report_detections.hpp"

namespace program {

/// What is wrong with what was told of an image, by IoU .5.
struct Mistakes {
    std::vector<std::string> missed = {}, wrong = {};  ///< classes, and of wrong detections how probable
    std::vector<std::size_t> missed_objects = {};      ///< the same as indices into the image's objects
    std::vector<ism::Judged> judged = {};              ///< each result
    std::vector<double> weights = {};  ///< 1 of each object missed, then how probable what is wrong is
    double weight = 0;                 ///< the sum

    /// "missed: cow; wrong: horse 62 %", or nothing.
    [[nodiscard]] std::string text() const;
};

/// The mistakes of each image of a labelled data set.
[[nodiscard]] std::vector<Mistakes> find_mistakes(const ism::Dataset& dataset,
                                                  std::span<const std::vector<ism::Result>> of_image);

}  // namespace program
