// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ism/codebook/codebook.hpp"
#include "ism/codebook/nearest_words.hpp"
#include "ism/codebook/word_index.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/feature/any_extractor.hpp"
#include "ism/train/extract_training_features.hpp"
#include "ism/train/training_features.hpp"
#include "ism/train/training_set.hpp"
#include "ism/vote/placement.hpp"

/// Whether features should have directions. Without them votes assume that objects have one side up, as cars
/// and cows do; with them (ExtractOptions::oriented) objects are found however they are turned in the image,
/// and features tell less.
namespace ism {

/// @brief What features that two training objects of a class share tell of how objects lie.
struct SharedFeatures {
    std::size_t count = 0;    ///< pairs that agree about where the object lies
    std::size_t upright = 0;  ///< of these, pairs by which neither object is turned against the other by
                              ///< more than 30°

    /// @brief Near 1 where objects have one side up, 1/6 where they are turned at random.
    [[nodiscard]] double upright_share() const { return count > 0 ? double(upright) / double(count) : 1; }
    /// @brief Whether there are enough pairs to know.
    [[nodiscard]] bool conclusive() const { return count >= 30; }
    /// @brief Whether they have, so that features need no directions: almost twice what chance gives, or
    /// too few pairs to know.
    [[nodiscard]] bool one_side_up() const { return !conclusive() || upright_share() >= 0.3; }
};

namespace detail {

/// By how much two objects are turned against each other, one of which shows a feature so and the other one
/// so, radians; none where by these features they would not lie in one place or not be of one size.
[[nodiscard]] inline std::optional<double> turn_between(const Occurrence& one, const Occurrence& other) {
    constexpr double max_distance = 0.2 * reference_size_px, max_growth = 1.4;
    constexpr double min_offset = 0.4 * reference_size_px;  // nearer the centre all directions agree
    const Placement placed =
        placement({.x = other.x, .y = other.y, .scale = other.scale, .angle = other.angle}, one);
    if (std::hypot(one.x, one.y) < min_offset ||
        std::hypot(placed.centre.x, placed.centre.y) > max_distance ||
        std::abs(std::log(placed.scale)) > std::log(max_growth))
        return {};
    return placed.angle;
}

}  // namespace detail

/// @brief Each feature of a training object and those most like it on other objects of its class, where by
/// this pair the two objects would lie in one place and be of one size.
/// @param features  with directions
[[nodiscard]] inline SharedFeatures shared_features(const TrainingFeatures& features, unsigned threads = 0) {
    constexpr std::size_t most_like = 10;
    const double least_cosine = std::cos(std::numbers::pi / 6);
    ThreadPool pool(threads);
    SharedFeatures shared;
    for (const TrainingSamples& channel : features.samples) {
        const std::vector<Occurrence>& all = channel.occurrences;
        Codebook codebook(channel.descriptors.dimension(), std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < all.size(); ++i)
            codebook.push_back_descriptor(channel.descriptors.row(i));
        const WordIndex index(codebook);
        for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
            Descriptors<float> own(channel.descriptors.dimension());
            for (; end < all.size() && all[end].object == all[first].object; ++end)
                own.push_back(channel.descriptors.row(end));
            const WordRange without{std::uint32_t(first), std::uint32_t(end)};
            const std::vector<Neighbour> near = nearest_words(index, own, most_like, pool, without);
            const std::size_t each = neighbours_each(index, most_like, without);
            for (std::size_t n = 0; n < near.size(); ++n) {
                if (near[n].word == no_word) continue;
                const Occurrence& one = all[first + n / each];
                const Occurrence& other = all[near[n].word];
                if (one.class_index != other.class_index) continue;
                const std::optional<double> turn = detail::turn_between(one, other);
                if (!turn) continue;
                ++shared.count;
                if (std::cos(*turn) >= least_cosine) ++shared.upright;
            }
        }
    }
    return shared;
}

namespace detail {

/// A few images of each class, spread over all that show it, in order.
[[nodiscard]] inline std::vector<std::size_t> some_images(const TrainingSet& set, std::size_t classes) {
    const std::size_t most = std::clamp<std::size_t>(32 / classes, 2, 16);
    std::vector<std::vector<std::size_t>> images(classes);
    for (std::size_t i = 0; i < set.size; ++i)
        for (const ObjectLabel& label : set.labels(i))
            if (label.class_index < classes &&
                (images[label.class_index].empty() || images[label.class_index].back() != i))
                images[label.class_index].push_back(i);
    std::vector<std::size_t> some;
    for (const std::vector<std::size_t>& of_class : images) {
        const std::size_t count = std::min(most, of_class.size());
        for (std::size_t k = 0; k < count; ++k) some.push_back(of_class[k * of_class.size() / count]);
    }
    std::sort(some.begin(), some.end());  // an image may show several classes
    some.erase(std::unique(some.begin(), some.end()), some.end());
    return some;
}

}  // namespace detail

/// @brief The same of images to learn from: of a few of each class.
/// @param extractors  they are made to give directions
/// @throws Error where there is no class, or an image cannot be learnt from.
[[nodiscard]] inline SharedFeatures shared_features(std::span<const std::string> class_names,
                                                    const TrainingSet& set,
                                                    std::vector<AnyExtractor> extractors,
                                                    unsigned threads = 0) {
    expect(!class_names.empty(), "training: number of classes", "1 or more", 0);
    constexpr std::size_t max_features = 150;  // of an object
    const std::vector<std::size_t> some = detail::some_images(set, class_names.size());
    std::vector<double> sizes_px;
    for (const std::size_t i : some)
        for (const ObjectLabel& label : set.labels(i))
            if (label.box.area() > 0) sizes_px.push_back(std::sqrt(label.box.area()));
    if (sizes_px.empty()) return {};
    TrainingFeatures features;
    for (AnyExtractor& extractor : extractors) {
        extractor.options().oriented = true;
        extractor.options().upsampling *= choose_upsampling(sizes_px);
        features.samples.push_back({{}, Descriptors<float>(extractor.settings().dimension)});
    }
    ThreadPool pool(unsigned(std::min<std::size_t>(thread_count(threads), some.size())));
    std::vector<TrainingFeatures> parts(some.size());
    pool.for_each(some.size(), [&](std::size_t i, unsigned) {
        const TrainingImage image = set.image(some[i]);
        check(image, class_names.size());
        parts[i] =
            detail::object_features(image, detail::TrainingExtractor(extractors).view(image), max_features);
    });
    return shared_features(detail::join_images(std::move(features), std::move(parts)), threads);
}

}  // namespace ism
