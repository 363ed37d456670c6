// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/evaluate/matching.hpp"

namespace ism {

/// @brief A confusion matrix: images by true class (rows) and predicted class (columns).
struct Confusion {
    std::size_t class_count = 0;
    std::vector<std::size_t>
        counts;  ///< class_count rows (true class) of class_count + 1 (found class, none)

    /// @brief Images of class `truth` predicted as `found`; `found == class_count`: nothing was detected.
    [[nodiscard]] std::size_t count(std::size_t truth, std::size_t found) const {
        return counts.at(truth * (class_count + 1) + found);
    }
    /// @brief Images of class `truth`.
    [[nodiscard]] std::size_t images(std::size_t truth) const {
        std::size_t sum = 0;
        for (std::size_t found = 0; found <= class_count; ++found) sum += count(truth, found);
        return sum;
    }
    /// @brief Share of images predicted correctly, 0 … 1; images without a detection count as errors.
    [[nodiscard]] double accuracy() const {
        std::size_t right = 0, all = 0;
        for (std::size_t c = 0; c < class_count; ++c) right += count(c, c), all += images(c);
        return all > 0 ? double(right) / double(all) : 0;
    }
};

/// @brief Whether each of `image_count` images holds exactly one object and nothing to ignore, so that images
/// have a class.
/// @throws Error where an object's image is none of them.
[[nodiscard]] inline bool one_object_each(std::span<const TruthObject> truth, std::size_t image_count) {
    std::vector<std::size_t> objects(image_count);
    for (const TruthObject& t : truth) {
        expect(t.image < image_count, "image of an object", lazy_text("below ", image_count), t.image);
        if (t.ignore) return false;
        ++objects[t.image];
    }
    for (const std::size_t count : objects)
        if (count != 1) return false;
    return image_count > 0;
}

/// @brief The confusion matrix of images that hold one object each; the predicted class is
/// that of the detection with the best score, wherever it lies. Where several classes share the best score it
/// is one of the wrong ones, that of the lowest index, so that the order of a file never makes a detection
/// right.
/// @throws Error where an image holds more or less than one object, or an index is too large.
[[nodiscard]] inline Confusion confusion(std::span<const TruthObject> truth,
                                         std::span<const FoundObject> found, std::size_t image_count,
                                         std::size_t class_count) {
    expect(one_object_each(truth, image_count), "objects of the images", "exactly one in each",
           lazy_text(truth.size(), " in ", image_count, " images"));
    std::vector<std::vector<std::uint32_t>> best(image_count);  // classes of the best score
    std::vector<double> best_score(image_count);
    for (const std::size_t f : by_score(found)) {
        expect(found[f].image < image_count, "image of a found object", lazy_text("below ", image_count),
               found[f].image);
        expect(found[f].class_index < class_count, "class of a found object",
               lazy_text("below ", class_count), found[f].class_index);
        std::vector<std::uint32_t>& here = best[found[f].image];
        if (here.empty()) best_score[found[f].image] = found[f].score;
        if (found[f].score == best_score[found[f].image]) here.push_back(found[f].class_index);
    }
    const auto taken_for = [&](const TruthObject& t) {
        std::size_t wrong = class_count;
        for (const std::uint32_t c : best[t.image])
            if (c != t.class_index) wrong = std::min<std::size_t>(wrong, c);
        return wrong == class_count && !best[t.image].empty() ? t.class_index : wrong;
    };
    Confusion matrix{.class_count = class_count,
                     .counts = std::vector<std::size_t>(class_count * (class_count + 1))};
    for (const TruthObject& t : truth) {
        expect(t.class_index < class_count, "class of an object", lazy_text("below ", class_count),
               t.class_index);
        ++matrix.counts[t.class_index * (class_count + 1) + taken_for(t)];
    }
    return matrix;
}

}  // namespace ism
