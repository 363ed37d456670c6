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

#include "ism/cluster/active_clusters.hpp"
#include "ism/cluster/neighbour_lists.hpp"
#include "ism/cluster/pruning.hpp"
#include "ism/core/aligned.hpp"
#include "ism/core/thread_pool.hpp"

namespace ism::detail {

/// Fills the lists of some clusters from all pairs of these and of these with others. Tiles of pairs are
/// pruned by lower bounds, strips of rows against panels of columns; the few pairs left are measured. A pair
/// of two that ask is looked at once and serves both; the last `settled` of those that ask have nothing to
/// find among each other.
class NeighbourSearch {
public:
    NeighbourSearch(const ActiveClusters& clusters, NeighbourLists& lists,
                    std::span<const std::uint32_t> asking, std::span<const std::uint32_t> others,
                    std::size_t settled = 0)
        : clusters_(clusters),
          lists_(lists),
          blocks_((asking.size() + block - 1) / block),
          asking_(blocks_ * block),
          settled_from_(asking.size() - settled) {
        slot_.assign(asking.begin(), asking.end());
        slot_.resize(asking_, none);
        slot_.insert(slot_.end(), others.begin(), others.end());
        slot_.resize((slot_.size() + tile_columns - 1) / tile_columns * tile_columns, none);
        half_sq_norm_.make_room(slot_.size());
        cutoff_.make_room(slot_.size());
        panels_.make_room(slot_.size() * projected_dimension);
    }

    void run(ThreadPool& pool) {
        pool.for_each(slot_.size() / tile_columns,
                      [&](std::size_t panel, unsigned /*worker*/) { pack(panel * tile_columns); });
        // Blocks of those that ask are put into groups, all pairs of which are compared in the rounds of a
        // round-robin tournament (circle method, Kirkman 1847): no two pairings of a round share a group, so
        // that all may go on at the same time.
        const std::size_t most = std::max<std::size_t>(64, 4 * std::size_t(pool.size()));
        const std::size_t group_size = std::max<std::size_t>(1, (blocks_ + most - 1) / most);
        const std::size_t groups = (blocks_ + group_size - 1) / group_size, rounds = (groups + 1) / 2 * 2 - 1;
        pool.for_each(groups, [&](std::size_t a, unsigned /*worker*/) { compare_groups(a, a, group_size); });
        for (std::size_t round = 0; groups > 1 && round < rounds; ++round)
            pool.for_each((rounds + 1) / 2, [&](std::size_t pairing, unsigned /*worker*/) {
                const std::size_t a = pairing == 0 ? rounds : (round + pairing) % rounds;
                const std::size_t b = (round + rounds - pairing) % rounds;
                if (std::max(a, b) < groups) compare_groups(a, b, group_size);
            });
        pool.for_each(asking_ / tile_rows, [&](std::size_t strip, unsigned /*worker*/) {
            compare_strip(strip * tile_rows, asking_, slot_.size());
        });
    }

private:
    static constexpr std::size_t block = tile_rows * tile_columns;
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    /// A pair that passed, by places in the search.
    struct Pair {
        std::uint32_t row, column;
        float sq_distance;
    };

    /// Makes the panel of the places from `first` on.
    void pack(std::size_t first) {
        float* numbers = panels_.data() + first * projected_dimension;
        for (std::size_t at = first; at < first + tile_columns; ++at, ++numbers) {
            const bool used = slot_[at] != none;
            constexpr float never = std::numeric_limits<float>::infinity();
            half_sq_norm_[at] = used ? clusters_.half_sq_norm(slot_[at]) : never;
            cutoff_[at] = used && at < asking_ ? -0.5f * lists_.sq_radius(slot_[at]) : never;
            for (std::size_t k = 0; k < projected_dimension; ++k)
                numbers[k * tile_columns] = used ? clusters_.projected(slot_[at])[k] : 0.0f;
        }
    }

    /// All pairs of two groups of blocks, or of one, nearby blocks first.
    void compare_groups(std::size_t a, std::size_t b, std::size_t group_size) {
        for (std::size_t i = a * group_size; i < std::min(blocks_, (a + 1) * group_size); ++i)
            for (std::size_t j = a == b ? i : b * group_size; j < std::min(blocks_, (b + 1) * group_size);
                 ++j)
                if (std::min(i, j) * block < settled_from_)
                    for (std::size_t row = i * block; row < (i + 1) * block; row += tile_rows)
                        compare_strip(row, j * block, (j + 1) * block);
    }

    /// The strip that begins at `row` with the columns from `first` to before `last`; within a block a row
    /// only with columns behind it.
    void compare_strip(std::size_t row, std::size_t first, std::size_t last) {
        if (slot_[row] == none) return;
        const bool within = first <= row && row < last;
        TileRows strip{{}, half_sq_norm_.data() + row, cutoff_.data() + row};
        for (std::size_t r = 0; r < tile_rows; ++r)  // where there is none, its norm lets nothing pass
            strip.numbers[r] = clusters_.projected(slot_[row + r] == none ? slot_[row] : slot_[row + r]);
        if (within) first = row / tile_columns * tile_columns;
        for (; first < last; first += block) {
            // pruning, bounds, distances, lists: each a loop of its own, which branches are easy to predict
            // in. What the first two let pass depends on the instruction set; what comes on lists does not.
            std::array<Pair, tile_rows * block> pairs;
            std::size_t count = 0;
            for (std::size_t column = first; column < std::min(last, first + block); column += tile_columns) {
                const TileMask passed = clusters_.kernels().prune_tile(
                    strip, {panels_.data() + column * projected_dimension, half_sq_norm_.data() + column,
                            cutoff_.data() + column});
                for (std::size_t r = 0; r < tile_rows; ++r)
                    for (unsigned left = passed[r]; left != 0; left &= left - 1) {
                        const std::size_t c = column + std::size_t(std::countr_zero(left));
                        pairs[count] = {std::uint32_t(row + r), std::uint32_t(c), 0};
                        count += (!within || c > row + r) && std::min(row + r, c) < settled_from_;
                    }
            }
            std::size_t kept = 0;
            for (const Pair& pair : std::span(pairs.data(), count)) {
                const float least = clusters_.sq_distance_bound(slot_[pair.row], slot_[pair.column]);
                pairs[kept] = pair;
                kept += -0.5f * least >= std::min(cutoff_[pair.row], cutoff_[pair.column]);
            }
            count = kept;
            for (Pair& pair : std::span(pairs.data(), count))
                pair.sq_distance = clusters_.sq_distance(slot_[pair.row], slot_[pair.column]);
            for (const Pair& pair : std::span(pairs.data(), count)) {
                put(pair.row, {pair.sq_distance, slot_[pair.column]});
                if (pair.column < asking_) put(pair.column, {pair.sq_distance, slot_[pair.row]});
            }
        }
    }

    void put(std::size_t at, const Neighbour& kept) {
        lists_.insert(slot_[at], kept);
        cutoff_[at] = -0.5f * lists_.sq_radius(slot_[at]);
    }

    const ActiveClusters& clusters_;
    NeighbourLists& lists_;
    std::size_t blocks_, asking_, settled_from_;
    std::vector<std::uint32_t> slot_;
    AlignedVector<float> half_sq_norm_, cutoff_, panels_;
};

}  // namespace ism::detail
