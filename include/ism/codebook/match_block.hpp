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

#include "ism/codebook/codebook.hpp"
#include "ism/codebook/filter.hpp"
#include "ism/codebook/query_block.hpp"
#include "ism/codebook/word_index.hpp"
#include "ism/feature/feature.hpp"

namespace ism::detail {

/// Matches one block of descriptors after another, in memory of its own.
class BlockMatcher {
public:
    /// Makes it ready for an index, which has to stay.
    void start(const WordIndex& index) {
        index_ = &index;
        queries_.start(index);
        of_group_ = std::vector<OfGroup>(index.group_count());
    }

    /// The matches of the descriptors from `first` on, by descriptor, then by word.
    [[nodiscard]] std::vector<Match> match(const Descriptors<float>& descriptors, std::size_t first) {
        queries_.load(descriptors, first);
        hits_.clear();
        if (index_->uses_bytes())
            search(index_->byte_filter(), byte_block_);
        else
            search(index_->float_filter(), float_block_);
        return matches();
    }

private:
    struct Hit {
        double sq_distance;
        std::uint32_t query, word;
    };
    struct OfGroup {
        std::uint32_t count = 0, nearest = 0;
        double sq_distance = std::numeric_limits<double>::infinity();
    };

    /// Finds all words within the threshold.
    template <CandidateFilter Filter>
    void search(const Filter& filter, typename Filter::Block& block) {
        filter.prepare(queries_.rows(), queries_.sq_lengths(), index_->max_sq_distance(), block);
        std::array<std::uint64_t, filter_block> masks{};
        const std::span used(masks.data(), queries_.tiled_count());
        for (std::size_t first = 0; first < index_->size(); first += filter_group) {
            filter.masks(block, first / filter_group, used);
            const std::size_t none = filter_group - std::min(filter_group, index_->size() - first);
            for (std::size_t i = 0; i < queries_.count(); ++i)
                for (std::uint64_t mask = masks[i] & ~std::uint64_t(0) >> none; mask != 0; mask &= mask - 1) {
                    const auto word = std::uint32_t(first) + std::uint32_t(std::countr_zero(mask));
                    const double distance = queries_.sq_distance(i, word);
                    if (distance <= index_->max_sq_distance())
                        hits_.push_back({distance, std::uint32_t(i), word});
                }
        }
    }

    [[nodiscard]] std::vector<Match> matches() {
        std::array<std::size_t, filter_block + 1> begin{};
        for (const Hit& hit : hits_) ++begin[hit.query + 1];
        for (std::size_t i = 0; i < filter_block; ++i) begin[i + 1] += begin[i];
        std::vector<Hit> sorted(hits_.size());
        auto next = begin;
        for (const Hit& hit : hits_) sorted[next[hit.query]++] = hit;

        std::vector<Match> matches;
        matches.reserve(hits_.size());
        for (std::size_t i = 0; i < queries_.count(); ++i) {
            const Hit *const first = sorted.data() + begin[i], *const end = sorted.data() + begin[i + 1];
            for (const Hit* hit = first; hit < end; ++hit) {
                OfGroup& group = of_group_[index_->group(hit->word)];
                ++group.count;
                if (hit->sq_distance < group.sq_distance)
                    group.sq_distance = hit->sq_distance, group.nearest = hit->word;
            }
            for (const Hit* hit = first; hit < end; ++hit) {
                const OfGroup& group = of_group_[index_->group(hit->word)];
                const Match match{std::uint32_t(queries_.first() + i), hit->word, 1.0f / float(group.count),
                                  group.nearest == hit->word};
                matches.push_back(match);
            }
            for (const Hit* hit = first; hit < end; ++hit) of_group_[index_->group(hit->word)] = {};
        }
        return matches;
    }

    const WordIndex* index_ = nullptr;
    QueryBlock queries_;
    FloatFilter::Block float_block_;
    ByteFilter::Block byte_block_;
    std::vector<Hit> hits_;          // by 64 words and descriptor
    std::vector<OfGroup> of_group_;  // empty between descriptors
};

}  // namespace ism::detail
