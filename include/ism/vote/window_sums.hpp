// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "ism/vote/kernel.hpp"
#include "ism/vote/vote_grid.hpp"
#include "ism/vote/vote_lanes.hpp"
#include "ism/vote/vote_search.hpp"

namespace ism {

namespace detail {

/// A kernel sees u² as a float, which may lie within its reach where the double does not.
template <Kernel K>
inline constexpr double rounded_reach = 1.000001 * K::reach;

template <Kernel K, std::size_t Dimension>
struct MeanSums {
    VoteLanes weight{}, scale{};
    std::array<VoteLanes, Dimension> at{};

    void add(std::size_t lane, const VoteColumns<Dimension>& votes, const FloatWindow<Dimension>& window,
             std::size_t i, float vote_weight) {
        std::array<float, Dimension> offset;
        float sq_u = 0;
#pragma GCC unroll 8
        for (std::size_t k = 0; k < Dimension; ++k) {
            offset[k] = votes.at[k][i] - window.centre[k];
            const float u = offset[k] * window.per_window[k];
            sq_u += u * u;
        }
        const float w = static_cast<float>(K::shift(sq_u)) * vote_weight;
        weight[lane] += w;
        scale[lane] += w * votes.scale[i];
#pragma GCC unroll 8
        for (std::size_t k = 0; k < Dimension; ++k) at[k][lane] += w * offset[k];
    }
};

template <Kernel K, std::size_t Dimension>
struct ScoreSum {
    VoteLanes score{};

    void add(std::size_t lane, const VoteColumns<Dimension>& votes, const FloatWindow<Dimension>& window,
             std::size_t i, float vote_weight) {
        float sq_u = 0;
#pragma GCC unroll 8
        for (std::size_t k = 0; k < Dimension; ++k) {
            const float u = (votes.at[k][i] - window.centre[k]) * window.per_window[k];
            sq_u += u * u;
        }
        score[lane] += static_cast<float>(K::profile(sq_u)) * vote_weight;
    }
};

/// The sums over a window.
template <class Sums, Kernel K, std::size_t Dimension>
[[nodiscard]] Sums sum_window(const VoteGrid<Dimension>& grid, const FloatWindow<Dimension>& place,
                              const std::array<double, Dimension>& window) {
    static_assert(vote_lane_count <= VoteGrid<Dimension>::padding);
    std::array<double, Dimension> at;
    std::copy(place.centre.begin(), place.centre.end(), at.begin());
    const VoteColumns<Dimension> votes(grid);
    Sums sums;
    grid.each_run(at, window, K::reach,
                  [&](std::size_t first, std::size_t last) { add_run(sums, votes, place, first, last); });
    return sums;
}

}  // namespace detail

/// @brief What a step of mean shift needs of a window.
template <std::size_t Dimension>
struct WindowMean {
    double weight = 0;                   ///< Σ weight · shift
    std::array<double, Dimension> at{};  ///< mean of the votes with these weights; undefined without weight
    double scale = 0;                    ///< mean of their scales
};

/// @brief The mean of the votes in the window around `at`, weighed by the kernel's `shift`. Sums are of
/// floats, relative to the centre: a mean is right to about a millionth of the window.
template <Kernel K, std::size_t Dimension>
[[nodiscard]] WindowMean<Dimension> window_mean(const VoteGrid<Dimension>& grid,
                                                const std::array<double, Dimension>& at,
                                                const std::array<double, Dimension>& window) {
    const detail::FloatWindow<Dimension> place(at, window);
    const auto sums = detail::sum_window<detail::MeanSums<K, Dimension>, K>(grid, place, window);
    WindowMean<Dimension> mean{.weight = sums.weight.template sum<double>()};
    mean.scale = sums.scale.template sum<double>() / mean.weight;
    for (std::size_t k = 0; k < Dimension; ++k)
        mean.at[k] = double(place.centre[k]) + sums.at[k].template sum<double>() / mean.weight;
    return mean;
}

/// @brief Σ weight · profile over the votes in the window around `at`.
template <Kernel K, std::size_t Dimension>
[[nodiscard]] double window_score(const VoteGrid<Dimension>& grid, const std::array<double, Dimension>& at,
                                  const std::array<double, Dimension>& window) {
    const detail::FloatWindow<Dimension> place(at, window);
    const auto sums = detail::sum_window<detail::ScoreSum<K, Dimension>, K>(grid, place, window);
    return sums.score.template sum<double>();
}

/// @brief The same of any search that has votes().
template <Kernel K, std::size_t Dimension, VoteSearch<Dimension> Search>
[[nodiscard]] WindowMean<Dimension> window_mean(const Search& search, const std::array<double, Dimension>& at,
                                                const std::array<double, Dimension>& window) {
    WindowMean<Dimension> mean;
    search.each_within(at, window, detail::rounded_reach<K>, [&](std::uint32_t i, double sq_u) {
        const Vote<Dimension>& vote = search.votes()[i];
        const double weight = double(K::shift(float(sq_u))) * vote.weight;
        mean.weight += weight;
        mean.scale += weight * vote.scale;
        for (std::size_t k = 0; k < Dimension; ++k) mean.at[k] += weight * vote.at[k];
    });
    mean.scale /= mean.weight;
    for (double& value : mean.at) value /= mean.weight;
    return mean;
}

/// @brief The same of any search that has votes().
template <Kernel K, std::size_t Dimension, VoteSearch<Dimension> Search>
[[nodiscard]] double window_score(const Search& search, const std::array<double, Dimension>& at,
                                  const std::array<double, Dimension>& window) {
    double score = 0;
    search.each_within(at, window, detail::rounded_reach<K>, [&](std::uint32_t i, double sq_u) {
        score += double(K::profile(float(sq_u))) * search.votes()[i].weight;
    });
    return score;
}

}  // namespace ism
