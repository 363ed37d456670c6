// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/model/appearance.hpp"

namespace ism {

/// @brief A box to learn from: what it holds, what it really shows, what it was taken for.
struct AppearanceSample {
    static constexpr std::uint32_t background = std::numeric_limits<std::uint32_t>::max();
    std::vector<BinValue> box;
    std::uint32_t shows = background;  ///< class of the object there
    std::uint32_t taken_for = 0;       ///< class of the hypothesis; of a labelled box as `shows`
};

/// @brief How judges are learnt.
struct AppearanceOptions {
    double regularisation = 3e-4;    ///< of the squared weights
    int iterations = 200;            ///< steps of gradient descent
    std::size_t max_samples = 5000;  ///< hypotheses of all images together, at least 3 an image
    std::size_t max_others = 100;    ///< boxes of other classes that a judge also learns from
    bool mirror = true;              ///< as many again from the images as a mirror shows them
    double same_iou = 0.5;           ///< a hypothesis that overlaps an object so far shows it
    double other_iou = 0.3;          ///< one that overlaps all less is background; between is left out
};

namespace detail {

/// What the judge of one class learns from: rows of the bins it sees.
struct JudgeLessons {
    std::vector<std::uint32_t> bins;       // that it sees, rising
    std::vector<BinValue> values;          // row after row, bins by their place in `bins`
    std::vector<std::size_t> first = {0};  // of each row
    std::vector<bool> shows;               // whether it shows the class

    [[nodiscard]] std::size_t rows() const { return shows.size(); }
    [[nodiscard]] std::span<const BinValue> row(std::size_t i) const {
        return std::span(values).subspan(first[i], first[i + 1] - first[i]);
    }
};

/// The boxes that show the class or were taken for it, which tell the bins, and an even part of those that
/// show another.
/// @param words  of the codebook
[[nodiscard]] inline JudgeLessons judge_lessons(std::span<const AppearanceSample> samples, std::size_t words,
                                                std::size_t class_index, std::size_t max_others) {
    std::vector<const AppearanceSample*> used, others;
    for (const AppearanceSample& s : samples)
        if (s.shows == class_index || s.taken_for == class_index)
            used.push_back(&s);
        else if (s.shows != AppearanceSample::background)
            others.push_back(&s);
    constexpr auto unseen = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> place(Appearance::cells * words, unseen);
    for (const AppearanceSample* s : used)
        for (const BinValue& b : s->box) place[b.bin] = 0;
    JudgeLessons lessons;
    for (std::uint32_t bin = 0; bin < place.size(); ++bin)
        if (place[bin] != unseen) {
            place[bin] = static_cast<std::uint32_t>(lessons.bins.size());
            lessons.bins.push_back(bin);
        }
    const std::size_t part = std::min(others.size(), max_others);
    for (std::size_t k = 0; k < part; ++k) used.push_back(others[k * others.size() / part]);
    for (const AppearanceSample* s : used) {
        for (const BinValue& b : s->box)
            if (place[b.bin] != unseen) lessons.values.push_back({place[b.bin], b.value});
        lessons.first.push_back(lessons.values.size());
        lessons.shows.push_back(s->shows == class_index);
    }
    return lessons;
}

/// Weights of the bins of the lessons, and the bias after them.
[[nodiscard]] inline std::vector<double> fit_judge(const JudgeLessons& lessons,
                                                   const AppearanceOptions& options) {
    const std::size_t bins = lessons.bins.size();
    const auto right = std::size_t(std::count(lessons.shows.begin(), lessons.shows.end(), true));
    const double weight_right = 0.5 / double(std::max<std::size_t>(1, right));
    const double weight_wrong = 0.5 / double(std::max<std::size_t>(1, lessons.rows() - right));
    constexpr double rate = 0.3;
    std::vector<double> weight(bins + 1, 0), slope(bins + 1), sq_slopes(bins + 1, 1e-8);
    for (int step = 0; step < options.iterations; ++step) {
        for (std::size_t b = 0; b < bins; ++b) slope[b] = options.regularisation * weight[b];
        slope[bins] = 0;
        for (std::size_t i = 0; i < lessons.rows(); ++i) {
            double sum = weight[bins];
            for (const BinValue& b : lessons.row(i)) sum += double(b.value) * weight[b.bin];
            const bool shows = lessons.shows[i];
            const double error =
                (1 / (1 + std::exp(-sum)) - double(shows)) * (shows ? weight_right : weight_wrong);
            for (const BinValue& b : lessons.row(i)) slope[b.bin] += error * double(b.value);
            slope[bins] += error;
        }
        for (std::size_t b = 0; b <= bins; ++b) {
            sq_slopes[b] += slope[b] * slope[b];
            weight[b] -= rate * slope[b] / std::sqrt(sq_slopes[b]);
        }
    }
    return weight;
}

}  // namespace detail

/// @brief Fits the judge of each class by logistic regression (AdaGrad, Duchi et al. 2011): boxes that show
/// the class against those that show another or were taken for it. Both sides weigh alike. A judge sees the
/// bins of boxes that show its class or were taken for it, so that its size does not grow with the number of
/// classes.
/// @param words  of the codebook
/// @throws Error for samples with bins of other words.
[[nodiscard]] inline Appearance fit_appearance(std::span<const AppearanceSample> samples, std::size_t words,
                                               std::size_t classes, const AppearanceOptions& options = {},
                                               unsigned threads = 0) {
    for (const AppearanceSample& s : samples)
        if (!s.box.empty())
            expect(s.box.back().bin < Appearance::cells * words, "judge of boxes: bin of a sample",
                   lazy_text("below ", Appearance::cells * words), s.box.back().bin);
    std::vector<std::vector<BinValue>> weights(classes);
    std::vector<float> bias(classes);
    parallel_for(classes, threads, [&](std::size_t c) {
        const detail::JudgeLessons lessons = detail::judge_lessons(samples, words, c, options.max_others);
        const std::vector<double> fitted = detail::fit_judge(lessons, options);
        for (std::size_t b = 0; b < lessons.bins.size(); ++b)
            weights[c].push_back({lessons.bins[b], static_cast<float>(fitted[b])});
        bias[c] = static_cast<float>(fitted.back());
    });
    Appearance result;
    for (std::size_t c = 0; c < classes; ++c) result.push_back(weights[c], bias[c]);
    return result;
}

}  // namespace ism
