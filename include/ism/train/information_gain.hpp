// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "ism/core/error.hpp"

namespace ism {

/// @brief Information gain of each word about the class (Eq 3):
/// G(w) = 1/n Σ_c P(w, c) log(P(w, c) / (P(w) P(c))), natural logarithm, where 0 log 0 = 0.
/// @param counts  words × classes, row after row: how often word and class were seen together, ≥ 0
/// @throws Error where there is no class, the size does not fit, a count is negative or not finite.
[[nodiscard]] inline std::vector<double> information_gain(const std::vector<double>& counts,
                                                          std::size_t classes) {
    expect(classes > 0 && counts.size() % classes == 0, "information gain: number of counts",
           lazy_text("a multiple of ", classes, " classes"), counts.size());
    const std::size_t words = counts.size() / classes;
    double total = 0;
    std::vector<double> of_word(words, 0), of_class(classes, 0);
    for (std::size_t w = 0; w < words; ++w)
        for (std::size_t c = 0; c < classes; ++c) {
            const double count = counts[w * classes + c];
            expect(std::isfinite(count) && count >= 0, "information gain: count", "0 or more", count);
            of_word[w] += count, of_class[c] += count, total += count;
        }
    std::vector<double> gain(words, 0);
    for (std::size_t w = 0; w < words; ++w) {
        for (std::size_t c = 0; c < classes; ++c) {
            const double count = counts[w * classes + c];
            if (count > 0) gain[w] += count / total * std::log(count * total / (of_word[w] * of_class[c]));
        }
        gain[w] /= static_cast<double>(classes);
    }
    return gain;
}

}  // namespace ism
