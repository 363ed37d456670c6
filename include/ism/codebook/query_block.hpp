// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "ism/codebook/filter.hpp"
#include "ism/codebook/word_index.hpp"
#include "ism/feature/feature.hpp"

namespace ism::detail {

/// A block of descriptors as filters want them. One block is loaded after another, into the same memory.
class QueryBlock {
public:
    /// Makes it ready for an index, which has to stay.
    void start(const WordIndex& index) {
        index_ = &index;
        rows_ = std::vector<float>(filter_block * index.dimension());
        sq_lengths_ = std::vector<double>(filter_block);
    }

    /// The descriptors from `first` on. Rows that are missing or not finite reach nothing; they hold what
    /// another row holds, so that they do not widen the range.
    void load(const Descriptors<float>& descriptors, std::size_t first) {
        const std::size_t dimension = index_->dimension();
        first_ = first;
        count_ = std::min(filter_block, descriptors.size() - first);
        const float* good = nullptr;
        for (std::size_t i = 0; i < filter_block; ++i) {
            float* row = rows_.data() + i * dimension;
            sq_lengths_[i] = std::numeric_limits<double>::infinity();
            if (i < count_) {
                const auto from = descriptors.row(first + i);
                std::copy(from.begin(), from.end(), row);
                sq_lengths_[i] = index_->sq_length(row);
            }
            if (sq_lengths_[i] < std::numeric_limits<double>::infinity())
                good = row;
            else if (good != nullptr)
                std::copy_n(good, dimension, row);
            else
                std::fill_n(row, dimension, 0.0f);
        }
    }

    [[nodiscard]] std::size_t first() const { return first_; }
    [[nodiscard]] std::size_t count() const { return count_; }
    /// The count in whole tiles.
    [[nodiscard]] std::size_t tiled_count() const {
        return (count_ + filter_tile - 1) / filter_tile * filter_tile;
    }
    /// Of filter_block rows.
    [[nodiscard]] std::span<const float> rows() const { return rows_; }
    /// Of filter_block rows; infinite or NaN for those that reach nothing.
    [[nodiscard]] const std::vector<double>& sq_lengths() const { return sq_lengths_; }

    /// The distance of query i to a word.
    [[nodiscard]] double sq_distance(std::size_t i, std::size_t word) const {
        return index_->sq_distance(rows_.data() + i * index_->dimension(), sq_lengths_[i], word);
    }

private:
    const WordIndex* index_ = nullptr;
    std::size_t first_ = 0, count_ = 0;
    std::vector<float> rows_;
    std::vector<double> sq_lengths_;
};

}  // namespace ism::detail
