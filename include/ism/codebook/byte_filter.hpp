// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include "ism/codebook/byte_kernels.hpp"
#include "ism/codebook/byte_row.hpp"
#include "ism/config.hpp"
#include "ism/core/aligned.hpp"

namespace ism::detail {

/// Finds candidates in bytes. With d = d' + e and w = w' + f, where d' and w' are what bytes stand for, and
/// any c,
///   d·w = d'·w' + c·f + (d' − c)·f + c·e + e·(w − c) ≤ d'·w' + c·f + |d' − c||f| + c·e + |e||w − c|,
/// so that no word within reach is missed whatever was rounded. c is the mean of the words: what was lost
/// along it is known, only the rest is bounded.
class ByteFilter {
public:
    struct Block {
        AlignedVector<std::uint8_t> rows;
        AlignedVector<std::int32_t> limits{filter_block};
        AlignedVector<std::int32_t> bias{filter_group};  // of a group of words
        std::array<double, filter_block> rest;           // of each query: its part of the bound of d·w
        double unit = 1;                                 // what 1 of the integers stands for in d·w
        double least = 0;                                // what the byte 0 of a query stands for
        double error = 0, length = 0;                    // the largest |e| and |d' − c|
    };

    ByteFilter() = default;
    ByteFilter(std::span<const float> words, std::span<const float> mean_sq_length, std::size_t dimension,
               InstructionSet isa);

    /// How far the bounds may lie from the squared distances, about; infinite where bytes cannot do.
    [[nodiscard]] double slack() const { return slack_; }
    /// Mean squared distance of the words to their mean, about.
    [[nodiscard]] double spread() const { return spread_; }

    /// Makes a block of queries ready. @param rows filter_block rows
    void prepare(std::span<const float> rows, const std::vector<double>& sq_lengths, double max_sq_distance,
                 Block& block) const;

    /// Sets how far query i reaches. One of infinite squared length reaches nothing.
    void limit(Block& block, std::size_t i, double sq_length, double max_sq_distance) const {
        const double most = 0x1p30, products = 0x1p15 * double(padded_);  // no sum of products is larger
        const double bound = (sq_length - max_sq_distance) / 2 - block.rest[i];
        const double exceeds = std::floor(bound / block.unit) - 2;  // 1 each for it and the bias
        if (!(sq_length < std::numeric_limits<double>::infinity()))
            block.limits[i] = std::numeric_limits<std::int32_t>::max();
        else
            block.limits[i] = std::int32_t(std::clamp(exceeds, -most - products - 1, most - products - 1));
    }

    /// Bit j of masks[i] is set where query i may reach word j of the group.
    void masks(Block& block, std::size_t group, std::span<std::uint64_t> masks) const {
        const auto unit = float(1 / block.unit), least = float(block.least * scale_.step);
        const auto error = float(block.error), length = float(block.length);
        for (std::size_t j = 0, w = group * filter_group; j < filter_group; ++j, ++w) {
            const float bias = (known_[w] + least * sum_[w] + error * length_[w] + length * error_[w]) * unit;
            block.bias[j] = std::int32_t(std::min(std::max(bias, -0x1p30f), 0x1p30f));
        }
        kernel_({block.rows.data(), masks.size(), padded_ / 4, block.limits.data(),
                 panels_.data() + group * filter_group * padded_, block.bias.data(), masks.data()});
    }

private:
    std::size_t dimension_ = 0, padded_ = 0;
    ByteScale scale_;                    // of the words
    double middle_ = 0;                  // a signed byte b of a word stands for middle + step · b
    AlignedVector<std::int8_t> panels_;  // of 64 words, four numbers of each after another
    std::vector<double> centre_;         // c
    std::vector<float> known_;           // of each word: c·f − mean_sq_length / 2
    std::vector<float> sum_;             // of its signed bytes
    std::vector<float> length_, error_;  // |w − c|, |f|
    double largest_sum_ = 0, largest_known_ = 0, largest_length_ = 0, largest_error_ = 0;
    double slack_ = std::numeric_limits<double>::infinity(), spread_ = 0;
    FilterBytes* kernel_ = nullptr;
};

inline ByteFilter::ByteFilter(std::span<const float> words, std::span<const float> mean_sq_length,
                              std::size_t dimension, InstructionSet isa)
    : dimension_(dimension), padded_((dimension + 7) / 8 * 8), kernel_(byte_kernel(isa)) {
    const std::size_t count = mean_sq_length.size(), room = filter_groups(count) * filter_group;
    if (kernel_ == nullptr || count == 0 || dimension > 16384) return;
    scale_ = byte_scale(words, byte_levels(isa));
    if (!(scale_.step > 1e-12 && scale_.step < 1e12)) return;
    const int half = scale_.levels / 2;
    middle_ = scale_.least + scale_.step * half;
    centre_.assign(dimension, 0.0);
    for (std::size_t w = 0; w < count; ++w)
        for (std::size_t k = 0; k < dimension; ++k)
            centre_[k] += double(words[w * dimension + k]) / double(count);

    panels_.make_room(room * padded_);
    for (auto* values : {&known_, &sum_, &length_, &error_}) values->assign(room, 0.0f);
    std::vector<std::uint8_t> bytes(padded_);
    for (std::size_t w = 0; w < count; ++w) {
        const ByteRounding lost =
            round_row(words.subspan(w * dimension, dimension), centre_.data(), scale_, bytes.data());
        std::int8_t* panel =
            panels_.data() + w / filter_group * filter_group * padded_ + w % filter_group * 4;
        for (std::size_t k = 0; k < dimension; ++k) bytes[k] = std::uint8_t(bytes[k] - half);
        for (std::size_t quad = 0; quad < padded_ / 4; ++quad)
            std::memcpy(panel + quad * filter_group * 4, bytes.data() + quad * 4, 4);
        known_[w] = float(lost.along - double(mean_sq_length[w]) / 2);
        sum_[w] = float(lost.sum - double(half) * double(dimension));
        length_[w] = float(lost.length + lost.error);
        error_[w] = float(lost.error);
        spread_ += lost.length * lost.length / double(count);
        largest_known_ = std::max(largest_known_, std::abs(double(known_[w])));
        largest_sum_ = std::max(largest_sum_, std::abs(double(sum_[w])));
        largest_length_ = std::max(largest_length_, double(length_[w]));
        largest_error_ = std::max(largest_error_, double(error_[w]));
    }
    slack_ = 4 * largest_length_ * largest_error_;
}

inline void ByteFilter::prepare(std::span<const float> rows, const std::vector<double>& sq_lengths,
                                double max_sq_distance, Block& block) const {
    block.rows.make_room(filter_block * padded_);
    ByteScale scale = byte_scale(rows, scale_.levels);
    scale.step = std::max(scale.step, scale_.step * 0x1p-10);
    block.least = scale.least, block.unit = scale.step * scale_.step;
    block.error = block.length = 0;
    for (std::size_t i = 0; i < filter_block; ++i) {
        const ByteRounding lost = round_row(rows.subspan(i * dimension_, dimension_), centre_.data(), scale,
                                            block.rows.data() + i * padded_);
        block.error = std::max(block.error, lost.error);
        block.length = std::max(block.length, lost.length);
        // d'·w' = least·Σw' + step·middle·Σb + step·step·Σ b·b, of which the first belongs to the word
        block.rest[i] = lost.along + middle_ * (double(dimension_) * scale.least + scale.step * lost.sum);
    }
    // what the floats that make up the bias, and all this in double, may hide
    const double size = largest_known_ + std::abs(scale.least * scale_.step) * largest_sum_ +
                        block.error * largest_length_ + block.length * largest_error_;
    if (!(size < 1e30 && block.unit > 1e-30)) {  // floats may overflow: then all may be within reach
        block.unit = 1, block.least = block.error = block.length = 0;
        std::fill(block.rest.begin(), block.rest.end(), std::numeric_limits<double>::infinity());
    }
    for (std::size_t i = 0; i < filter_block; ++i) {
        block.rest[i] += 0x1p-20 * size + 0x1p-36 * (std::abs(block.rest[i]) + sq_lengths[i]);
        limit(block, i, sq_lengths[i], max_sq_distance);
    }
}

}  // namespace ism::detail
