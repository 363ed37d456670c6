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
#include "ism/core/grouped.hpp"
#include "ism/core/order.hpp"
#include "ism/feature/feature.hpp"

namespace ism {

/// @brief An entry of a sparse vector; entries rise by index.
struct SparseEntry {
    std::uint32_t index = 0;
    float value = 0;
    [[nodiscard]] bool operator==(const SparseEntry&) const = default;
};

/// @brief Whether a box shows an object of a class, judged by the words in it: a linear classifier for each
/// class, which sees also what a vote does not count, words that speak against the class. Empty = none.
/// (Discriminative verification of hypotheses: Fritz, Leibe, Caputo and Schiele 2005.)
struct BoxClassifier {
    static constexpr std::size_t cells = 5;  ///< the whole box and its four quarters

    Grouped<SparseEntry> weights;  ///< of each class, for the bins of word_histogram(); other bins weigh 0
    std::vector<float> bias;       ///< of each class

    [[nodiscard]] bool empty() const { return bias.empty(); }
    [[nodiscard]] std::size_t classes() const { return bias.size(); }

    /// @brief Adds a class.
    void push_back(std::span<const SparseEntry> class_weights, float class_bias) {
        weights.push_back(class_weights);
        bias.push_back(class_bias);
    }

    /// @brief p(class | words in the box), 0 … 1; 1 without a classifier.
    [[nodiscard]] double probability(std::size_t class_index, std::span<const SparseEntry> histogram) const {
        if (empty()) return 1;
        double sum = bias[class_index];
        std::span<const SparseEntry> own = weights[class_index];
        for (const SparseEntry& bin : histogram) {
            const auto at = std::lower_bound(
                own.begin(), own.end(), bin.index,
                [](const SparseEntry& weight, std::uint32_t index) { return weight.index < index; });
            own = own.subspan(std::size_t(at - own.begin()));
            if (!own.empty() && own.front().index == bin.index) sum += double(bin.value) * own.front().value;
        }
        return 1 / (1 + std::exp(-sum));
    }
};

/// @brief The words in a box and in each of its quarters, bin cell · words + word: roots of shares, so that
/// their squares add up to 1 (Arandjelović and Zisserman 2012 do so with SIFT). Empty where no word is in the
/// box.
/// @param words  of the model, all channels together
[[nodiscard]] inline std::vector<SparseEntry> word_histogram(std::span<const Feature> features,
                                                             std::span<const Match> matches,
                                                             std::size_t words, const Box& box) {
    std::vector<detail::Ranked> by_word;
    std::vector<SparseEntry> quarters;  // of each match in the box the quarter and the weight
    double total = 0;
    for (std::size_t i = 0, end = 0; i < matches.size(); i = end) {  // the matches of a feature
        const Feature& f = features[matches[i].feature];
        while (end < matches.size() && matches[end].feature == matches[i].feature) ++end;
        const double u = (double(f.x) - box.x) / box.width, v = (double(f.y) - box.y) / box.height;
        if (!(u >= 0 && v >= 0 && u < 1 && v < 1)) continue;
        const std::uint32_t quarter = 1 + std::uint32_t(u >= 0.5) + 2 * std::uint32_t(v >= 0.5);
        for (const Match& match : matches.subspan(i, end - i)) {
            by_word.push_back({match.word, static_cast<std::uint32_t>(by_word.size())});
            quarters.push_back({quarter, match.weight});
            total += 2 * double(match.weight);
        }
    }
    detail::sort_ranked(by_word);
    std::vector<SparseEntry> bins;
    for (std::uint32_t cell = 0; cell < BoxClassifier::cells; ++cell)
        for (const detail::Ranked& word : by_word) {
            const auto& [quarter, weight] = quarters[word.index];
            if (cell != 0 && cell != quarter) continue;
            const auto bin = static_cast<std::uint32_t>(cell * words + word.key);
            if (bins.empty() || bins.back().index != bin)
                bins.push_back({bin, weight});
            else
                bins.back().value += weight;
        }
    for (SparseEntry& bin : bins) bin.value = static_cast<float>(std::sqrt(bin.value / total));
    return bins;
}

}  // namespace ism
