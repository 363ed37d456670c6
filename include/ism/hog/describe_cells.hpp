// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
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
    const std::uint16_t *upper = level.at(x, top), *lower = level.at(x, bottom);
#pragma GCC unroll 8
    for (std::size_t part = 0; part < sums.size(); ++part) {
        EightShorts above;
        std::memcpy(&sums[part], lower + 8 * part, sizeof(above));
        std::memcpy(&above, upper + 8 * part, sizeof(above));
        sums[part] -= above;
    }
}

/// The same numbers as floats: gradients, which are never below 0, and colours.
inline void to_floats(const HogSums& sums, HogMeans& floats) {
#pragma GCC unroll 8
    for (std::size_t part = 0; part < sums.size(); ++part) {
        Vector<std::int32_t, 4> pairs;
        std::memcpy(&pairs, &sums[part], sizeof(pairs));
        const Vector<std::int32_t, 4> even = pairs & 0xffff, odd = pairs >> 16;
        floats[2 * part] = __builtin_convertvector(even, FourFloats);
        floats[2 * part + 1] =
            __builtin_convertvector(2 * part + 1 == color_part ? odd : odd & 0xffff, FourFloats);
    }
}

/// The sums over a rectangle of any size: of parts of most_exact_pixels.
[[gnu::noinline]] inline void sum_by_parts(const HogLevel& level, int left, int top, int right, int bottom,
                                           HogMeans& sums) {
    constexpr int wide = 16, tall = most_exact_pixels / wide;
    sums = {};
    for (int y = top; y < bottom; y += tall)
        for (int x = left; x < right; x += wide) {
            HogSums before, part;
            sums_between(level, x, y, std::min(y + tall, bottom), before);
            sums_between(level, std::min(x + wide, right), y, std::min(y + tall, bottom), part);
            for (std::size_t k = 0; k < part.size(); ++k) part[k] -= before[k];
            HogMeans numbers;
            to_floats(part, numbers);
            for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += numbers[k];
        }
}

/// From the sums over a cell its mean gradients in parts of its whole area, its mean colours in parts of what
/// lies in the image. Returns the squared length of its unsigned directions.
[[nodiscard]] inline float take_means(HogMeans& cell, float area, float inside) {
    const float by_area = 1 / (area * gradient_unit), by_inside = 1 / (inside * color_unit);
#pragma GCC unroll 8
    for (std::size_t part = 0; part < color_part; ++part) cell[part] *= by_area;
    cell[color_part] *= by_inside;
    const FourFloats low = cell[0] + cell[2], high = cell[1] + cell[3], squares = low * low + high * high;
    const float last = cell[4][0] + cell[4][1];
    return sum_of_lanes<float, 4>(squares) + last * last;
}

/// Fetches the sums where the lines xs cross the line y from far memory, before they are needed.
inline void fetch_line(const HogLevel& level, std::span<const int> xs, int y) {
    y = std::clamp(y, 0, level.height);
    for (const int x : xs) {
        const std::uint16_t* sums = level.at(std::clamp(x, 0, level.width), y);
        __builtin_prefetch(sums), __builtin_prefetch(sums + hog_sums - 1);
    }
}

/// The means of a row of cells between the lines xs, from top to bottom in pixels of the level, and the
/// squared lengths of their directions.
/// @param at_lines  memory for as many as there are lines
inline void row_of_cells(const HogLevel& level, std::span<const int> xs, int top, int bottom,
                         HogSums* at_lines, HogMeans* cells, float* energy) {
    const auto column = [&](int x) { return std::clamp(x, 0, level.width); };
    const float tall = float(std::max(1, bottom - top));
    top = std::clamp(top, 0, level.height), bottom = std::clamp(bottom, 0, level.height);
    // first all that comes from far memory, so that the processor waits for it at once
    for (std::size_t i = 0; i < xs.size(); ++i) sums_between(level, column(xs[i]), top, bottom, at_lines[i]);
    for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
        const int left = column(xs[i]), right = column(xs[i + 1]);
        const float inside = float(right - left) * float(bottom - top);
        if (!(inside > 0)) {
            cells[i] = {}, energy[i] = 0;
            continue;
        }
        if (inside <= float(most_exact_pixels)) {
            HogSums sums;
#pragma GCC unroll 8
            for (std::size_t part = 0; part < sums.size(); ++part)
                sums[part] = at_lines[i + 1][part] - at_lines[i][part];
            to_floats(sums, cells[i]);
        } else {
            sum_by_parts(level, left, top, right, bottom, cells[i]);
        }
        energy[i] = take_means(cells[i], float(std::max(1, xs[i + 1] - xs[i])) * tall, inside);
    }
}

/// The numbers of a cell, by one over the lengths of the four blocks of 2 × 2 cells that it belongs to.
ISM_DETAIL_INLINE void normalise_cell(const HogMeans& cell, const float (&norms)[4], float* out) {
    // vectors for eight numbers, and where those for both ways of directions and for the ends of rows begin
    constexpr std::size_t lanes = std::min<std::size_t>(native_lanes, 8), eight = 8 / lanes, both = 2 * eight,
                          ends = 3 * eight;
    using Floats = Vector<float, lanes>;
    Floats limit = Floats{} + 0.2f;
    forget<float, lanes>(limit);
    // directions, their opposites, both together, and the ends of the three rows
    Floats numbers[ends + 1], sums[ends + 1]{};
    for (std::size_t k = 0; k < both; ++k) std::memcpy(&numbers[k], &cell[k * lanes / 4], sizeof(Floats));
    for (std::size_t k = 0; k < eight; ++k) numbers[both + k] = numbers[k] + numbers[eight + k];
    const float last = cell[4][0], opposite = cell[4][1];
    numbers[ends] = Floats{last, opposite, last + opposite};
    for (std::size_t t = 0; t < 4; ++t) {
        Floats n[ends + 1];
#pragma GCC unroll 8
        for (std::size_t part = 0; part <= ends; ++part) {
            n[part] = numbers[part] * norms[t];
            n[part] = n[part] < limit ? n[part] : limit;
            sums[part] += n[part];
        }
        Floats all = n[0] + n[eight];
        if constexpr (eight == 2) all += n[1] + n[3];
        out[27 + t] = 0.2357f * (sum_of_lanes<float, lanes>(all) + n[ends][0] + n[ends][1]);
    }
    for (Floats& sum : sums) sum *= 0.5f;
    for (std::size_t row = 0; row < 3; ++row) {
        std::memcpy(out + 9 * row, &sums[row * eight], 8 * sizeof(float));
        out[9 * row + 8] = sums[ends][row];
    }
    out[31] = cell[5][0] - 0.5f, out[32] = cell[5][1], out[33] = cell[5][2];
}

}  // namespace detail

/// @brief Memory for one box after another.
struct CellScratch {
    std::vector<detail::HogSums> at_lines;
    std::vector<detail::HogMeans> means;
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
    auto& [at_lines, means, energy, norms, unused, xs, ys] = scratch;
    const auto lines = [&](std::vector<int>& at, int count, double first, double cell, double step) {
        at.resize(std::size_t(count + 1));
        for (int i = 0; i <= count; ++i)
            at[std::size_t(i)] =
                int(std::lround(std::clamp((first + (i - margin) * cell) * step, -1e6, 1e6)));
    };
    lines(xs, columns, box.x, cell_width, double(level.width) / pyramid.width());
    lines(ys, rows, box.y, cell_height, double(level.height) / pyramid.height());
    means.resize(std::size_t(columns * rows)), at_lines.resize(xs.size()), energy.resize(means.size()),
        norms.resize(means.size());
    for (int j = 0; j < rows; ++j) {
        if (j + 2 <= rows) detail::fetch_line(level, xs, ys[std::size_t(j + 2)]);  // that the next row needs
        detail::row_of_cells(level, xs, ys[std::size_t(j)], ys[std::size_t(j + 1)], at_lines.data(),
                             means.data() + j * columns, energy.data() + j * columns);
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
            detail::normalise_cell(means[std::size_t(j * columns + i)],
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
