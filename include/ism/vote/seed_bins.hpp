// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "ism/core/lists.hpp"
#include "ism/core/order.hpp"
#include "ism/vote/bandwidth.hpp"
#include "ism/vote/mode.hpp"
#include "ism/vote/vote.hpp"

namespace ism {

/// @brief The seeds of mean shift: bins of about the window's size, one set of them for each step of scale,
/// as windows grow with it. Keeps its memory for the next votes.
template <std::size_t Dimension>
class SeedBins {
public:
    /// @brief The means of the heaviest bins, heaviest first; their score is the bin's weight.
    /// @param votes  of one label, such as check() takes
    /// @param min_relative_weight  lighter bins than this part of the heaviest are left out
    /// @param peaks_only  so are those beside a heavier one of the same step of scale
    [[nodiscard]] const std::vector<Mode<Dimension>>& find(std::span<const Vote<Dimension>> votes,
                                                           const Bandwidth<Dimension>& bandwidth,
                                                           std::size_t max_count, double min_relative_weight,
                                                           bool peaks_only = false) {
        bins_.clear(), cells_.clear(), seeds_.clear();
        if (votes.empty()) return seeds_;
        make_windows(votes, bandwidth);
        std::size_t slots = 16;
        while (slots < 2 * votes.size()) slots *= 2;
        bin_at_.assign(slots, none);
        for (const auto& vote : votes) {
            Mode<Dimension>& bin = bins_[bin_of(vote)];
            const double weight = vote.weight;
            for (std::size_t k = 0; k < Dimension; ++k) bin.at[k] += weight * vote.at[k];
            bin.scale += weight * vote.scale;
            bin.score += weight;
        }
        return heaviest(max_count, min_relative_weight, peaks_only);
    }

private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    /// A bin's place: its step of scale, and windows of that step along each axis.
    struct Cell {
        std::uint32_t level = 0;
        std::array<double, Dimension> at = {};
        std::uint64_t key = 0;  ///< stands for the cell: 64 bits are not the same by chance

        void make_key() {
            key = (std::uint64_t(level) + 1) * 0x9e3779b97f4a7c15u;
            for (const double part : at) {
                key = (key ^ std::bit_cast<std::uint64_t>(part + 0.0)) * 0x9e3779b97f4a7c15u;  // no -0
                key ^= key >> 29;
            }
        }
    };

    /// Steps of scale, four an octave: the exponent of a float and the first two digits behind it.
    [[nodiscard]] static std::uint32_t level_of(float scale) {
        return std::bit_cast<std::uint32_t>(scale) >> 21;
    }
    [[nodiscard]] static float middle_of(std::uint32_t level) {
        return std::bit_cast<float>((level << 21) + (1u << 20));
    }

    /// The windows of all levels there are: a few hundred at most.
    void make_windows(std::span<const Vote<Dimension>> votes, const Bandwidth<Dimension>& bandwidth) {
        float low = votes.front().scale, high = low;
        for (const auto& vote : votes) low = std::min(low, vote.scale), high = std::max(high, vote.scale);
        lowest_ = level_of(low);
        const std::uint32_t levels = level_of(high) - lowest_ + 1;
        detail::make_room(per_window_, levels);
        for (std::uint32_t i = 0; i < levels; ++i) {
            per_window_[i] = bandwidth.at(middle_of(lowest_ + i));
            for (double& value : per_window_[i]) value = std::min(1 / value, 1e200);
        }
    }

    /// Where the bin of a key stands in bin_at_, or would.
    [[nodiscard]] std::size_t slot_of(std::uint64_t key) const {
        const std::size_t mask = bin_at_.size() - 1;
        std::size_t slot = key & mask;
        while (bin_at_[slot] != none && cells_[bin_at_[slot]].key != key) slot = (slot + 1) & mask;
        return slot;
    }

    /// The number of a vote's bin, a new one if it is the first there.
    [[nodiscard]] std::uint32_t bin_of(const Vote<Dimension>& vote) {
        Cell cell{level_of(vote.scale)};
        const auto& per_window = per_window_[cell.level - lowest_];
        for (std::size_t k = 0; k < Dimension; ++k) cell.at[k] = std::floor(vote.at[k] * per_window[k]);
        cell.make_key();
        const std::size_t slot = slot_of(cell.key);
        if (bin_at_[slot] == none) {
            bin_at_[slot] = static_cast<std::uint32_t>(bins_.size());
            cells_.push_back(cell);
            const Mode<Dimension> empty{.at = {}, .scale = 0, .score = 0, .label = vote.label};
            bins_.push_back(empty);
        }
        return bin_at_[slot];
    }

    /// Whether none of the bins beside a bin, along any axes, is heavier.
    [[nodiscard]] bool is_peak(std::uint32_t bin) const {
        std::size_t neighbours = 1;  // and the bin itself
        for (std::size_t k = 0; k < Dimension; ++k) neighbours *= 3;
        for (std::size_t n = 0; n < neighbours; ++n) {
            Cell beside = cells_[bin];
            std::size_t steps = n;
            for (double& part : beside.at) part += double(steps % 3) - 1, steps /= 3;
            beside.make_key();
            const std::uint32_t other = bin_at_[slot_of(beside.key)];
            if (other != none && bins_[other].score > bins_[bin].score) return false;
        }
        return true;
    }

    [[nodiscard]] const std::vector<Mode<Dimension>>& heaviest(std::size_t max_count,
                                                               double min_relative_weight, bool peaks_only) {
        double most = 0;
        for (const Mode<Dimension>& bin : bins_) most = std::max(most, bin.score);
        detail::make_room(order_, bins_.size());
        std::size_t count = 0;
        for (std::uint32_t i = 0; i < bins_.size(); ++i) {
            const double score = bins_[i].score;
            if (score > 0 && score >= min_relative_weight * most && (!peaks_only || is_peak(i)))
                order_[count++] = {detail::falling(score), i};
        }
        detail::sort_ranked(order_.data(), count);
        for (std::size_t i = 0; i < std::min(max_count, count); ++i) {
            Mode<Dimension> bin = bins_[order_[i].index];
            for (double& value : bin.at) value /= bin.score;
            bin.scale /= bin.score;
            seeds_.push_back(bin);
        }
        return seeds_;
    }

    std::uint32_t lowest_ = 0;
    std::vector<std::array<double, Dimension>> per_window_;
    std::vector<std::uint32_t> bin_at_;
    std::vector<detail::Ranked> order_;
    std::vector<Cell> cells_;
    std::vector<Mode<Dimension>> bins_, seeds_;
};

}  // namespace ism
