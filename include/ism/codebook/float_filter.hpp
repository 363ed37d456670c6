// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "ism/codebook/exact_dot.hpp"
#include "ism/codebook/float_kernels.hpp"
#include "ism/core/aligned.hpp"

namespace ism::detail {

/// Finds candidates in float: a descriptor d may lie within T of a word of mean w and mean square length m
/// where d·w − m / 2 > (|d|² − T) / 2 − what rounding may hide.
class FloatFilter {
public:
    struct Block {
        std::span<const float> rows;  // as prepare() was given them
        std::array<float, filter_block> limits;
        std::array<double, filter_block> rounding;  // of each query
    };

    FloatFilter() = default;
    FloatFilter(std::span<const float> words, std::span<const float> mean_sq_length, std::size_t dimension,
                InstructionSet isa)
        : dimension_(dimension), kernel_(float_kernel(isa)) {
        const std::size_t count = mean_sq_length.size();
        panels_.make_room(filter_groups(count) * filter_group * dimension);
        bias_.assign(filter_groups(count) * filter_group, 0.0f);
        Dot<float>* const dot = exact_dot<float>(isa);
        double sq_length = 0;
        for (std::size_t w = 0; w < count; ++w) {
            const float* word = words.data() + w * dimension;
            float* panel = panels_.data() + w / 16 * 16 * dimension + w % 16;
            for (std::size_t k = 0; k < dimension; ++k) panel[k * 16] = word[k];
            bias_[w] = -mean_sq_length[w] / 2;
            sq_length = std::max(sq_length, dot(word, word, dimension));
            largest_bias_ = std::max(largest_bias_, std::abs(double(bias_[w])));
        }
        largest_length_ = std::sqrt(sq_length);
    }

    /// Makes a block of queries ready. @param rows padded to filter_block queries; have to stay
    void prepare(std::span<const float> rows, const std::vector<double>& sq_lengths, double max_sq_distance,
                 Block& block) const {
        block.rows = rows;
        for (std::size_t i = 0; i < filter_block; ++i) {
            const double size = largest_bias_ + std::sqrt(sq_lengths[i]) * largest_length_ + sq_lengths[i];
            block.rounding[i] = 2 * double(dimension_ + 8) * (0x1p-24 * size + 0x1p-126);
            limit(block, i, sq_lengths[i], max_sq_distance);
        }
    }

    /// Sets how far query i reaches. An infinite or NaN squared length reaches nothing.
    void limit(Block& block, std::size_t i, double sq_length, double max_sq_distance) const {
        const double least = (sq_length - max_sq_distance) / 2 - block.rounding[i];
        if (!(sq_length < std::numeric_limits<double>::infinity()))
            block.limits[i] = std::numeric_limits<float>::infinity();
        else if (std::sqrt(sq_length) * largest_length_ > 1e36 || std::abs(least) > 1e36)
            block.limits[i] = std::numeric_limits<float>::quiet_NaN();  // all may lie within
        else
            block.limits[i] = std::nextafter(static_cast<float>(least - std::abs(least) * 0x1p-22),
                                             -std::numeric_limits<float>::infinity());
    }

    void masks(Block& block, std::size_t group, std::span<std::uint64_t> masks) const {
        kernel_({block.rows.data(), masks.size(), dimension_, block.limits.data(),
                 panels_.data() + group * filter_group * dimension_, bias_.data() + group * filter_group,
                 masks.data()});
    }

private:
    std::size_t dimension_ = 0;
    AlignedVector<float> panels_;  // of 16 words, number after number
    std::vector<float> bias_;
    double largest_length_ = 0, largest_bias_ = 0;
    FilterFloats* kernel_ = nullptr;
};

}  // namespace ism::detail
