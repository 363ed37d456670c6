// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ism/core/frame.hpp"
#include "ism/train/training_features.hpp"

namespace bench {

/// @brief Many classes to learn, and pictures to search for them.
struct ManyClasses {
    std::string what = {};                        ///< in words
    std::vector<std::string> names = {};          ///< of the classes
    std::vector<ism::TrainingImage> images = {};  ///< of one object each, classes rising
    std::vector<ism::Frame> frames = {};          ///< to search by the clock
    std::vector<ism::TrainingImage> checks = {};  ///< what should be found where
};

/// @brief What training features of ManyClasses::images tell of the classes first … end − 1 alone.
[[nodiscard]] inline ism::TrainingFeatures classes_of(const ism::TrainingFeatures& all, std::uint32_t first,
                                                      std::uint32_t end) {
    ism::TrainingFeatures part{
        .class_names = {all.class_names.begin() + first, all.class_names.begin() + end},
        .settings = all.settings};
    const auto in = [&](std::uint32_t class_index) { return class_index >= first && class_index < end; };
    std::uint32_t before = 0;
    for (const ism::TrainingObject& object : all.objects) {
        before += object.class_index < first;
        if (!in(object.class_index)) continue;
        part.objects.push_back(object);
        part.objects.back().class_index -= first;
    }
    std::uint32_t feature = 0;
    for (const ism::TrainingSamples& channel : all.samples) {
        part.samples.push_back({{}, ism::Descriptors<float>(channel.descriptors.dimension())});
        for (std::size_t i = 0; i < channel.occurrences.size(); ++i) {
            ism::Occurrence seen = channel.occurrences[i];
            if (!in(seen.class_index)) continue;
            seen.class_index -= first, seen.object -= before, seen.feature = feature++;
            part.samples.back().occurrences.push_back(seen);
            part.samples.back().descriptors.push_back(channel.descriptors.row(i));
        }
    }
    for (const ism::TrainingView& view : all.views) {
        if (!in(view.labels.front().class_index)) continue;
        part.views.push_back(view);
        part.views.back().labels.front().class_index -= first;
        part.views.back().first_object -= before, part.views.back().end_object -= before;
    }
    part.summary = {.images = part.objects.size(), .features_found = feature, .features_used = feature};
    return part;
}

}  // namespace bench
