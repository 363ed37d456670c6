// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/detect/learn_appearance.hpp"
#include "ism/vote/appearance.hpp"

namespace ism {

/// @brief A judge of boxes laid out for a codebook that has grown. A word that several became judges as they
/// did on average; words that are new say nothing.
/// @param word_now  of each word of before
/// @param words     of the codebook now
/// @throws Error where the judge is not one of so many words.
[[nodiscard]] inline Appearance moved_appearance(const Appearance& before,
                                                 std::span<const std::uint32_t> word_now, std::size_t words) {
    if (before.empty()) return {};
    expect(before.bins() == Appearance::cells * word_now.size(), "judge of boxes: bins",
           Appearance::cells * word_now.size(), before.bins());
    std::vector<float> became(words, 0);
    for (const std::uint32_t w : word_now) {
        expect(w < words, "judge of boxes: word now", join_text("below ", words), w);
        ++became[w];
    }
    const std::size_t bins = Appearance::cells * words;
    Appearance now{.weights = std::vector<float>(before.bias.size() * bins, 0), .bias = before.bias};
    for (std::size_t c = 0; c < before.bias.size(); ++c)
        for (std::size_t cell = 0; cell < Appearance::cells; ++cell)
            for (std::size_t w = 0; w < word_now.size(); ++w)
                now.weights[c * bins + cell * words + word_now[w]] +=
                    before.weights[c * before.bins() + cell * word_now.size() + w] / became[word_now[w]];
    return now;
}

/// @brief A judge with those of new classes after those it has, which stay: fit_appearance() for the new ones
/// alone.
/// @param samples  boxes of new and present classes; what only a present class was wrongly taken for is
/// unused
[[nodiscard]] inline Appearance with_new_judges(Appearance present, std::vector<AppearanceSample> samples,
                                                std::size_t words, std::size_t classes,
                                                const AppearanceOptions& options = {}, unsigned threads = 0) {
    const std::size_t known = present.bias.size();
    expect(present.empty() || present.bins() == Appearance::cells * words, "judge of boxes: bins",
           Appearance::cells * words, present.bins());
    expect(classes >= known, "judge of boxes: classes", join_text(known, " or more"), classes);
    // New classes are numbered from 0; all of before is one other class.
    const auto other = static_cast<std::uint32_t>(classes - known);
    const auto renumber = [&](std::uint32_t& c) {
        if (c != AppearanceSample::background) c = c < known ? other : c - std::uint32_t(known);
    };
    for (AppearanceSample& sample : samples) renumber(sample.shows), renumber(sample.taken_for);
    const Appearance fresh = fit_appearance(samples, words, other, options, threads);
    present.weights.insert(present.weights.end(), fresh.weights.begin(), fresh.weights.end());
    present.bias.insert(present.bias.end(), fresh.bias.begin(), fresh.bias.end());
    return present;
}

}  // namespace ism
