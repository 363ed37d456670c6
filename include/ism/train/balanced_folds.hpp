// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "ism/core/order.hpp"
#include "ism/train/training_image.hpp"

namespace ism::detail {

/// Which of so many folds each image belongs to, so that each fold has its share of the images of each class:
/// from the class that fewest images show on, each of its images joins the fold that shows the class least.
/// Images without objects take turns.
[[nodiscard]] inline std::vector<std::size_t> balanced_folds(
    const std::vector<std::vector<ObjectLabel>>& labels, std::size_t classes, std::size_t folds) {
    constexpr auto none = std::numeric_limits<std::size_t>::max();
    std::vector<std::vector<std::size_t>> showing(classes + 1);  // images of each class; the last: of none
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (labels[i].empty()) showing[classes].push_back(i);
        for (const ObjectLabel& label : labels[i]) {
            std::vector<std::size_t>& images = showing[label.class_index];
            if (images.empty() || images.back() != i) images.push_back(i);
        }
    }
    std::vector<std::size_t> rarest_first(classes + 1);
    for (std::size_t c = 0; c <= classes; ++c) rarest_first[c] = c;
    sort_by(rarest_first, [&](std::size_t c) { return std::uint64_t(showing[c].size()); });
    std::vector<std::size_t> fold_of(labels.size(), none);
    for (const std::size_t c : rarest_first) {
        std::vector<std::size_t> seen(folds, 0);
        for (const std::size_t i : showing[c])
            if (fold_of[i] != none) ++seen[fold_of[i]];
        for (const std::size_t i : showing[c]) {
            if (fold_of[i] != none) continue;
            fold_of[i] = std::size_t(std::min_element(seen.begin(), seen.end()) - seen.begin());
            ++seen[fold_of[i]];
        }
    }
    return fold_of;
}

}  // namespace ism::detail
