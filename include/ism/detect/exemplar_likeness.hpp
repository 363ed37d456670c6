// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "ism/model/mask_exemplar.hpp"

/// How much the cells of two boxes (MaskExemplar::cells) are alike.
namespace ism::detail {

/// A number for each cell of a box and its ring.
using ExemplarSums = std::array<int, std::size_t(exemplar_side) * exemplar_side>;
using ExemplarCells = std::span<const std::uint8_t>;

[[nodiscard]] inline int exemplar_product(ExemplarCells a, ExemplarCells b) {
    int sum = 0;
    for (std::size_t i = 0; i < exemplar_bytes; ++i) sum += int(a[i]) * int(b[i]);
    return sum;
}

/// At each cell the product of a with what of b lies (dx, dy) cells beside; outside b there is nothing.
[[nodiscard]] inline ExemplarSums cell_products(ExemplarCells a, ExemplarCells b, int dx, int dy) {
    constexpr int n = exemplar_side;
    const int x0 = std::max(0, -dx), x1 = std::min(n, n - dx), y0 = std::max(0, -dy),
              y1 = std::min(n, n - dy);
    ExemplarSums sums{};
    for (int k = 0; k < int(exemplar_numbers); ++k)
        for (int y = y0; y < y1; ++y) {
            const std::uint8_t* p = a.data() + (k * n + y) * n;
            const std::uint8_t* q = b.data() + (k * n + y + dy) * n + dx;
            for (int x = x0; x < x1; ++x) sums[std::size_t(y * n + x)] += int(p[x]) * int(q[x]);
        }
    return sums;
}

/// The sums of 3 × 3 cells around each cell of the box; those of the ring are 0.
[[nodiscard]] inline ExemplarSums block_sums(const ExemplarSums& sums) {
    constexpr int n = exemplar_side;
    ExemplarSums across{}, block{};
    for (std::size_t i = 1; i + 1 < sums.size(); ++i) across[i] = sums[i - 1] + sums[i] + sums[i + 1];
    for (int y = 1; y < n - 1; ++y)
        for (int x = 1; x < n - 1; ++x) {
            const int* c = across.data() + y * n + x;
            block[std::size_t(y * n + x)] = c[-n] + c[0] + c[n];
        }
    return block;
}

/// What each_likeness() needs to know of a box alone.
struct ExemplarSquares {
    explicit ExemplarSquares(ExemplarCells cells) : of_cells(cell_products(cells, cells, 0, 0)) {}
    ExemplarSums of_cells;
    /// Of the 3 × 3 cells (dx, dy) beside each cell; outside the ring there is nothing.
    [[nodiscard]] ExemplarSums of_blocks(int dx, int dy) const {
        constexpr int n = exemplar_side;
        ExemplarSums beside{};
        for (int y = std::max(0, -dy); y < std::min(n, n - dy); ++y)
            for (int x = std::max(0, -dx); x < std::min(n, n - dx); ++x)
                beside[std::size_t(y * n + x)] = of_cells[std::size_t((y + dy) * n + x + dx)];
        return block_sums(beside);
    }
};

/// Calls back with (column, row, cosine) for each cell of a box: that of the 3 × 3 cells around it with those
/// of an exemplar that lie (dx, dy) cells beside.
template <class Tell>
void each_likeness(ExemplarCells box, const ExemplarSums& box_sq, ExemplarCells own,
                   const ExemplarSums& own_sq, int dx, int dy, const Tell& tell) {
    const ExemplarSums both = block_sums(cell_products(box, own, dx, dy));
    for (int row = 0; row < exemplar_cells; ++row)
        for (int column = 0; column < exemplar_cells; ++column) {
            const auto at = std::size_t((row + 1) * exemplar_side + column + 1);
            tell(column, row, float(both[at]) / std::sqrt(float(box_sq[at]) * float(own_sq[at]) + 1.0f));
        }
}

}  // namespace ism::detail
