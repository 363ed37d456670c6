// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "ism/core/frame.hpp"
#include "ism/train/harvest.hpp"

namespace bench {

/// @brief Many classes to learn, and pictures to search for them.
struct ManyClasses {
    std::string what = {};                        ///< in words
    std::vector<std::string> names = {};          ///< of the classes
    std::vector<ism::TrainingImage> images = {};  ///< of one object each, classes rising
    std::vector<ism::Frame> frames = {};          ///< to search by the clock
    std::vector<ism::TrainingImage> checks = {};  ///< what should be found where
};

/// @brief What a harvest of ManyClasses::images gives for the classes first … end − 1 alone.
template <ism::Detector D, ism::Descriptor Desc>
[[nodiscard]] ism::Harvest<D, Desc> classes_of(const ism::Harvest<D, Desc>& all, std::uint32_t first,
                                               std::uint32_t end) {
    ism::Harvest<D, Desc> part{
        .extractor = all.extractor,
        .class_names = {all.class_names.begin() + first, all.class_names.begin() + end},
        .objects = {},
        .first_object = {0},
        .seen = {},
        .descriptors = {}};
    const auto in = [&](std::uint32_t class_index) { return class_index >= first && class_index < end; };
    std::uint32_t before = 0;
    for (const ism::TrainingObject& object : all.objects) {
        before += object.class_index < first;
        if (!in(object.class_index)) continue;
        part.objects.push_back(object);
        part.objects.back().class_index -= first;
        part.first_object.push_back(static_cast<std::uint32_t>(part.objects.size()));
    }
    for (std::size_t i = 0; i < all.seen.size(); ++i) {
        if (!in(all.seen[i].class_index)) continue;
        ism::Occurrence seen = all.seen[i];
        seen.class_index -= first, seen.object -= before;
        seen.feature = static_cast<std::uint32_t>(part.seen.size());
        part.seen.push_back(seen);
        part.descriptors.push_back(all.descriptors.row(i));
    }
    return part;
}

}  // namespace bench
