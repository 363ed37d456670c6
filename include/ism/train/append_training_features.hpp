// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/train/training_features.hpp"

namespace ism {

namespace detail {

/// The index of each name in `names`, to which those that it lacks are added.
[[nodiscard]] inline std::vector<std::uint32_t> join_names(std::vector<std::string>& names,
                                                           std::span<const std::string> more) {
    std::vector<std::uint32_t> index;
    for (const std::string& name : more) {
        const auto found = std::find(names.begin(), names.end(), name);
        index.push_back(static_cast<std::uint32_t>(found - names.begin()));
        if (found == names.end()) names.push_back(name);
    }
    return index;
}

/// The numbers of classes that were joined; a class that is new gets another one where its own is taken.
[[nodiscard]] inline std::vector<std::int64_t> join_category_ids(std::vector<std::int64_t> ids,
                                                                 std::span<const std::int64_t> more,
                                                                 std::span<const std::uint32_t> class_of) {
    for (std::size_t c = 0; c < more.size(); ++c) {
        if (class_of[c] < ids.size()) continue;
        const bool taken = std::find(ids.begin(), ids.end(), more[c]) != ids.end();
        ids.push_back(taken ? *std::max_element(ids.begin(), ids.end()) + 1 : more[c]);
    }
    return ids;
}

/// A picture that is in both shows what each of its views tells: none of it is background of another.
inline void share_labels(std::vector<TrainingView>& all, std::vector<TrainingView>& more) {
    for (TrainingView& later : more) {
        const std::vector<Box> own = later.ignored;
        for (TrainingView& view : all) {
            if (view.pixels.empty() || !(view.pixels == later.pixels)) continue;
            for (const ObjectLabel& label : view.labels) later.ignored.push_back(label.box);
            for (const ObjectLabel& label : later.labels) view.ignored.push_back(label.box);
            view.ignored.insert(view.ignored.end(), own.begin(), own.end());
        }
    }
}

}  // namespace detail

/// @brief Training features of more images: of more classes, or more examples of the same (by name). Category
/// ids stay where both have them; a new class gets the next free one where its own is taken.
/// Where views keep pixels, labels of one picture that comes again are told apart from background in both.
/// @throws Error where the features were found and described in another way.
[[nodiscard]] inline TrainingFeatures append(TrainingFeatures all, TrainingFeatures more) {
    expect(all.settings.size() == more.settings.size(), "training features to append: channels",
           all.settings.size(), more.settings.size());
    for (std::size_t c = 0; c < all.settings.size(); ++c) {
        const FeatureSettings &a = all.settings[c], &b = more.settings[c];
        expect(a.detector == b.detector && a.descriptor == b.descriptor && a.dimension == b.dimension,
               "training features to append", lazy_text(a.detector, ", ", a.descriptor),
               lazy_text(b.detector, ", ", b.descriptor));
        expect(a.options.upsampling == b.options.upsampling, "training features to append: upsampling",
               a.options.upsampling, b.options.upsampling);
        expect(a.options.oriented == b.options.oriented, "training features to append: oriented",
               a.options.oriented, b.options.oriented);
        expect(is_same_way(a, b), "training features to append",
               "the same options of detector and descriptor", "others");
    }
    const std::vector<std::uint32_t> class_of = detail::join_names(all.class_names, more.class_names);
    if (all.category_ids.empty() || more.category_ids.empty())
        all.category_ids.clear();
    else
        all.category_ids = detail::join_category_ids(all.category_ids, more.category_ids, class_of);
    for (TrainingObject& object : more.objects) object.class_index = class_of[object.class_index];
    for (TrainingSamples& channel : more.samples)
        for (Occurrence& o : channel.occurrences) o.class_index = class_of[o.class_index];
    for (TrainingView& view : more.views)
        for (ObjectLabel& label : view.labels) label.class_index = class_of[label.class_index];
    detail::share_labels(all.views, more.views);
    std::vector<TrainingFeatures> parts;
    parts.push_back(std::move(more));
    return detail::join_images(std::move(all), std::move(parts));
}

}  // namespace ism
