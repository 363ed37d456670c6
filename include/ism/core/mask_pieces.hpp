// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"

namespace ism {

/// @brief A mask without its specks: pieces of it, whose pixels are neighbours along rows and columns, that
/// cover less than this share of the largest piece. Pieces are joined run by run (union-find), row by row.
/// @param share  0 (all stay) … 1 (the largest alone stays, with others as large)
[[nodiscard]] inline Mask without_specks(Mask mask, double share) {
    struct Run {  // figure pixels side by side
        int y, begin, end;
    };
    std::vector<Run> runs;
    std::vector<std::uint32_t> leaders;  // of each run, one of its piece that came before; itself at the end
    const auto leader = [&](std::size_t run) {
        while (leaders[run] != run) run = leaders[run] = leaders[leaders[run]];
        return std::uint32_t(run);
    };
    std::size_t above = 0;  // the first run of the row above that may touch
    for (int y = 0; y < mask.height(); ++y) {
        const std::size_t first = runs.size();
        for (int x = 0; x < mask.width(); ++x) {
            if (mask(x, y) == 0) continue;
            const int begin = x;
            while (x < mask.width() && mask(x, y) != 0) ++x;
            leaders.push_back(std::uint32_t(runs.size()));
            runs.push_back({y, begin, x});
            while (above < first && runs[above].end <= begin) ++above;
            for (std::size_t k = above; k < first && runs[k].begin < x; ++k) {
                const auto [one, other] = std::minmax({leader(k), leader(runs.size() - 1)});
                leaders[other] = one;
            }
        }
        above = first;
    }
    std::vector<std::size_t> area(runs.size(), 0);  // of each leader's piece
    std::size_t largest = 0;
    for (std::size_t k = 0; k < runs.size(); ++k) {
        std::size_t& piece = area[leader(k)];
        piece += std::size_t(runs[k].end - runs[k].begin);
        largest = std::max(largest, piece);
    }
    for (std::size_t k = 0; k < runs.size(); ++k)
        if (double(area[leader(k)]) < share * double(largest))
            for (int x = runs[k].begin; x < runs[k].end; ++x) mask(x, runs[k].y) = 0;
    return mask;
}

}  // namespace ism
