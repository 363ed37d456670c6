// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ism/core/thread_pool.hpp"
#include "ism/feature/extract.hpp"
#include "ism/model/occurrence.hpp"
#include "ism/train/harvest_image.hpp"
#include "ism/train/training_image.hpp"

namespace ism {

/// @brief Told now and then while long work goes on: what is being done, how much of it is done, how much
/// there is. May be called from any of the threads, one at a time.
using Progress = std::function<void(std::string_view stage, std::size_t done, std::size_t total)>;

/// @brief Something that gives training image i, for any i and from several threads at once.
template <class S>
concept TrainingSource = requires(const S& source, std::size_t i) {
    { source(i) } -> std::convertible_to<TrainingImage>;
};

namespace detail {

/// How much images should be enlarged before features are searched, so that the middle one of the objects has
/// enough of them: small objects are brought to 150 px, large ones stay.
[[nodiscard]] inline double choose_upsampling(std::vector<double> object_sizes_px) {
    constexpr double wanted_px = 150, most = 4;
    const auto middle = object_sizes_px.begin() + std::ptrdiff_t(object_sizes_px.size() / 2);
    std::nth_element(object_sizes_px.begin(), middle, object_sizes_px.end());
    return std::clamp(wanted_px / *middle, 1.0, most);
}

}  // namespace detail

/// @brief How features are collected from training images.
struct HarvestOptions {
    std::size_t max_features = 40000;  ///< of all objects together; each gives its strongest, at least 30
    bool choose_upsampling = true;     ///< small objects are enlarged; false: as the extractor says
    unsigned threads = 0;              ///< 0 = all the machine has
    Progress progress = {};
};

/// @brief Finds and describes the features on the objects of `count` images that `source` gives. Small
/// objects are enlarged before, unless `choose_upsampling` is off. `source` is called twice for each image,
/// from several threads.
/// @param class_names  names of the classes that LabelledObject::class_index points to
/// @throws Error where an image cannot be learnt from, or a class has no object or no feature.
template <Detector D, Descriptor Desc, TrainingSource Source>
[[nodiscard]] Harvest<D, Desc> harvest(std::span<const std::string> class_names, std::size_t count,
                                       const Source& source, const Extractor<D, Desc>& extractor = {},
                                       const HarvestOptions& options = {}) {
    expect(!class_names.empty(), "training: number of classes", "1 or more", 0);
    expect(count > 0, "training: number of images", "1 or more", 0);
    std::mutex mutex;
    std::size_t done = 0;
    const auto tell = [&](std::string_view stage) {
        if (!options.progress) return;
        const std::lock_guard lock(mutex);
        options.progress(stage, ++done, count);
    };

    // Look at all images once: are they good, and how large are the objects?
    std::vector<std::vector<std::pair<std::size_t, double>>> class_and_size(count);
    parallel_for(count, options.threads, [&](std::size_t i) {
        const TrainingImage image = source(i);
        detail::check_training_image(image, class_names.size());
        for (const LabelledObject& object : image.objects)
            class_and_size[i].emplace_back(object.class_index, std::sqrt(object.box.area()));
        tell("looking at images");
    });
    std::vector<double> sizes_px;
    std::vector<std::size_t> objects_of(class_names.size(), 0), features_of(class_names.size(), 0);
    for (const auto& image : class_and_size)
        for (const auto& [c, size_px] : image) {
            sizes_px.push_back(size_px);
            ++objects_of[c];
        }
    for (std::size_t c = 0; c < class_names.size(); ++c)
        expect(objects_of[c] > 0, lazy_text("training: objects of class ", class_names[c]), "1 or more", 0);

    Harvest<D, Desc> all{.extractor = extractor,
                         .class_names = {class_names.begin(), class_names.end()},
                         .objects = {},
                         .first_object = {0},
                         .seen = {},
                         .descriptors = {}};
    if (options.choose_upsampling) all.extractor.options.upsampling *= detail::choose_upsampling(sizes_px);

    const std::size_t most_an_object = std::max<std::size_t>(30, options.max_features / sizes_px.size());
    done = 0;
    std::vector<Harvest<D, Desc>> parts(count);
    parallel_for(count, options.threads, [&](std::size_t i) {
        if (!class_and_size[i].empty())
            parts[i] = detail::harvest_image(source(i), all.extractor, most_an_object);
        tell("extracting features");
    });
    for (Harvest<D, Desc>& part : parts) {
        for (std::size_t i = 0; i < part.seen.size(); ++i) {
            Occurrence occurrence = part.seen[i];
            occurrence.object += static_cast<std::uint32_t>(all.objects.size());
            occurrence.feature = static_cast<std::uint32_t>(all.seen.size());
            ++features_of[occurrence.class_index];
            all.seen.push_back(occurrence);
            all.descriptors.push_back(part.descriptors.row(i));
        }
        std::move(part.objects.begin(), part.objects.end(), std::back_inserter(all.objects));
        all.first_object.push_back(static_cast<std::uint32_t>(all.objects.size()));
        part = {};
    }
    for (std::size_t c = 0; c < class_names.size(); ++c)
        expect(features_of[c] > 0, lazy_text("training: features on objects of class ", class_names[c]),
               "1 or more", 0);
    return all;
}

}  // namespace ism
