// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "ism/core/error.hpp"

namespace ism {

/// @brief One vote: a point of the vote space with its weight, and where it comes from.
template <std::size_t Dimension>
struct Vote {
    std::array<float, Dimension> at;
    float scale = 1;          ///< s_f / s_i, whether the space has such an axis or not
    float weight = 0;         ///< p(word | feature) · p(occurrence | word)
    std::uint32_t label = 0;  ///< of the discrete axis; 0 where there is none
    std::uint32_t feature = 0, word = 0, occurrence = 0;
};

/// @brief Larger coordinates, scales and weights of votes are refused: sums of them in float end.
inline constexpr float largest_in_vote = 1e12f;

/// @brief Whether mean shift can take `vote`.
template <std::size_t Dimension>
[[nodiscard]] bool is_usable(const Vote<Dimension>& vote) {
    bool usable = vote.scale >= 1 / largest_in_vote && vote.scale <= largest_in_vote && vote.weight >= 0 &&
                  vote.weight <= largest_in_vote;
    for (const float value : vote.at) usable = usable && std::abs(value) <= largest_in_vote;
    return usable;
}

/// @brief Validates `vote` for mean shift.
/// @throws Error for a coordinate or a weight that is no number or absurd, a weight below 0, a scale that is
/// not above 0.
template <std::size_t Dimension>
void check(const Vote<Dimension>& vote) {
    if (is_usable(vote)) return;
    for (const float value : vote.at)
        expect(std::abs(value) <= largest_in_vote, "coordinate of a vote", "-1e12 ... 1e12", value);
    expect(vote.scale >= 1 / largest_in_vote && vote.scale <= largest_in_vote, "scale of a vote",
           "1e-12 ... 1e12", vote.scale);
    expect(vote.weight >= 0 && vote.weight <= largest_in_vote, "weight of a vote", "0 ... 1e12", vote.weight);
}

}  // namespace ism
