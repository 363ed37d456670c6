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

/// @brief A bin and its value; of a row of bins those alone that are not 0, rising.
struct BinValue {
    std::uint32_t bin = 0;
    float value = 0;
    [[nodiscard]] bool operator==(const BinValue&) const = default;
};

/// @brief What boxes of each class hold: for each class a linear judge of the words in a box, which sees also
/// what a vote does not count: words that speak against the class. Empty = no judge, all boxes look right.
/// (Discriminative verification of hypotheses: Fritz, Leibe, Caputo and Schiele 2005.)
struct Appearance {
    static constexpr std::size_t cells = 5;  ///< the whole box and its four quarters

    std::vector<std::uint32_t> first = {0};  ///< class c has the weights first[c] … first[c + 1] − 1
    std::vector<BinValue> weights;           ///< of a class's bins, rising; other bins say nothing of it
    std::vector<float> bias;                 ///< one a class

    [[nodiscard]] bool empty() const { return bias.empty(); }
    [[nodiscard]] std::size_t classes() const { return bias.size(); }
    [[nodiscard]] std::span<const BinValue> of_class(std::size_t class_index) const {
        return std::span(weights).subspan(first[class_index], first[class_index + 1] - first[class_index]);
    }

    /// @brief Adds the judge of one class more.
    /// @param own  its weights, bins rising
    void push_back(std::span<const BinValue> own, float own_bias) {
        weights.insert(weights.end(), own.begin(), own.end());
        first.push_back(static_cast<std::uint32_t>(weights.size()));
        bias.push_back(own_bias);
    }

    /// @brief p(class | words in the box), 0 … 1; 1 without a judge.
    [[nodiscard]] double probability(std::size_t class_index, std::span<const BinValue> box) const {
        if (empty()) return 1;
        double sum = bias[class_index];
        std::span<const BinValue> own = of_class(class_index);
        for (const BinValue& b : box) {
            const auto at =
                std::lower_bound(own.begin(), own.end(), b.bin,
                                 [](const BinValue& w, std::uint32_t bin) { return w.bin < bin; });
            own = own.subspan(std::size_t(at - own.begin()));
            if (!own.empty() && own.front().bin == b.bin) sum += double(b.value) * own.front().value;
        }
        return 1 / (1 + std::exp(-sum));
    }
};

/// @brief The words in a box and in each of its quarters: roots of shares, so that their squares add up to 1
/// (Arandjelovic and Zisserman 2012 do so with SIFT). Empty where no word is in the box.
/// @param words  of the codebook
[[nodiscard]] inline std::vector<BinValue> word_histogram(std::span<const Feature> features,
                                                          std::span<const Match> matches, std::size_t words,
                                                          const Box& box) {
    std::vector<BinValue> bins;
    double total = 0;
    for (std::size_t i = 0, end = 0; i < matches.size(); i = end) {  // the matches of a feature
        const Feature& f = features[matches[i].feature];
        while (end < matches.size() && matches[end].feature == matches[i].feature) ++end;
        const double u = (double(f.x) - box.x) / box.width, v = (double(f.y) - box.y) / box.height;
        if (!(u >= 0 && v >= 0 && u < 1 && v < 1)) continue;
        const std::size_t quarter = 1 + std::size_t(u >= 0.5) + 2 * std::size_t(v >= 0.5);
        for (const Match& match : matches.subspan(i, end - i)) {
            bins.push_back({match.word, match.weight});
            bins.push_back({static_cast<std::uint32_t>(quarter * words + match.word), match.weight});
            total += 2 * double(match.weight);
        }
    }
    std::stable_sort(bins.begin(), bins.end(),
                     [](const BinValue& a, const BinValue& b) { return a.bin < b.bin; });
    std::size_t count = 0;
    for (const BinValue& b : bins) {
        if (count > 0 && bins[count - 1].bin == b.bin)
            bins[count - 1].value += b.value;
        else
            bins[count++] = b;
    }
    bins.resize(count);
    for (BinValue& b : bins) b.value = static_cast<float>(std::sqrt(b.value / total));
    return bins;
}

}  // namespace ism
