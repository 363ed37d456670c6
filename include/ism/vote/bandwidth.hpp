// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>

#include "ism/core/error.hpp"
#include "ism/vote/vote.hpp"
#include "ism/vote/vote_space.hpp"

namespace ism {

/// @brief The size of the mean shift window along each axis.
template <std::size_t Dimension>
struct Bandwidth {
    std::array<double, Dimension> at_scale_1;
    std::array<BandwidthScaling, Dimension> scaling;

    /// @brief The window around an object of a scale.
    [[nodiscard]] std::array<double, Dimension> at(double scale) const {
        std::array<double, Dimension> window;
        for (std::size_t k = 0; k < Dimension; ++k)
            window[k] = at_scale_1[k] * (scaling[k] == BandwidthScaling::with_scale ? scale : 1);
        return window;
    }
};

/// @brief The default bandwidths of a vote space's axes.
template <VoteSpaceType Space>
[[nodiscard]] constexpr Bandwidth<Space::dimension> default_bandwidth() {
    Bandwidth<Space::dimension> bandwidth{};
    for (std::size_t k = 0; k < Space::dimension; ++k) {
        bandwidth.at_scale_1[k] = Space::axes()[k].bandwidth;
        bandwidth.scaling[k] = Space::axes()[k].bandwidth_scaling;
    }
    return bandwidth;
}

/// @brief Validates `bandwidth`.
/// @throws Error where one is not a positive number.
template <std::size_t Dimension>
void check(const Bandwidth<Dimension>& bandwidth) {
    for (const double value : bandwidth.at_scale_1)
        expect(std::isfinite(value) && value > 0, "mean shift bandwidth", "a positive number", value);
}

/// @brief Validates the votes and the bandwidth of a mean shift.
/// @throws Error as the checks of each do.
template <std::size_t Dimension>
void check(std::span<const Vote<Dimension>> votes, const Bandwidth<Dimension>& bandwidth) {
    check(bandwidth);
    for (const auto& vote : votes) check(vote);
}

/// @brief Whether check() takes the votes and the bandwidth.
template <std::size_t Dimension>
[[nodiscard]] bool are_usable(std::span<const Vote<Dimension>> votes, const Bandwidth<Dimension>& bandwidth) {
    const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
    return std::all_of(bandwidth.at_scale_1.begin(), bandwidth.at_scale_1.end(), positive) &&
           std::all_of(votes.begin(), votes.end(), is_usable<Dimension>);
}

/// @brief Squared distance in windows: Σ ((a − b) / window)².
template <std::size_t Dimension, class A, class B>
requires std::convertible_to<A, double> && std::convertible_to<B, double>
[[nodiscard]] double sq_windows(const std::array<A, Dimension>& a, const std::array<B, Dimension>& b,
                                const std::array<double, Dimension>& window) {
    double sum = 0;
    for (std::size_t k = 0; k < Dimension; ++k) {
        const double u = (double(a[k]) - double(b[k])) / window[k];
        sum += u * u;
    }
    return sum;
}

}  // namespace ism
