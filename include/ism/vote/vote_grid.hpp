// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/core/aligned.hpp"
#include "ism/core/callable.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/order.hpp"
#include "ism/vote/bandwidth.hpp"
#include "ism/vote/cell_grid.hpp"
#include "ism/vote/vote.hpp"

namespace ism {

/// @brief Votes of one label, ordered by cells over their first three axes and kept by columns: what a window
/// can hold lies in a few runs of numbers, of which a vector unit takes many at once.
template <std::size_t Dimension>
class VoteGrid {
public:
    /// @brief Numbers that may be read behind the last of a column.
    static constexpr std::size_t padding = 16;

    VoteGrid() = default;
    /// @throws Error for a bandwidth that is not a positive number, or a vote that check() refuses.
    VoteGrid(std::span<const Vote<Dimension>> votes, const Bandwidth<Dimension>& bandwidth) {
        check(votes, bandwidth);
        assign(votes, bandwidth);
    }

    /// @brief Takes other votes instead, in the memory at hand: such as check() takes, with such a bandwidth.
    void assign(std::span<const Vote<Dimension>> votes, const Bandwidth<Dimension>& bandwidth) {
        assert(are_usable(votes, bandwidth));
        bandwidth_ = bandwidth;
        size_ = votes.size();
        stride_ = size_ + padding;
        columns_.make_room((Dimension + 2) * stride_);
        detail::make_room(order_, size_);
        choose_cells(votes);
        detail::make_room(cell_of_, size_);
        first_.assign(cells_.size() + 2, 0);
        for (std::size_t i = 0; i < size_; ++i) {
            cell_of_[i] = static_cast<std::uint32_t>(cells_.cell(first_axes(votes[i].at)));
            ++first_[cell_of_[i] + 2];
        }
        for (std::size_t c = 2; c < first_.size(); ++c) first_[c] += first_[c - 1];
        for (std::uint32_t i = 0; i < size_; ++i) order_[first_[cell_of_[i] + 1]++] = i;
        for (std::size_t i = 0; i < size_; ++i) put(votes[order_[i]], i);
        for (std::size_t column = 0; column < Dimension + 2; ++column)
            std::fill_n(columns_.data() + column * stride_ + size_, padding, 0.0f);
    }

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] const Bandwidth<Dimension>& bandwidth() const { return bandwidth_; }

    /// @brief Coordinates along axis k in the order of the grid, and `padding` zeros.
    [[nodiscard]] const float* axis(std::size_t k) const { return columns_.data() + k * stride_; }
    /// @brief The votes' scales in the same order, and zeros.
    [[nodiscard]] const float* scales() const { return axis(Dimension); }
    /// @brief The votes' weights in the same order, and zeros.
    [[nodiscard]] const float* weights() const { return axis(Dimension + 1); }

    /// @brief Calls `visit(first, last)` for runs of numbers in the order of the grid that hold all votes of
    /// the window around `at`, and others.
    template <Callable<std::size_t, std::size_t> Visit>
    void each_run(const std::array<double, Dimension>& at, const std::array<double, Dimension>& window,
                  double reach, Visit&& visit) const {
        cells_.each_run(first_axes(at), first_axes(window, 1), reach, [&](std::size_t from, std::size_t to) {
            if (first_[from] < first_[to]) visit(first_[from], first_[to]);
        });
    }

    /// @brief Calls `visit(index, u²)` for each vote with u² ≤ reach² in the window around `at`.
    template <Callable<std::uint32_t, double> Visit>
    void each_within(const std::array<double, Dimension>& at, const std::array<double, Dimension>& window,
                     double reach, Visit&& visit) const {
        each_run(at, window, reach, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                std::array<float, Dimension> vote;
                for (std::size_t k = 0; k < Dimension; ++k) vote[k] = axis(k)[i];
                const double sq_u = sq_windows(vote, at, window);
                if (sq_u <= reach * reach) visit(order_[i], sq_u);
            }
        });
    }

private:
    template <class T>
    [[nodiscard]] static CellGrid::Position first_axes(const std::array<T, Dimension>& values,
                                                       double otherwise = 0) {
        CellGrid::Position part{otherwise, otherwise, otherwise};
        for (std::size_t k = 0; k < std::min<std::size_t>(3, Dimension); ++k) part[k] = values[k];
        return part;
    }

    /// Cells are a part of the window of a typical vote: short along rows, which costs nothing, less so
    /// across, since each row of a window is a loop of its own.
    void choose_cells(std::span<const Vote<Dimension>> votes) {
        constexpr std::size_t few = 500;  // not worth ordering
        cells_ = {};
        if (size_ <= few) return;
        auto low = votes[0].at, high = low;
        scales_.resize(size_);
        for (std::size_t i = 0; i < size_; ++i) {
            scales_[i] = votes[i].scale;
            for (std::size_t k = 0; k < Dimension; ++k) {
                low[k] = std::min(low[k], votes[i].at[k]);
                high[k] = std::max(high[k], votes[i].at[k]);
            }
        }
        auto wanted = first_axes(bandwidth_.at(detail::nth_smallest(scales_, size_ / 2)), 1);
        for (std::size_t k = 0; k < 3; ++k) wanted[k] *= k == 0 ? 0.25 : 0.5;
        cells_ = CellGrid(first_axes(low), first_axes(high), wanted, 2 * size_);
    }

    void put(const Vote<Dimension>& vote, std::size_t place) {
        float* column = columns_.data() + place;
        for (const float value : vote.at) *column = value, column += stride_;
        *column = vote.scale;
        column[stride_] = vote.weight;
    }

    Bandwidth<Dimension> bandwidth_{};
    CellGrid cells_;
    std::size_t size_ = 0, stride_ = 0;
    AlignedVector<float> columns_;
    std::vector<std::uint32_t> first_{0, 0}, order_, cell_of_;
    std::vector<float> scales_;
};

}  // namespace ism
