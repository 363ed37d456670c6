// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "ism/codebook/live_clusters.hpp"
#include "ism/codebook/near_lists.hpp"
#include "ism/codebook/sieve.hpp"
#include "ism/core/aligned.hpp"
#include "ism/core/parallel.hpp"

namespace ism::detail {

/// Fills the lists of some clusters from all pairs of these and of these with others. Pairs go through the
/// sieve, strips against panels; the few that pass are measured. A pair of two that ask is looked at once and
/// serves both.
class NearSearch {
public:
    NearSearch(const LiveClusters& live, NearLists& lists, std::span<const std::uint32_t> asking,
               std::span<const std::uint32_t> others)
        : live_(live), lists_(lists), blocks_((asking.size() + block - 1) / block), asking_(blocks_ * block) {
        slot_.assign(asking.begin(), asking.end());
        slot_.resize(asking_, none);
        slot_.insert(slot_.end(), others.begin(), others.end());
        slot_.resize((slot_.size() + sieve_columns - 1) / sieve_columns * sieve_columns, none);
        start_.assign(slot_.size(), std::numeric_limits<float>::infinity());
        bar_.assign(slot_.size(), std::numeric_limits<float>::infinity());
        panels_.assign(slot_.size() * sieve_depth, 0.0f);
        for (std::size_t at = 0; at < slot_.size(); ++at) {
            if (slot_[at] == none) continue;
            start_[at] = live.half_square(slot_[at]);
            if (at < asking_) bar_[at] = -0.5f * lists.reach(slot_[at]);
            float* numbers =
                panels_.data() + at / sieve_columns * sieve_columns * sieve_depth + at % sieve_columns;
            for (std::size_t k = 0; k < sieve_depth; ++k)
                numbers[k * sieve_columns] = live.head(slot_[at])[k];
        }
    }

    void run(Team& team) {
        team.each(blocks_, [&](std::size_t a, unsigned /*worker*/) { meet(a, a); });
        // Blocks that ask meet as teams of a league do, each once with every other: pairs of a day have no
        // block in common, so that they may go on at the same time.
        const std::size_t even = blocks_ + blocks_ % 2;
        for (std::size_t day = 0; day + 1 < even; ++day)
            team.each(even / 2, [&](std::size_t game, unsigned /*worker*/) {
                const std::size_t days = even - 1;
                const std::size_t a = game == 0 ? days : (day + game) % days;
                const std::size_t b = (day + days - game) % days;
                if (std::max(a, b) < blocks_) meet(a, b);
            });
        team.each(asking_ / sieve_rows, [&](std::size_t strip, unsigned /*worker*/) {
            meet(strip * sieve_rows, asking_, slot_.size());
        });
    }

private:
    static constexpr std::size_t block = sieve_rows * sieve_columns;
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    /// A pair that passed, by places in the search.
    struct Pair {
        std::uint32_t row, column;
        float sq_distance;
    };

    void meet(std::size_t a, std::size_t b) {
        for (std::size_t row = a * block; row < (a + 1) * block; row += sieve_rows)
            meet(row, b * block, (b + 1) * block);
    }

    /// The strip that begins at `row` with the columns from `first` to before `last`; within a block a row
    /// only with columns behind it.
    void meet(std::size_t row, std::size_t first, std::size_t last) {
        if (slot_[row] == none) return;
        const bool within = first <= row && row < last;
        SieveStrip strip{{}, start_.data() + row, bar_.data() + row};
        for (std::size_t r = 0; r < sieve_rows; ++r)  // where there is none, its start lets nothing pass
            strip.numbers[r] = live_.head(slot_[row + r] == none ? slot_[row] : slot_[row + r]);
        if (within) first = row / sieve_columns * sieve_columns;
        for (; first < last; first += block) {
            // first what passes, then distances, then lists: each a loop without surprises
            std::array<Pair, sieve_rows * block> pairs;
            std::size_t count = 0;
            for (std::size_t column = first; column < std::min(last, first + block);
                 column += sieve_columns) {
                const SievePassed passed = live_.kernel().sieve(
                    strip,
                    {panels_.data() + column * sieve_depth, start_.data() + column, bar_.data() + column});
                for (std::size_t r = 0; r < sieve_rows; ++r)
                    for (unsigned left = passed[r]; left != 0; left &= left - 1) {
                        const std::size_t c = column + std::size_t(std::countr_zero(left));
                        pairs[count] = {std::uint32_t(row + r), std::uint32_t(c), 0};
                        count += !within || c > row + r;
                    }
            }
            for (Pair& pair : std::span(pairs.data(), count))
                pair.sq_distance = live_.sq_distance(slot_[pair.row], slot_[pair.column]);
            for (const Pair& pair : std::span(pairs.data(), count)) {
                put(pair.row, {pair.sq_distance, slot_[pair.column]});
                if (pair.column < asking_) put(pair.column, {pair.sq_distance, slot_[pair.row]});
            }
        }
    }

    void put(std::size_t at, const Near& near) {
        lists_.insert(slot_[at], near);
        bar_[at] = -0.5f * lists_.reach(slot_[at]);
    }

    const LiveClusters& live_;
    NearLists& lists_;
    std::size_t blocks_, asking_;
    std::vector<std::uint32_t> slot_;
    AlignedVector<float> start_, bar_, panels_;
};

}  // namespace ism::detail
