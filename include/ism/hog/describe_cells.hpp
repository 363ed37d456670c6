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
#include "ism/core/processor.hpp"
#include "ism/core/vector.hpp"
#include "ism/hog/box_template.hpp"
#include "ism/hog/hog_pyramid.hpp"

namespace ism {

namespace detail {

/// The sums above the lower edge of a row of cells less those above its upper, at x.
inline void sums_between(const HogLevel& level, int x, int top, int bottom, HogSums& sums) {
    const float *upper = level.at(x, top), *lower = level.at(x, bottom);
#pragma GCC unroll 8
    for (std::size_t part = 0; part < sums.size(); ++part) {
        FourFloats above;
        std::memcpy(&sums[part], lower + 4 * part, sizeof(above));
        std::memcpy(&above, upper + 4 * part, sizeof(above));
        sums[part] -= above;
    }
}

/// From the sums over a cell its mean gradients in parts of its whole area, its mean colours in parts of what
/// lies in the image. Returns the squared length of its unsigned directions.
[[nodiscard]] inline float take_means(HogSums& cell, float area, float inside) {
    const float by_area = 1 / area, by_inside = 1 / inside;
#pragma GCC unroll 8
    for (std::size_t part = 0; part < 4; ++part) cell[part] *= by_area;
    cell[4] *= FourFloats{by_area, by_area, by_inside, by_inside};
    cell[5] *= by_inside;
    // rounding of the sums may leave a little less than nothing
    constexpr float any = -1e9f;
    const FourFloats least = {0, 0, any, any};
#pragma GCC unroll 8
    for (std::size_t part = 0; part < 4; ++part) cell[part] = cell[part] > 0 ? cell[part] : FourFloats{};
    cell[4] = cell[4] > least ? cell[4] : least;
    const FourFloats low = cell[0] + cell[2], high = cell[1] + cell[3], squares = low * low + high * high;
    const float last = cell[4][0] + cell[4][1];
    return sum_of_lanes<float, 4>(squares) + last * last;
}

/// Fetches the sums where the lines xs cross the line y from far memory, before they are needed.
inline void fetch_line(const HogLevel& level, std::span<const int> xs, int y) {
    y = std::clamp(y, 0, level.height);
    for (const int x : xs) {
        const float* sums = level.at(std::clamp(x, 0, level.width), y);
        __builtin_prefetch(sums), __builtin_prefetch(sums + hog_sums - 1);
    }
}

/// The means of a row of cells between the lines xs, from top to bottom in pixels of the level, and the
/// squared lengths of their directions.
/// @param at_lines  memory for as many as there are lines
inline void row_of_cells(const HogLevel& level, std::span<const int> xs, int top, int bottom,
                         HogSums* at_lines, HogSums* cells, float* energy) {
    const auto column = [&](int x) { return std::clamp(x, 0, level.width); };
    const float tall = float(std::max(1, bottom - top));
    top = std::clamp(top, 0, level.height), bottom = std::clamp(bottom, 0, level.height);
    // first all that comes from far memory, so that the processor waits for it at once
    for (std::size_t i = 0; i < xs.size(); ++i) sums_between(level, column(xs[i]), top, bottom, at_lines[i]);
    for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
        const float inside = float(column(xs[i + 1]) - column(xs[i])) * float(bottom - top);
        if (inside > 0) {
#pragma GCC unroll 8
            for (std::size_t part = 0; part < cells[i].size(); ++part)
                cells[i][part] = at_lines[i + 1][part] - at_lines[i][part];
            energy[i] = take_means(cells[i], float(std::max(1, xs[i + 1] - xs[i])) * tall, inside);
        } else {
            cells[i] = {}, energy[i] = 0;
        }
    }
}

/// The numbers of a cell, by one over the lengths of the four blocks of 2 × 2 cells that it belongs to.
ISM_DETAIL_INLINE void normalise_cell(const HogSums& cell, const float (&norms)[4], float* out) {
    FourFloats limit = FourFloats{} + 0.2f;
    forget<float, 4>(limit);
    const float last = cell[4][0], opposite = cell[4][1];
    // directions, their opposites, both together, and the ends of the three rows
    const FourFloats numbers[] = {cell[0],
                                  cell[1],
                                  cell[2],
                                  cell[3],
                                  cell[0] + cell[2],
                                  cell[1] + cell[3],
                                  {last, opposite, last + opposite, 0}};
    FourFloats sums[7]{};
    for (std::size_t t = 0; t < 4; ++t) {
        FourFloats n[7];
#pragma GCC unroll 8
        for (std::size_t part = 0; part < 7; ++part) {
            n[part] = numbers[part] * norms[t];
            n[part] = n[part] < limit ? n[part] : limit;
            sums[part] += n[part];
        }
        const FourFloats all = n[0] + n[2] + (n[1] + n[3]);
        out[27 + t] = 0.2357f * (sum_of_lanes<float, 4>(all) + n[6][0] + n[6][1]);
    }
    for (FourFloats& sum : sums) sum *= 0.5f;
    for (std::size_t row = 0; row < 3; ++row) {
        std::memcpy(out + 9 * row, &sums[2 * row], 2 * sizeof(FourFloats));
        out[9 * row + 8] = sums[6][row];
    }
    out[31] = cell[4][2] - 0.5f, out[32] = cell[4][3], out[33] = cell[5][0];
}

}  // namespace detail

/// @brief Memory for one box after another.
struct CellScratch {
    std::vector<detail::HogSums> sums, at_lines;
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
    auto& [sums, at_lines, energy, norms, unused, xs, ys] = scratch;
    const auto lines = [&](std::vector<int>& at, int count, double first, double cell, double step) {
        at.resize(std::size_t(count + 1));
        for (int i = 0; i <= count; ++i)
            at[std::size_t(i)] =
                int(std::lround(std::clamp((first + (i - margin) * cell) * step, -1e6, 1e6)));
    };
    lines(xs, columns, box.x, cell_width, double(level.width) / pyramid.width());
    lines(ys, rows, box.y, cell_height, double(level.height) / pyramid.height());
    sums.resize(std::size_t(columns * rows)), at_lines.resize(xs.size()), energy.resize(sums.size()),
        norms.resize(sums.size());
    for (int j = 0; j < rows; ++j) {
        if (j + 2 <= rows) detail::fetch_line(level, xs, ys[std::size_t(j + 2)]);  // that the next row needs
        detail::row_of_cells(level, xs, ys[std::size_t(j)], ys[std::size_t(j + 1)], at_lines.data(),
                             sums.data() + j * columns, energy.data() + j * columns);
    }
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
