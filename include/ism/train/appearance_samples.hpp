// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <iterator>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/thread_pool.hpp"
#include "ism/detect/frame_matcher.hpp"
#include "ism/detect/hypotheses.hpp"
#include "ism/model/model.hpp"
#include "ism/train/fit_appearance.hpp"
#include "ism/train/harvest.hpp"

namespace ism {

namespace detail {

/// Shapes as if the objects first … end − 1 had not been seen: what they said of a word others say.
[[nodiscard]] inline Shapes without_objects(Shapes shapes, std::size_t first, std::size_t end) {
    for (std::size_t w = 0; w + 1 < shapes.first.size(); ++w) {
        const std::span<Occurrence> own = shapes.of_word(w);
        double all = 0, rest = 0;
        for (Occurrence& o : own) {
            all += o.weight;
            if (o.object >= first && o.object < end) o.weight = 0;
            rest += o.weight;
        }
        if (rest > 0 && rest < all)
            for (Occurrence& o : own) o.weight = static_cast<float>(o.weight * all / rest);
    }
    return shapes;
}

/// The labelled boxes of a training image, and what is found in it by shapes that have not seen its objects.
template <Detector D, Descriptor Desc>
[[nodiscard]] std::vector<AppearanceSample> appearance_samples(FrameMatcher<D, Desc>& matcher,
                                                               const Shapes& unseen,
                                                               const TrainingImage& image,
                                                               const AppearanceOptions& options,
                                                               const DetectOptions<Jism>& search) {
    const MatchedFeatures found = matcher.match(image.frame);
    const auto holds = [&](const Box& box) {
        return word_histogram(found.features, found.matches, unseen.first.size() - 1, box);
    };
    std::vector<AppearanceSample> samples;
    for (const LabelledObject& object : image.objects) {
        const auto shows = static_cast<std::uint32_t>(object.class_index);
        samples.push_back({.box = holds(object.box), .shows = shows, .taken_for = shows});
    }
    for (const Detection& guess :
         vote_for<Jism>(found.features, found.matches, unseen, image.frame, search)) {
        double overlap = 0;
        std::uint32_t shows = AppearanceSample::background;
        for (const LabelledObject& object : image.objects)
            if (const double shared = iou(guess.box, object.box); shared > overlap) {
                overlap = shared;
                shows = static_cast<std::uint32_t>(object.class_index);
            }
        if (overlap >= options.other_iou && overlap < options.same_iou) continue;
        samples.push_back({.box = holds(guess.box),
                           .shows = overlap >= options.same_iou ? shows : AppearanceSample::background,
                           .taken_for = static_cast<std::uint32_t>(guess.class_index)});
    }
    return samples;
}

/// Those of all images; the same for any number of threads.
template <Detector D, Descriptor Desc, TrainingSource Source>
[[nodiscard]] std::vector<AppearanceSample> appearance_samples(const Model<D, Desc>& model,
                                                               std::span<const std::uint32_t> first_object,
                                                               const Source& source,
                                                               const AppearanceOptions& options,
                                                               unsigned threads, const Progress& progress) {
    expect(first_object.size() > 1 && first_object.back() <= model.shapes.objects.size(),
           "judge of boxes: where the objects of each image begin",
           lazy_text("2 numbers or more, the last at most ", model.shapes.objects.size()),
           lazy_text(first_object.size(), " numbers",
                     first_object.empty() ? "" : join_text(", the last ", first_object.back())));
    const std::size_t images = first_object.size() - 1;
    const DetectOptions<Jism> search{.max_candidates = std::max<std::size_t>(3, options.max_samples / images),
                                     .threads = 1};
    ThreadPool pool(unsigned(std::min<std::size_t>(thread_count(threads), images)));
    std::deque<FrameMatcher<D, Desc>> matchers;
    for (unsigned worker = 0; worker < pool.size(); ++worker) matchers.emplace_back(model, 1);
    std::mutex mutex;
    std::size_t done = 0;
    std::vector<std::vector<AppearanceSample>> parts(images);
    pool.for_each(images, [&](std::size_t i, unsigned worker) {
        TrainingImage image = source(i);
        const Shapes unseen = detail::without_objects(model.shapes, first_object[i], first_object[i + 1]);
        parts[i] = detail::appearance_samples(matchers[worker], unseen, image, options, search);
        if (options.mirror) {
            auto more = detail::appearance_samples(matchers[worker], unseen, mirrored(std::move(image)),
                                                   options, search);
            std::move(more.begin(), more.end(), std::back_inserter(parts[i]));
        }
        if (progress) {
            const std::lock_guard lock(mutex);
            progress("trying on training images", ++done, images);
        }
    });
    std::vector<AppearanceSample> samples;
    for (auto& part : parts) std::move(part.begin(), part.end(), std::back_inserter(samples));
    return samples;
}

}  // namespace detail

}  // namespace ism
