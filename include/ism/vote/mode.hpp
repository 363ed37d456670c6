// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ism/config.hpp"

namespace ism {

/// @brief A place where votes gather.
template <std::size_t Dimension>
struct Mode {
    std::array<double, Dimension> at;
    double scale = 1;         ///< mean s_f / s_i of the votes in the window
    double score = 0;         ///< Σ weight · kernel over the votes in the window
    std::uint32_t label = 0;  ///< of its votes
};

/// @brief A vote in the window of a mode.
struct WindowVote {
    std::uint32_t index = 0;  ///< among the votes that were searched, those of one label
    double kernel = 0;        ///< the kernel's profile at the vote, above 0
    [[nodiscard]] bool operator==(const WindowVote&) const = default;
};

/// @brief A mode and what it stands on.
template <std::size_t Dimension>
struct SupportedMode : Mode<Dimension> {
    std::vector<WindowVote> support;  ///< by rising index
};

}  // namespace ism
