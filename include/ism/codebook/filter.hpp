// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/config.hpp"

namespace ism::detail {

/// Descriptors are matched in blocks, a whole number of tiles; a tile is a whole number of what each kernel
/// does at a time. Words are in groups, one bit of a mask each.
constexpr std::size_t filter_block = 96, filter_tile = 12, filter_group = 64;

[[nodiscard]] constexpr std::size_t filter_groups(std::size_t words) {
    return (words + filter_group - 1) / filter_group;
}

/// Tells which words may lie within reach of each query of a block, and misses none.
template <class F>
concept CandidateFilter = requires(const F& filter, typename F::Block& block, std::span<const float> rows,
                                   const std::vector<double>& sq_lengths, std::span<std::uint64_t> masks) {
    { filter.prepare(rows, sq_lengths, 1.0, block) } -> std::same_as<void>;
    { filter.limit(block, std::size_t(0), 1.0, 1.0) } -> std::same_as<void>;
    { filter.masks(block, std::size_t(0), masks) } -> std::same_as<void>;
};

}  // namespace ism::detail
