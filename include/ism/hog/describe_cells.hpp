// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include "ism/core/geometry.hpp"
#include "ism/core/vector.hpp"
#include "ism/hog/box_template.hpp"
#include "ism/hog/hog_pyramid.hpp"

namespace ism {

namespace detail {

/// The sums above the lower edge of a row of cells less those above its upper, at x.
inline void sums_between(const HogLevel& level, int x, int top, int bottom, HogSums& sums) {
    const float *upper = level.at(x, top), *lower = level.at(x, bottom);
    for (std::size_t part = 0; part < sums.size(); ++part) {
        EightFloats above;
        std::memcpy(&sums[part], lower + 8 * part, sizeof(above));
        std::memcpy(&above, upper + 8 * part, sizeof(above));
        sums[part] -= above;
    }
}

/// From the sums over a cell its mean gradients in parts of its whole area, its mean colours in parts of what
/// lies in the image. Returns the squared length of its unsigned directions.
[[nodiscard]] inline float take_means(HogSums& cell, float area, float inside) {
    const float by_area = 1 / area, by_inside = 1 / inside;
    constexpr float any = -1e9f;
    constexpr EightFloats least[] = {{}, {}, {0, 0, any, any, any, any, any, any}};
    cell[0] *= by_area, cell[1] *= by_area;
    cell[2] *= EightFloats{by_area, by_area, by_inside, by_inside, by_inside, 0, 0, 0};
    // rounding of the sums may leave a little less than nothing
    for (std::size_t part = 0; part < cell.size(); ++part)
        cell[part] = cell[part] > least[part] ? cell[part] : least[part];
    const EightFloats both = cell[0] + cell[1], squares = both * both;
    const float last = cell[2][0] + cell[2][1];
    return sum_of_lanes<float, 8>(squares) + last * last;
}

/// The means of a row of cells between the lines xs, from top to bottom in pixels of the level, and the
/// squared lengths of their directions.
inline void row_of_cells(const HogLevel& level, std::span<const int> xs, int top, int bottom, HogSums* cells,
                         float* energy) {
    const auto column = [&](int x) { return std::clamp(x, 0, level.width); };
    const float tall = float(std::max(1, bottom - top));
    top = std::clamp(top, 0, level.height), bottom = std::clamp(bottom, 0, level.height);
    HogSums left, right;
    sums_between(level, column(xs[0]), top, bottom, left);
    for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
        sums_between(level, column(xs[i + 1]), top, bottom, right);
        const float inside = float(column(xs[i + 1]) - column(xs[i])) * float(bottom - top);
        if (inside > 0) {
            for (std::size_t part = 0; part < left.size(); ++part) cells[i][part] = right[part] - left[part];
            energy[i] = take_means(cells[i], float(std::max(1, xs[i + 1] - xs[i])) * tall, inside);
        } else {
            cells[i] = {}, energy[i] = 0;
        }
        left = right;
    }
}

/// The numbers of a cell, by one over the lengths of the four blocks of 2 × 2 cells that it belongs to.
inline void normalise_cell(const HogSums& cell, const float (&norms)[4], float* out) {
    const EightFloats limit = EightFloats{} + 0.2f, unsigned_part = cell[0] + cell[1];
    const float last = cell[2][0], opposite = cell[2][1];
    const EightFloats ends = {last, opposite, last + opposite, 0, 0, 0, 0, 0};
    EightFloats sum_a{}, sum_b{}, sum_unsigned{}, sum_ends{};
    for (std::size_t t = 0; t < 4; ++t) {
        EightFloats a = cell[0] * norms[t], b = cell[1] * norms[t], u = unsigned_part * norms[t],
                    e = ends * norms[t];
        a = a < limit ? a : limit, b = b < limit ? b : limit;
        u = u < limit ? u : limit, e = e < limit ? e : limit;
        sum_a += a, sum_b += b, sum_unsigned += u, sum_ends += e;
        out[27 + t] = 0.2357f * (sum_of_lanes<float, 8>(a + b) + e[0] + e[1]);
    }
    sum_a *= 0.5f, sum_b *= 0.5f, sum_unsigned *= 0.5f, sum_ends *= 0.5f;
    std::memcpy(out, &sum_a, sizeof(sum_a));
    out[8] = sum_ends[0];
    std::memcpy(out + 9, &sum_b, sizeof(sum_b));
    out[17] = sum_ends[1];
    std::memcpy(out + 18, &sum_unsigned, sizeof(sum_unsigned));
    out[26] = sum_ends[2];
    out[31] = cell[2][2] - 0.5f, out[32] = cell[2][3], out[33] = cell[2][4];
}

}  // namespace detail

/// @brief Memory for one box after another.
struct CellScratch {
    std::vector<detail::HogSums> sums;
    std::vector<float> energy, norms, cells;
    std::vector<int> xs, ys;
};

/// @brief Describes the cells of a box, row after row.
/// @param out  grid.cells() · cell_numbers numbers
inline void describe_cells(const HogPyramid& pyramid, const Box& box, const BoxGrid& grid,
                           std::span<float> out, CellScratch& scratch) {
    const double cell_width = box.width / grid.columns, cell_height = box.height / grid.rows;
    const HogLevel& level = pyramid.level_for(std::sqrt(cell_width * cell_height));
    // the ring and one more cell around it, whose norms are needed
    const int margin = 1 + int(grid.ring), columns = grid.columns + 2 * margin, rows = grid.rows + 2 * margin;
    auto& [sums, energy, norms, unused, xs, ys] = scratch;
    const auto lines = [&](std::vector<int>& at, int count, double first, double cell, double step) {
        at.resize(std::size_t(count + 1));
        for (int i = 0; i <= count; ++i)
            at[std::size_t(i)] =
                int(std::lround(std::clamp((first + (i - margin) * cell) * step, -1e6, 1e6)));
    };
    lines(xs, columns, box.x, cell_width, double(level.width) / pyramid.width());
    lines(ys, rows, box.y, cell_height, double(level.height) / pyramid.height());
    sums.resize(std::size_t(columns * rows)), energy.resize(sums.size()), norms.resize(sums.size());
    for (int j = 0; j < rows; ++j)
        detail::row_of_cells(level, xs, ys[std::size_t(j)], ys[std::size_t(j + 1)], sums.data() + j * columns,
                             energy.data() + j * columns);
    for (int j = 0; j + 1 < rows; ++j)
        for (int i = 0; i + 1 < columns; ++i) {  // of the block that begins at this cell
            const float* first = energy.data() + j * columns + i;
            norms[std::size_t(j * columns + i)] =
                1 / std::sqrt(first[0] + first[1] + first[columns] + first[columns + 1] + 1e-4f);
        }
    float* to = out.data();
    for (int j = 1; j < rows - 1; ++j)
        for (int i = 1; i < columns - 1; ++i, to += cell_numbers) {
            const float* norm = norms.data() + j * columns + i;
            detail::normalise_cell(sums[std::size_t(j * columns + i)],
                                   {norm[-columns - 1], norm[-columns], norm[-1], norm[0]}, to);
        }
}

/// @brief The numbers of a cell as a mirror shows it: number k is number mirrored_number(k) of the mirrored
/// cell.
[[nodiscard]] constexpr std::size_t mirrored_number(std::size_t k) {
    if (k < 18) return (27 - k) % 18;
    if (k < 27) return 18 + (27 - k) % 9;
    if (k < 31) return 27 + ((k - 27) ^ 1);
    return k;
}

/// @brief The cells of a box as a mirror shows them.
[[nodiscard]] inline std::vector<float> mirrored_cells(std::span<const float> cells, const BoxGrid& grid) {
    std::vector<float> result(cells.size());
    const auto columns = std::size_t(grid.all_columns()), rows = std::size_t(grid.all_rows());
    for (std::size_t j = 0; j < rows; ++j)
        for (std::size_t i = 0; i < columns; ++i)
            for (std::size_t k = 0; k < cell_numbers; ++k)
                result[(j * columns + i) * cell_numbers + mirrored_number(k)] =
                    cells[(j * columns + columns - 1 - i) * cell_numbers + k];
    return result;
}

}  // namespace ism
