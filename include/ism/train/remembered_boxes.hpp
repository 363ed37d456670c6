// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/codebook/codebook.hpp"
#include "ism/core/geometry.hpp"
#include "ism/feature/feature.hpp"
#include "ism/model/appearance.hpp"
#include "ism/model/occurrence.hpp"
#include "ism/train/learn_appearance.hpp"

namespace ism {

/// @brief The labelled boxes of a model's objects as its occurrences tell them, without their images: the
/// words of the features on each object. What lies in a box beside its object is not known;
/// where new and present objects are both told so, that does not tell them apart. Objects without
/// any word are left out.
[[nodiscard]] inline std::vector<AppearanceSample> remembered_boxes(const Shapes& shapes) {
    struct Seen {
        std::uint32_t word;
        const Occurrence* occurrence;
    };
    const std::size_t words = shapes.first.size() - 1;
    std::vector<std::vector<Seen>> on(shapes.objects.size());
    for (std::uint32_t w = 0; w < words; ++w)
        for (const Occurrence& o : shapes.of_word(w)) on[o.object].push_back({w, &o});
    std::vector<AppearanceSample> samples;
    for (std::size_t object = 0; object < shapes.objects.size(); ++object) {
        std::vector<Seen>& seen = on[object];
        std::stable_sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) {
            return a.occurrence->feature < b.occurrence->feature;
        });
        std::vector<Feature> features;
        std::vector<Match> matches;
        for (std::size_t i = 0, next = 0; i < seen.size(); i = next) {
            const Occurrence& o = *seen[i].occurrence;
            while (next < seen.size() && seen[next].occurrence->feature == o.feature) ++next;
            for (std::size_t k = i; k < next; ++k)
                matches.push_back({.feature = static_cast<std::uint32_t>(features.size()),
                                   .word = seen[k].word,
                                   .weight = 1 / static_cast<float>(next - i)});
            features.push_back({.x = o.x, .y = o.y, .scale = o.scale});
        }
        const TrainingObject& shown = shapes.objects[object];
        const Box box = box_around({0, 0}, shown.width, shown.height);
        auto histogram = word_histogram(features, matches, words, box);
        if (!histogram.empty())
            samples.push_back(
                {.box = std::move(histogram), .shows = shown.class_index, .taken_for = shown.class_index});
    }
    return samples;
}

}  // namespace ism
