// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/callable.hpp"
#include "ism/core/radius_search.hpp"
#include "ism/vote/bandwidth.hpp"
#include "ism/vote/vote.hpp"

namespace ism {

/// @brief Votes of one label in a k-d tree over all their axes: for spaces whose first three axes do not tell
/// votes apart, where VoteGrid visits too many. Otherwise slower than that; see VoteSearch.
template <std::size_t Dimension>
class VoteTree {
public:
    /// @brief Takes other votes, such as check() takes, with such a bandwidth.
    void assign(std::span<const Vote<Dimension>> votes, const Bandwidth<Dimension>& bandwidth) {
        votes_.assign(votes.begin(), votes.end());
        bandwidth_ = bandwidth;
        std::vector<std::array<double, Dimension>> points;
        for (const auto& vote : votes) points.push_back(in_bandwidths(vote.at));
        search_ = RadiusSearch<Dimension>(std::move(points));
    }

    [[nodiscard]] const Bandwidth<Dimension>& bandwidth() const { return bandwidth_; }
    [[nodiscard]] std::span<const Vote<Dimension>> votes() const { return votes_; }

    /// @brief Calls `visit(index, u²)`, by rising index, for each vote with u² ≤ reach² in the window around
    /// `at`.
    template <Callable<std::uint32_t, double> Visit>
    void each_within(const std::array<double, Dimension>& at, const std::array<double, Dimension>& window,
                     double reach, Visit&& visit) const {
        // the ball of the tree that holds the window, whose axes may have grown by different factors
        double widening = 0;
        for (std::size_t k = 0; k < Dimension; ++k)
            widening = std::max(widening, window[k] / bandwidth_.at_scale_1[k]);
        for (const std::uint32_t i :
             search_.within(in_bandwidths(at), reach * widening * (1 + 1e-9) + 1e-300)) {
            const double sq_u = sq_windows(votes_[i].at, at, window);
            if (sq_u <= reach * reach) visit(i, sq_u);
        }
    }

private:
    /// Finite also for absurd bandwidths.
    template <class T>
    [[nodiscard]] std::array<double, Dimension> in_bandwidths(const std::array<T, Dimension>& at) const {
        std::array<double, Dimension> point;
        for (std::size_t k = 0; k < Dimension; ++k)
            point[k] = std::clamp(double(at[k]) / bandwidth_.at_scale_1[k], -1e150, 1e150);
        return point;
    }

    std::vector<Vote<Dimension>> votes_;
    Bandwidth<Dimension> bandwidth_{};
    RadiusSearch<Dimension> search_;
};

}  // namespace ism
