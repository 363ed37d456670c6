// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace ism {

/// @brief A place where votes gather.
template <std::size_t Dimension>
struct Mode {
    std::array<double, Dimension> at;
    double scale = 1;         ///< mean s_f / s_i of the votes in the window
    double score = 0;         ///< Σ weight · kernel over the votes in the window
    std::uint32_t label = 0;  ///< of its votes
};

}  // namespace ism
