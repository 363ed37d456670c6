// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/codebook/codebook.hpp"
#include "ism/core/geometry.hpp"
#include "ism/feature/feature.hpp"

namespace ism {

/// @brief How often something is in a box: bin and value, bins rising.
struct HistogramBin {
    std::uint32_t bin = 0;
    float value = 0;
    [[nodiscard]] bool operator==(const HistogramBin&) const = default;
};

/// @brief What boxes of each class hold: for each class a linear judge of the words in a box, which sees also
/// what a vote does not count: words that speak against the class. Empty = no judge, all boxes look right.
/// (Discriminative verification of hypotheses: Fritz, Leibe, Caputo and Schiele 2005.)
struct Appearance {
    static constexpr std::size_t cells = 5;  ///< the whole box and its four quarters

    std::vector<float> weights;  ///< class c, bin b at c · bins() + b
    std::vector<float> bias;     ///< one a class

    [[nodiscard]] bool empty() const { return bias.empty(); }
    /// @brief Bins of a histogram: word w of cell k at k · words + w.
    [[nodiscard]] std::size_t bins() const { return empty() ? 0 : weights.size() / bias.size(); }

    /// @brief p(class | words in the box), 0 … 1; 1 without a judge.
    [[nodiscard]] double probability(std::size_t class_index, std::span<const HistogramBin> box) const {
        if (empty()) return 1;
        double sum = bias[class_index];
        for (const HistogramBin& b : box) sum += double(b.value) * weights[class_index * bins() + b.bin];
        return 1 / (1 + std::exp(-sum));
    }
};

/// @brief The words in a box and in each of its quarters: roots of shares, so that their squares add up to 1
/// (Arandjelovic and Zisserman 2012 do so with SIFT). Empty where no word is in the box.
/// @param words  of the codebook
[[nodiscard]] inline std::vector<HistogramBin> word_histogram(std::span<const Feature> features,
                                                              std::span<const Match> matches,
                                                              std::size_t words, const Box& box) {
    std::vector<HistogramBin> bins;
    double total = 0;
    for (const Match& match : matches) {
        const Feature& f = features[match.feature];
        const double u = (double(f.x) - box.x) / box.width, v = (double(f.y) - box.y) / box.height;
        if (!(u >= 0 && v >= 0 && u < 1 && v < 1)) continue;
        const std::size_t quarter = 1 + std::size_t(u >= 0.5) + 2 * std::size_t(v >= 0.5);
        bins.push_back({match.word, match.weight});
        bins.push_back({static_cast<std::uint32_t>(quarter * words + match.word), match.weight});
        total += 2 * double(match.weight);
    }
    std::stable_sort(bins.begin(), bins.end(),
                     [](const HistogramBin& a, const HistogramBin& b) { return a.bin < b.bin; });
    std::size_t count = 0;
    for (const HistogramBin& b : bins) {
        if (count > 0 && bins[count - 1].bin == b.bin)
            bins[count - 1].value += b.value;
        else
            bins[count++] = b;
    }
    bins.resize(count);
    for (HistogramBin& b : bins) b.value = static_cast<float>(std::sqrt(b.value / total));
    return bins;
}

}  // namespace ism
