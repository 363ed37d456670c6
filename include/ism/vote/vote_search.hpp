// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "ism/vote/bandwidth.hpp"
#include "ism/vote/vote.hpp"

namespace ism {

/// @brief How mean shift finds the votes in a window: VoteGrid, VoteTree or one of your own. It has
/// - `assign(votes, bandwidth)`, which takes the votes of a label, such as check() takes;
/// - `bandwidth()`, what was given there;
/// - `each_within(at, window, reach, visit)`, which calls `visit(index, u²)`, in any order, for each vote
///   with u² = Σ ((v − at) / window)² ≤ reach²;
/// - `votes()`, of which window_mean() and window_score() then take their sums, or faster ones of its own,
///   as VoteGrid.
template <class S, std::size_t Dimension>
concept VoteSearch = std::default_initializable<S> &&
    requires(S& search, const S& filled, std::span<const Vote<Dimension>> votes,
             const Bandwidth<Dimension>& bandwidth, const std::array<double, Dimension>& at,
             void (*visit)(std::uint32_t, double)) {
    search.assign(votes, bandwidth);
    { filled.bandwidth() } -> std::convertible_to<Bandwidth<Dimension>>;
    filled.each_within(at, at, 1.0, visit);
};

}  // namespace ism
