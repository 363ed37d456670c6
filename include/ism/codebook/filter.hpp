// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace ism::detail {

/// Descriptors are matched in blocks, a whole number of tiles; a tile is a whole number of what each kernel
/// does at a time. Words are in groups, one bit of a mask each.
constexpr std::size_t filter_block = 96, filter_tile = 12, filter_group = 64;

[[nodiscard]] constexpr std::size_t filter_groups(std::size_t words) {
    return (words + filter_group - 1) / filter_group;
}

}  // namespace ism::detail
