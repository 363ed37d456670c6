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

#include "ism/codebook/filter.hpp"
#include "ism/codebook/query_block.hpp"
#include "ism/codebook/word_index.hpp"
#include "ism/feature/feature.hpp"

namespace ism::detail {

/// A word and how far it is.
struct NearWord {
    double sq_distance = std::numeric_limits<double>::infinity();
    std::uint32_t word = std::numeric_limits<std::uint32_t>::max();
};

/// Finds the nearest words of one block of descriptors after another, in memory of its own. The words are
/// looked at in their order; how far the last of the nearest so far lies is how far the filter reaches.
class BlockNearest {
public:
    /// Finds `each` of all words but left_out … left_out_end − 1; there must be so many.
    BlockNearest(const WordIndex& index, std::size_t each, std::size_t left_out, std::size_t left_out_end)
        : index_(&index),
          each_(each),
          left_out_(left_out),
          left_out_end_(left_out_end),
          near_(filter_block * each) {
        queries_.start(index);
    }

    /// Those of the descriptors from `first` on, `each` after `each`.
    [[nodiscard]] std::span<const NearWord> find(const Descriptors<float>& descriptors, std::size_t first) {
        queries_.load(descriptors, first);
        std::fill(near_.begin(), near_.end(), NearWord{});
        if (index_->uses_bytes())
            search(index_->byte_filter(), byte_block_);
        else
            search(index_->float_filter(), float_block_);
        return std::span(near_).first(queries_.count() * each_);
    }

private:
    struct Candidate {
        double sq_distance;
        std::uint32_t query, word;
    };

    /// Candidates, distances, lists: each a loop of its own, which branches are easy to predict in.
    template <CandidateFilter Filter>
    void search(const Filter& filter, typename Filter::Block& block) {
        filter.prepare(queries_.rows(), queries_.sq_lengths(), std::numeric_limits<double>::infinity(),
                       block);
        std::array<std::uint64_t, filter_block> masks{};
        for (std::size_t first = 0; first < index_->size(); first += filter_group) {
            const std::uint64_t asked = words_asked(first);
            if (asked == 0) continue;
            filter.masks(block, first / filter_group, std::span(masks.data(), queries_.tiled_count()));
            candidates_.clear();
            for (std::size_t i = 0; i < queries_.count(); ++i)
                for (std::uint64_t mask = masks[i] & asked; mask != 0; mask &= mask - 1) {
                    const auto word = std::uint32_t(first) + std::uint32_t(std::countr_zero(mask));
                    index_->prefetch(word);
                    candidates_.push_back({0, std::uint32_t(i), word});
                }
            for (Candidate& pair : candidates_)
                pair.sq_distance = queries_.sq_distance(pair.query, pair.word);
            for (const Candidate& pair : candidates_) {
                const std::span near(near_.data() + pair.query * each_, each_);
                if (!(pair.sq_distance < near.back().sq_distance)) continue;
                insert({pair.sq_distance, pair.word}, near);
                filter.limit(block, pair.query, queries_.sq_lengths()[pair.query], near.back().sq_distance);
            }
        }
    }

    /// Those of the group of words from `first` on that there are and that are not left out.
    [[nodiscard]] std::uint64_t words_asked(std::size_t first) const {
        const auto before = [&](std::size_t end) {
            const std::size_t count = std::clamp(end, first, first + filter_group) - first;
            return count == filter_group ? ~std::uint64_t(0) : (std::uint64_t(1) << count) - 1;
        };
        return before(index_->size()) & ~(before(left_out_end_) & ~before(left_out_));
    }

    /// Puts a word, the last of all so far and nearer than the last of the nearest, in its place.
    static void insert(const NearWord& next, std::span<NearWord> near) {
        std::size_t at = near.size() - 1;
        for (; at > 0 && next.sq_distance < near[at - 1].sq_distance; --at) near[at] = near[at - 1];
        near[at] = next;
    }

    const WordIndex* index_;
    std::size_t each_, left_out_, left_out_end_;
    QueryBlock queries_;
    FloatFilter::Block float_block_;
    ByteFilter::Block byte_block_;
    std::vector<NearWord> near_;
    std::vector<Candidate> candidates_;
};

}  // namespace ism::detail
