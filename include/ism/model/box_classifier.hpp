// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/codebook/codebook.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/grouped.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/logistic.hpp"
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

    Grouped<SparseEntry>
        weights;              ///< of each class, for the bins of WordMap::histogram(); other bins weigh 0
    std::vector<float> bias;  ///< of each class

    [[nodiscard]] bool empty() const { return bias.empty(); }
    [[nodiscard]] std::size_t classes() const { return bias.size(); }

    /// @brief Adds a class.
    void push_back(const std::vector<SparseEntry>& class_weights, float class_bias) {
        weights.push_back(class_weights);
        bias.push_back(class_bias);
    }

    /// @brief The logarithm of the odds that a box with these words shows the class.
    [[nodiscard]] double logit(std::size_t class_index, const std::vector<SparseEntry>& histogram) const {
        double sum = bias[class_index];
        std::span<const SparseEntry> own = weights[class_index];
        for (const SparseEntry& bin : histogram) {
            const auto at = std::lower_bound(
                own.begin(), own.end(), bin.index,
                [](const SparseEntry& weight, std::uint32_t index) { return weight.index < index; });
            own = own.subspan(std::size_t(at - own.begin()));
            if (!own.empty() && own.front().index == bin.index) sum += double(bin.value) * own.front().value;
        }
        return sum;
    }
    /// @brief p(class | words in the box), 0 … 1; 1 without a classifier.
    [[nodiscard]] double probability(std::size_t class_index,
                                     const std::vector<SparseEntry>& histogram) const {
        return empty() ? 1 : logistic(logit(class_index, histogram));
    }
};

/// @brief The words of an image, ready to be counted in boxes.
class WordMap {
public:
    WordMap() = default;
    /// @param words  of the model, all channels together
    WordMap(const std::vector<Feature>& features, const std::vector<Match>& matches, std::size_t words)
        : words_(words), places_(matches.size()) {
        std::vector<detail::Ranked> by_word(matches.size());
        for (std::uint32_t i = 0; i < by_word.size(); ++i) by_word[i] = {matches[i].word, i};
        detail::sort_ranked(by_word.data(), by_word.size());
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const Match& match = matches[by_word[i].index];
            const Feature& f = features[match.feature];
            places_[i] = {f.x, f.y, match.word, match.weight};
        }
    }

    /// @brief The words in a box and in each of its quarters, bin cell · words + word: roots of shares, so
    /// that their squares add up to 1 (Arandjelović and Zisserman 2012 do so with SIFT). Empty where no word
    /// is in the box.
    [[nodiscard]] std::vector<SparseEntry> histogram(const Box& box) const {
        std::array<std::vector<SparseEntry>, BoxClassifier::cells> cells;
        const auto count = [&](std::size_t cell, const Place& place) {
            const auto bin = static_cast<std::uint32_t>(cell * words_ + place.word);
            const SparseEntry entry{bin, place.weight};
            if (!cells[cell].empty() && cells[cell].back().index == bin)
                cells[cell].back().value += place.weight;
            else
                cells[cell].push_back(entry);
        };
        double total = 0;
        for (const Place& place : places_) {
            const double x = double(place.x) - box.x, y = double(place.y) - box.y;
            if (!(x >= 0 && y >= 0 && x < box.width && y < box.height)) continue;
            count(0, place);
            count(1 + std::size_t(x >= box.width / 2) + 2 * std::size_t(y >= box.height / 2), place);
            total += 2 * double(place.weight);
        }
        std::vector<SparseEntry> bins = std::move(cells[0]);
        for (std::size_t cell = 1; cell < cells.size(); ++cell) detail::append(bins, cells[cell]);
        for (SparseEntry& bin : bins) bin.value = static_cast<float>(std::sqrt(bin.value / total));
        return bins;
    }

private:
    struct Place {
        float x, y;
        std::uint32_t word;
        float weight;
    };

    std::size_t words_ = 0;
    std::vector<Place> places_;  // by rising word
};

}  // namespace ism
