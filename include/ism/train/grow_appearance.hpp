// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/model/appearance.hpp"
#include "ism/train/learn_appearance.hpp"

namespace ism {

/// @brief A judge of boxes laid out for a codebook that has grown. A word that several became judges as they
/// did on average; words that are new say nothing.
/// @param word_now  of each word of before
/// @param words     of the codebook now
/// @throws Error where the judge has bins of other words, or there are fewer words now than `word_now` tells.
[[nodiscard]] inline Appearance moved_appearance(const Appearance& before,
                                                 std::span<const std::uint32_t> word_now, std::size_t words) {
    expect(before.weights.empty() || !word_now.empty(), "judge of boxes: words of before", "1 or more", 0);
    std::vector<float> became(words, 0);
    for (const std::uint32_t w : word_now) {
        expect(w < words, "judge of boxes: word now", lazy_text("below ", words), w);
        ++became[w];
    }
    Appearance now;
    for (std::size_t c = 0; c < before.classes(); ++c) {
        std::vector<BinValue> own, joined;
        for (const BinValue& weight : before.of_class(c)) {
            const std::size_t cell = weight.bin / word_now.size();
            expect(cell < Appearance::cells, "judge of boxes: bin",
                   lazy_text("below ", Appearance::cells * word_now.size()), weight.bin);
            const std::uint32_t word = word_now[weight.bin % word_now.size()];
            own.push_back({static_cast<std::uint32_t>(cell * words + word), weight.value / became[word]});
        }
        std::stable_sort(own.begin(), own.end(),
                         [](const BinValue& a, const BinValue& b) { return a.bin < b.bin; });
        for (const BinValue& weight : own)
            if (!joined.empty() && joined.back().bin == weight.bin)
                joined.back().value += weight.value;
            else
                joined.push_back(weight);
        now.push_back(joined, before.bias[c]);
    }
    return now;
}

/// @brief A judge with those of new classes after those it has, which stay: fit_appearance() for the new ones
/// alone.
/// @param samples  boxes of new and present classes; what only a present class was wrongly taken for is
/// unused
[[nodiscard]] inline Appearance with_new_judges(Appearance present, std::vector<AppearanceSample> samples,
                                                std::size_t words, std::size_t classes,
                                                const AppearanceOptions& options = {}, unsigned threads = 0) {
    const std::size_t known = present.classes();
    expect(classes >= known, "judge of boxes: classes", lazy_text(known, " or more"), classes);
    // New classes are numbered from 0; all of before is one other class.
    const auto other = static_cast<std::uint32_t>(classes - known);
    const auto renumber = [&](std::uint32_t& c) {
        if (c != AppearanceSample::background) c = c < known ? other : c - std::uint32_t(known);
    };
    for (AppearanceSample& sample : samples) renumber(sample.shows), renumber(sample.taken_for);
    const Appearance fresh = fit_appearance(samples, words, other, options, threads);
    for (std::size_t c = 0; c < fresh.classes(); ++c) present.push_back(fresh.of_class(c), fresh.bias[c]);
    return present;
}

}  // namespace ism
