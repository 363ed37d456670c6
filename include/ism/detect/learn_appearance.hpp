// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "ism/codebook/match.hpp"
#include "ism/core/parallel.hpp"
#include "ism/detect/harvest.hpp"
#include "ism/detect/hypotheses.hpp"
#include "ism/detect/model.hpp"
#include "ism/vote/appearance.hpp"

namespace ism {

/// @brief A box to learn from: what it holds, what it really shows, what it was taken for.
struct AppearanceSample {
    static constexpr std::uint32_t background = std::numeric_limits<std::uint32_t>::max();
    std::vector<HistogramBin> box;
    std::uint32_t shows = background;  ///< class of the object there
    std::uint32_t taken_for = 0;       ///< class of the hypothesis; of a labelled box as `shows`
};

/// @brief How judges are learnt.
struct AppearanceOptions {
    double regularisation = 3e-4;    ///< of the squared weights
    int iterations = 200;            ///< steps of gradient descent
    std::size_t max_samples = 5000;  ///< hypotheses of all images together, at least 3 an image
    bool mirror = true;              ///< as many again from the images as a mirror shows them
    double same_iou = 0.5;           ///< a hypothesis that overlaps an object so far shows it
    double other_iou = 0.3;          ///< one that overlaps all less is background; between is left out
};

/// @brief Fits the judge of each class by logistic regression (AdaGrad, Duchi et al. 2011): boxes that show
/// the class against those that show another or were taken for it. Both sides weigh alike.
/// @param words  of the codebook
[[nodiscard]] inline Appearance fit_appearance(std::span<const AppearanceSample> samples, std::size_t words,
                                               std::size_t classes, const AppearanceOptions& options = {},
                                               unsigned threads = 0) {
    const std::size_t bins = Appearance::cells * words;
    Appearance result{.weights = std::vector<float>(classes * bins), .bias = std::vector<float>(classes)};
    parallel_for(classes, threads, [&](std::size_t c) {
        std::vector<std::pair<const AppearanceSample*, bool>> used;
        std::size_t right = 0;
        for (const AppearanceSample& s : samples) {
            const bool shows = s.shows == c;
            if (!shows && s.shows == AppearanceSample::background && s.taken_for != c) continue;
            used.emplace_back(&s, shows);
            right += shows;
        }
        const double weight_right = 0.5 / double(std::max<std::size_t>(1, right));
        const double weight_wrong = 0.5 / double(std::max<std::size_t>(1, used.size() - right));
        constexpr double rate = 0.3;
        std::vector<double> weight(bins + 1, 0), slope(bins + 1), sq_slopes(bins + 1, 1e-8);  // bias last
        for (int step = 0; step < options.iterations; ++step) {
            for (std::size_t b = 0; b < bins; ++b) slope[b] = options.regularisation * weight[b];
            slope[bins] = 0;
            for (const auto& [sample, shows] : used) {
                double sum = weight[bins];
                for (const HistogramBin& b : sample->box) sum += double(b.value) * weight[b.bin];
                const double error =
                    (1 / (1 + std::exp(-sum)) - double(shows)) * (shows ? weight_right : weight_wrong);
                for (const HistogramBin& b : sample->box) slope[b.bin] += error * double(b.value);
                slope[bins] += error;
            }
            for (std::size_t b = 0; b <= bins; ++b) {
                sq_slopes[b] += slope[b] * slope[b];
                weight[b] -= rate * slope[b] / std::sqrt(sq_slopes[b]);
            }
        }
        std::copy_n(weight.begin(), bins, result.weights.begin() + std::ptrdiff_t(c * bins));
        result.bias[c] = static_cast<float>(weight[bins]);
    });
    return result;
}

namespace detail {

/// Shapes as if the objects first … end − 1 had not been seen: what they said of a word others say.
[[nodiscard]] inline Shapes without_objects(Shapes shapes, std::size_t first, std::size_t end) {
    for (std::size_t w = 0; w + 1 < shapes.first.size(); ++w) {
        const auto own =
            std::span(shapes.occurrences).subspan(shapes.first[w], shapes.first[w + 1] - shapes.first[w]);
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
[[nodiscard]] std::vector<AppearanceSample> appearance_samples(
    const Extractor<D, Desc>& extractor, const WordIndex<Desc::dimension, typename Desc::Scalar>& words,
    const Shapes& unseen, const TrainingImage& image, const AppearanceOptions& options,
    const DetectOptions<Jism>& search) {
    const auto found = extract(image.frame.gray, extractor, 1);
    const auto matches = match(words, found.descriptors, 1);
    const auto holds = [&](const Box& box) {
        return word_histogram(found.features, matches, words.size(), box);
    };
    std::vector<AppearanceSample> samples;
    for (const LabelledObject& object : image.objects) {
        const auto shows = static_cast<std::uint32_t>(object.class_index);
        samples.push_back({.box = holds(object.box), .shows = shows, .taken_for = shows});
    }
    for (const Detection& guess : vote_for<Jism>(found.features, matches, unseen, image.frame, search)) {
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
           join_text("2 numbers or more, the last at most ", model.shapes.objects.size()),
           join_text(first_object.size(), " numbers",
                     first_object.empty() ? "" : join_text(", the last ", first_object.back())));
    const std::size_t images = first_object.size() - 1;
    const DetectOptions<Jism> search{.max_hypotheses = std::max<std::size_t>(3, options.max_samples / images),
                                     .threads = 1};
    const WordIndex<Desc::dimension, typename Desc::Scalar> words(model.codebook);
    std::mutex mutex;
    std::size_t done = 0;
    std::vector<std::vector<AppearanceSample>> parts(images);
    parallel_for(images, threads, [&](std::size_t i) {
        TrainingImage image = source(i);
        const Shapes unseen = detail::without_objects(model.shapes, first_object[i], first_object[i + 1]);
        parts[i] = detail::appearance_samples(model.extractor, words, unseen, image, options, search);
        if (options.mirror) {
            auto more = detail::appearance_samples(model.extractor, words, unseen, mirrored(std::move(image)),
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

/// @brief Learns what boxes of each class hold: from the labelled boxes, and from what the model finds in
/// each training image when it has not seen its objects (leave one image out), background images included.
/// @param first_object  image i has the objects first_object[i] … first_object[i + 1] − 1 of the model
/// @param source        gives the images that the model was learnt from
/// @throws Error where `first_object` does not fit the model.
template <Detector D, Descriptor Desc, TrainingSource Source>
[[nodiscard]] Appearance learn_appearance(const Model<D, Desc>& model,
                                          std::span<const std::uint32_t> first_object, const Source& source,
                                          const AppearanceOptions& options = {}, unsigned threads = 0,
                                          const Progress& progress = {}) {
    const auto samples = detail::appearance_samples(model, first_object, source, options, threads, progress);
    return fit_appearance(samples, model.codebook.size(), model.shapes.class_names.size(), options, threads);
}

}  // namespace ism
