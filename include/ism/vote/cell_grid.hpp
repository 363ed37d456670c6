// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "ism/config.hpp"
#include "ism/core/callable.hpp"

namespace ism {

/// @brief Boxes of equal size over a part of a space of three axes. Cells along the first axis have numbers
/// one after another, so what lies in a window lies in a few runs of numbers.
class CellGrid {
public:
    using Position = std::array<double, 3>;

    CellGrid() = default;

    /// @brief Cells from `low` to `high` of about the size `wanted`; larger where there would be more than
    /// `most` of them.
    CellGrid(const Position& low, const Position& high, const Position& wanted, std::size_t most)
        : low_(low) {
        for (std::size_t k = 0; k < 3; ++k)
            count_[k] = 1 + static_cast<std::size_t>(std::min((high[k] - low[k]) / wanted[k], double(most)));
        const auto cells = [&] { return double(count_[0]) * double(count_[1]) * double(count_[2]); };
        while (cells() > double(std::max<std::size_t>(1, most))) {
            std::size_t& largest = *std::max_element(count_.begin(), count_.end());
            largest = (largest + 1) / 2;
        }
        for (std::size_t k = 0; k < 3; ++k)
            per_unit_[k] = high[k] > low[k] ? double(count_[k]) / (high[k] - low[k]) : 0;
    }

    /// @brief Number of cells.
    [[nodiscard]] std::size_t size() const { return count_[0] * count_[1] * count_[2]; }

    /// @brief The cell of a place; the nearest for one outside.
    [[nodiscard]] std::size_t cell(const Position& at) const {
        return along(0, at[0]) + count_[0] * (along(1, at[1]) + count_[1] * along(2, at[2]));
    }

    /// @brief Calls `visit(first, last)` for runs of cells first … last − 1 that hold all of the window
    /// Σ ((v − at) / window)² ≤ reach²; no cell is in two runs.
    template <Callable<std::size_t, std::size_t> Visit>
    void each_run(const Position& at, const Position& window, double reach, Visit&& visit) const {
        // A little more than the window: cells and distances are rounded.
        const double sq_reach = 1.00001 * reach * reach, far = std::sqrt(sq_reach);
        Position place;
        std::array<std::size_t, 3> from, to;
        for (std::size_t k = 0; k < 3; ++k) {
            place[k] = (at[k] - low_[k]) * per_unit_[k];
            from[k] = along(k, at[k] - far * window[k]);
            to[k] = along(k, at[k] + far * window[k]);
        }
        for (std::size_t z = from[2]; z <= to[2]; ++z) {
            const double sq_z = sq_gap(2, place[2], z, window[2]);
            for (std::size_t y = from[1]; y <= to[1]; ++y) {
                const double sq_left = sq_reach - sq_z - sq_gap(1, place[1], y, window[1]);
                if (!(sq_left >= 0)) continue;
                const double half = std::sqrt(sq_left) * window[0];
                const std::size_t row = count_[0] * (y + count_[1] * z);
                visit(row + along(0, at[0] - half), row + along(0, at[0] + half) + 1);
            }
        }
    }

private:
    [[nodiscard]] std::size_t along(std::size_t k, double value) const {
        const double cell = (value - low_[k]) * per_unit_[k];
        if (!(cell >= 1)) return 0;
        return cell < double(count_[k]) ? static_cast<std::size_t>(cell) : count_[k] - 1;
    }

    /// Squared distance in windows from a place, given in cells, to a cell.
    [[nodiscard]] double sq_gap(std::size_t k, double place, std::size_t cell, double window) const {
        const double cells = std::max(place - double(cell + 1), double(cell) - place) - 1e-6;
        if (!(cells > 0)) return 0;
        const double gap = cells / (per_unit_[k] * window);
        return gap * gap;
    }

    Position low_{}, per_unit_{};
    std::array<std::size_t, 3> count_{1, 1, 1};
};

}  // namespace ism
