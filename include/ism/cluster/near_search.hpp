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

#include "ism/cluster/live_clusters.hpp"
#include "ism/cluster/near_lists.hpp"
#include "ism/cluster/sieve.hpp"
#include "ism/core/aligned.hpp"
#include "ism/core/thread_pool.hpp"

namespace ism::detail {

/// Fills the lists of some clusters from all pairs of these and of these with others. Pairs go through the
/// sieve, strips against panels; the few that pass are measured. A pair of two that ask is looked at once and
/// serves both; the last `settled` of those that ask have nothing to find among each other.
class NearSearch {
public:
    NearSearch(const LiveClusters& live, NearLists& lists, std::span<const std::uint32_t> asking,
               std::span<const std::uint32_t> others, std::size_t settled = 0)
        : live_(live),
          lists_(lists),
          blocks_((asking.size() + block - 1) / block),
          asking_(blocks_ * block),
          settled_from_(asking.size() - settled) {
        slot_.assign(asking.begin(), asking.end());
        slot_.resize(asking_, none);
        slot_.insert(slot_.end(), others.begin(), others.end());
        slot_.resize((slot_.size() + sieve_columns - 1) / sieve_columns * sieve_columns, none);
        start_.resize(slot_.size());
        bar_.resize(slot_.size());
        panels_.resize(slot_.size() * sieve_depth);
    }

    void run(ThreadPool& pool) {
        pool.for_each(slot_.size() / sieve_columns,
                      [&](std::size_t panel, unsigned /*worker*/) { pack(panel * sieve_columns); });
        // Those that ask are split into squads, which meet as in a league: each day all squads play, two and
        // two, so that no two games of a day have a squad in common and all may go on at the same time.
        const std::size_t most = std::max<std::size_t>(64, 4 * std::size_t(pool.size()));
        const std::size_t squad = std::max<std::size_t>(1, (blocks_ + most - 1) / most);
        const std::size_t squads = (blocks_ + squad - 1) / squad, days = (squads + 1) / 2 * 2 - 1;
        pool.for_each(squads, [&](std::size_t a, unsigned /*worker*/) { play(a, a, squad); });
        for (std::size_t day = 0; squads > 1 && day < days; ++day)
            pool.for_each((days + 1) / 2, [&](std::size_t game, unsigned /*worker*/) {
                const std::size_t a = game == 0 ? days : (day + game) % days;
                const std::size_t b = (day + days - game) % days;
                if (std::max(a, b) < squads) play(a, b, squad);
            });
        pool.for_each(asking_ / sieve_rows, [&](std::size_t strip, unsigned /*worker*/) {
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

    /// Makes the panel of the places from `first` on.
    void pack(std::size_t first) {
        float* numbers = panels_.data() + first * sieve_depth;
        for (std::size_t at = first; at < first + sieve_columns; ++at, ++numbers) {
            const bool used = slot_[at] != none;
            constexpr float never = std::numeric_limits<float>::infinity();
            start_[at] = used ? live_.half_square(slot_[at]) : never;
            bar_[at] = used && at < asking_ ? -0.5f * lists_.reach(slot_[at]) : never;
            for (std::size_t k = 0; k < sieve_depth; ++k)
                numbers[k * sieve_columns] = used ? live_.head(slot_[at])[k] : 0.0f;
        }
    }

    /// All pairs of two squads, or of one: blocks by blocks, near ones first.
    void play(std::size_t a, std::size_t b, std::size_t squad) {
        for (std::size_t i = a * squad; i < std::min(blocks_, (a + 1) * squad); ++i)
            for (std::size_t j = a == b ? i : b * squad; j < std::min(blocks_, (b + 1) * squad); ++j)
                if (std::min(i, j) * block < settled_from_)
                    for (std::size_t row = i * block; row < (i + 1) * block; row += sieve_rows)
                        meet(row, j * block, (j + 1) * block);
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
            // first what passes, then distances, then lists: each a loop without surprises. What passes, and
            // the bound below, depend on the instruction set; what comes on lists does not.
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
                        count += (!within || c > row + r) && std::min(row + r, c) < settled_from_;
                    }
            }
            std::size_t near = 0;
            for (const Pair& pair : std::span(pairs.data(), count)) {
                const float least = live_.sq_distance_bound(slot_[pair.row], slot_[pair.column]);
                pairs[near] = pair;
                near += -0.5f * least >= std::min(bar_[pair.row], bar_[pair.column]);
            }
            count = near;
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
    std::size_t blocks_, asking_, settled_from_;
    std::vector<std::uint32_t> slot_;
    AlignedVector<float> start_, bar_, panels_;
};

}  // namespace ism::detail
