// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/parallel.hpp"
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

}  // namespace ism
