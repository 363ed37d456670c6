// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/vote/cast.hpp"
#include "ism/vote/kernel.hpp"

namespace ism {

/// @brief The size of the mean shift window along each axis.
template <std::size_t Dimension>
struct Bandwidth {
    std::array<double, Dimension> at_scale_1;
    std::array<Growth, Dimension> growth;

    /// @brief The window around an object of a scale.
    [[nodiscard]] std::array<double, Dimension> at(double scale) const {
        std::array<double, Dimension> window;
        for (std::size_t k = 0; k < Dimension; ++k)
            window[k] = at_scale_1[k] * (growth[k] == Growth::with_scale ? scale : 1);
        return window;
    }
};

/// @brief The default bandwidths of a vote space's axes.
template <AnyVoteSpace Space>
[[nodiscard]] constexpr Bandwidth<Space::dimension> default_bandwidth() {
    Bandwidth<Space::dimension> bandwidth{};
    for (std::size_t k = 0; k < Space::dimension; ++k) {
        bandwidth.at_scale_1[k] = Space::axes()[k].bandwidth;
        bandwidth.growth[k] = Space::axes()[k].growth;
    }
    return bandwidth;
}

/// @brief Does nothing where `bandwidth` can be used.
/// @throws Error where one is not a positive number.
template <std::size_t Dimension>
void check(const Bandwidth<Dimension>& bandwidth) {
    for (const double value : bandwidth.at_scale_1)
        expect(std::isfinite(value) && value > 0, "mean shift bandwidth", "a positive number", value);
}

/// @brief A place where votes gather.
template <std::size_t Dimension>
struct Mode {
    std::array<double, Dimension> at;
    double scale = 1;         ///< mean s_f / s_i of the votes in the window
    double score = 0;         ///< Σ weight · kernel over the votes in the window
    std::uint32_t label = 0;  ///< of its votes
};

/// @brief Votes of one label, ordered by cells over the first two axes, so that those in a window are found
/// without looking at all.
template <std::size_t Dimension>
class VoteGrid {
public:
    /// @brief Orders `votes`, which must stay where they are; a cell is as large as the window of a typical
    /// vote.
    VoteGrid(std::span<const Vote<Dimension>> votes, const Bandwidth<Dimension>& bandwidth) : votes_(votes) {
        if (votes.empty()) return;
        std::vector<float> scales(votes.size());
        for (std::size_t i = 0; i < votes.size(); ++i) scales[i] = votes[i].scale;
        std::nth_element(scales.begin(), scales.begin() + std::ptrdiff_t(scales.size() / 2), scales.end());
        const auto window = bandwidth.at(scales[scales.size() / 2]);
        const auto most = std::ceil(std::sqrt(2.0 * double(votes.size()))) + 1;  // cells along a side
        for (std::size_t k = 0; k < axes; ++k) {
            double low = votes[0].at[k], high = low;
            for (const auto& vote : votes) {
                low = std::min<double>(low, vote.at[k]);
                high = std::max<double>(high, vote.at[k]);
            }
            low_[k] = low;
            cell_[k] = std::max(window[k], (high - low) / most);
            cells_[k] = static_cast<std::size_t>((high - low) / cell_[k]) + 1;
        }
        const std::size_t count = axes == 1 ? cells_[0] : cells_[0] * cells_[axes - 1];
        std::vector<std::uint32_t> cell_of(votes.size());
        first_.assign(count + 1, 0);
        for (std::size_t i = 0; i < votes.size(); ++i) {
            std::size_t cell = cell_along(0, votes[i].at[0]);
            if constexpr (axes == 2) cell += cells_[0] * cell_along(1, votes[i].at[1]);
            cell_of[i] = static_cast<std::uint32_t>(cell);
            ++first_[cell + 1];
        }
        for (std::size_t c = 0; c < count; ++c) first_[c + 1] += first_[c];
        order_.resize(votes.size());
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for (std::uint32_t i = 0; i < votes.size(); ++i) order_[next[cell_of[i]]++] = i;
    }

    /// @brief Calls `visit(index, u²)` for each vote with u² ≤ reach² in the window around `at`.
    template <std::invocable<std::uint32_t, double> Visit>
    void each_within(const std::array<double, Dimension>& at, const std::array<double, Dimension>& window,
                     double reach, Visit&& visit) const {
        if (votes_.empty()) return;
        std::array<std::size_t, 2> from{0, 0}, to{0, 0};
        for (std::size_t k = 0; k < axes; ++k) {
            if (at[k] + reach * window[k] < low_[k]) return;
            from[k] = cell_along(k, at[k] - reach * window[k]);
            to[k] = cell_along(k, at[k] + reach * window[k]);
        }
        const double sq_reach = reach * reach;
        for (std::size_t row = from[1]; row <= to[1]; ++row)
            for (std::uint32_t i = first_[row * cells_[0] + from[0]]; i < first_[row * cells_[0] + to[0] + 1];
                 ++i) {
                const auto& vote = votes_[order_[i]];
                double sq_u = 0;
                for (std::size_t k = 0; k < Dimension; ++k) {
                    const double u = (vote.at[k] - at[k]) / window[k];
                    sq_u += u * u;
                }
                if (sq_u <= sq_reach) visit(order_[i], sq_u);
            }
    }

private:
    static constexpr std::size_t axes = Dimension < 2 ? 1 : 2;

    [[nodiscard]] std::size_t cell_along(std::size_t k, double value) const {
        const double cell = (value - low_[k]) / cell_[k];
        return cell <= 0 ? 0 : std::min(static_cast<std::size_t>(cell), cells_[k] - 1);
    }

    std::span<const Vote<Dimension>> votes_;
    std::array<double, 2> low_{}, cell_{1, 1};
    std::array<std::size_t, 2> cells_{1, 1};
    std::vector<std::uint32_t> first_, order_;
};

/// @brief How modes are searched.
struct MeanShiftOptions {
    std::size_t max_starts = 30;  ///< heaviest bins of a label from which a search starts
    double min_start = 0.05;      ///< a start's bin weighs at least this part of the label's heaviest
    int max_iterations = 50;
    double tolerance = 1e-3;  ///< a search ends where its step is shorter than this part of the window
};

namespace detail {

/// Where the votes of a label are heavy: means of the heaviest bins of about the window's size.
template <std::size_t Dimension>
[[nodiscard]] std::vector<Mode<Dimension>> heavy_bins(std::span<const Vote<Dimension>> votes,
                                                      const Bandwidth<Dimension>& bandwidth,
                                                      const MeanShiftOptions& options) {
    constexpr double level_ratio = 1.25;
    std::size_t slots = 16;
    while (slots < 2 * votes.size()) slots *= 2;
    constexpr std::uint32_t free_slot = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> bin_at(slots, free_slot);
    std::vector<std::uint64_t> keys;
    std::vector<Mode<Dimension>> bins;
    for (const auto& vote : votes) {
        const double level = std::floor(std::log(double(vote.scale)) / std::log(level_ratio));
        const auto window = bandwidth.at(std::pow(level_ratio, level + 0.5));
        std::uint64_t key = static_cast<std::uint64_t>(static_cast<std::int64_t>(level)) + 1;
        for (std::size_t k = 0; k < Dimension; ++k) {
            const double cell = std::clamp(std::floor(vote.at[k] / window[k]), -1e15, 1e15);
            key = (key ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(cell))) * 0x9e3779b97f4a7c15u;
            key ^= key >> 29;
        }
        std::size_t slot = key & (slots - 1);
        while (bin_at[slot] != free_slot && keys[bin_at[slot]] != key) slot = (slot + 1) & (slots - 1);
        if (bin_at[slot] == free_slot) {
            bin_at[slot] = static_cast<std::uint32_t>(bins.size());
            keys.push_back(key);
            bins.push_back({.at = {}, .scale = 0, .score = 0, .label = vote.label});
        }
        auto& bin = bins[bin_at[slot]];
        for (std::size_t k = 0; k < Dimension; ++k) bin.at[k] += double(vote.weight) * vote.at[k];
        bin.scale += double(vote.weight) * vote.scale;
        bin.score += vote.weight;
    }
    std::stable_sort(bins.begin(), bins.end(),
                     [](const auto& a, const auto& b) { return a.score > b.score; });
    const double least = bins.empty() ? 0 : options.min_start * bins.front().score;
    std::size_t count = 0;
    while (count < bins.size() && count < options.max_starts && bins[count].score > 0 &&
           bins[count].score >= least)
        ++count;
    bins.resize(count);
    for (auto& bin : bins) {
        for (double& value : bin.at) value /= bin.score;
        bin.scale /= bin.score;
    }
    return bins;
}

}  // namespace detail

/// @brief Follows the mean of the votes in the window from `start` until it rests. The window grows with the
/// mean scale of the votes in it.
template <Kernel K, std::size_t Dimension>
[[nodiscard]] Mode<Dimension> shift_to_mode(const VoteGrid<Dimension>& grid,
                                            std::span<const Vote<Dimension>> votes,
                                            const Bandwidth<Dimension>& bandwidth, Mode<Dimension> start,
                                            const MeanShiftOptions& options = {}) {
    Mode<Dimension> mode = start;
    for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
        const auto window = bandwidth.at(mode.scale);
        std::array<double, Dimension> sum{};
        double weight = 0, scale = 0;
        grid.each_within(mode.at, window, K::reach, [&](std::uint32_t i, double sq_u) {
            const double w = votes[i].weight * K::shift(sq_u);
            for (std::size_t k = 0; k < Dimension; ++k) sum[k] += w * votes[i].at[k];
            scale += w * votes[i].scale;
            weight += w;
        });
        if (!(weight > 0)) break;
        double sq_step = 0;
        for (std::size_t k = 0; k < Dimension; ++k) {
            const double next = sum[k] / weight, step = (next - mode.at[k]) / window[k];
            sq_step += step * step;
            mode.at[k] = next;
        }
        const double ratio = scale / weight / mode.scale - 1;
        mode.scale = scale / weight;
        if (sq_step + ratio * ratio < options.tolerance * options.tolerance) break;
    }
    mode.score = 0;
    grid.each_within(mode.at, bandwidth.at(mode.scale), K::reach,
                     [&](std::uint32_t i, double sq_u) { mode.score += votes[i].weight * K::profile(sq_u); });
    return mode;
}

/// @brief The modes of votes of one label, strongest first: mean shift from the heaviest bins; of modes less
/// than one window apart only the strongest stays.
/// @throws Error where a bandwidth is not a positive number.
template <Kernel K, std::size_t Dimension>
[[nodiscard]] std::vector<Mode<Dimension>> find_modes(const VoteGrid<Dimension>& grid,
                                                      std::span<const Vote<Dimension>> votes,
                                                      const Bandwidth<Dimension>& bandwidth,
                                                      const MeanShiftOptions& options = {}) {
    check(bandwidth);
    std::vector<Mode<Dimension>> modes;
    for (const auto& start : detail::heavy_bins(votes, bandwidth, options))
        modes.push_back(shift_to_mode<K>(grid, votes, bandwidth, start, options));
    std::stable_sort(modes.begin(), modes.end(),
                     [](const auto& a, const auto& b) { return a.score > b.score; });
    std::vector<Mode<Dimension>> apart;
    for (const auto& mode : modes) {
        const bool known = std::any_of(apart.begin(), apart.end(), [&](const auto& other) {
            const auto window = bandwidth.at(other.scale);
            double sq_u = 0;
            for (std::size_t k = 0; k < Dimension; ++k) {
                const double u = (mode.at[k] - other.at[k]) / window[k];
                sq_u += u * u;
            }
            return sq_u < 1;
        });
        if (!known && mode.score > 0) apart.push_back(mode);
    }
    return apart;
}

}  // namespace ism
