// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
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

using EightFloats = Vector<float, 8>;
/// Directions 0 … 17, three colours, zeros.
using CellSums = std::array<EightFloats, hog_sums / 8>;

/// The mean gradients of a cell in parts of its whole area, its mean colours in parts of what lies in the
/// image, from (left, top) to (right, bottom) in pixels of the level. Returns the squared length of its
/// unsigned directions.
[[nodiscard]] inline float sum_cell(const HogLevel& level, int left, int top, int right, int bottom,
                                    CellSums& cell) {
    const float area = float(std::max(1, right - left)) * float(std::max(1, bottom - top));
    left = std::clamp(left, 0, level.width), right = std::clamp(right, 0, level.width);
    top = std::clamp(top, 0, level.height), bottom = std::clamp(bottom, 0, level.height);
    const float inside = float(right - left) * float(bottom - top);
    if (inside <= 0) {
        cell = {};
        return 0;
    }
    const float* corners[4] = {level.at(right, bottom), level.at(right, top), level.at(left, bottom),
                               level.at(left, top)};
    for (std::size_t part = 0; part < cell.size(); ++part) {
        EightFloats c[4];
        for (std::size_t k = 0; k < 4; ++k) std::memcpy(&c[k], corners[k] + 8 * part, sizeof(EightFloats));
        cell[part] = (c[0] - c[1]) - (c[2] - c[3]);
    }
    const float by_area = 1 / area, by_inside = 1 / inside;
    cell[0] *= by_area, cell[1] *= by_area;
    cell[2] *= EightFloats{by_area, by_area, by_inside, by_inside, by_inside, 0, 0, 0};
    float numbers[hog_directions];
    std::memcpy(numbers, &cell, sizeof(numbers));
    // rounding of the sums may leave a little less than nothing
    float sum = 0;
    for (std::size_t k = 0; k < hog_directions; ++k) numbers[k] = std::max(0.0f, numbers[k]);
    for (std::size_t k = 0; k < 9; ++k) sum += (numbers[k] + numbers[k + 9]) * (numbers[k] + numbers[k + 9]);
    std::memcpy(&cell, numbers, sizeof(numbers));
    return sum;
}

/// The numbers of a cell, by the lengths of the four blocks of 2 × 2 cells that it belongs to.
inline void normalise_cell(const CellSums& cell, const float* energy, int columns, float* out) {
    const auto norm = [&](int dx, int dy) {
        return 1 /
               std::sqrt(energy[0] + energy[dx] + energy[dy * columns] + energy[dy * columns + dx] + 1e-4f);
    };
    const float norms[4] = {norm(-1, -1), norm(1, -1), norm(-1, 1), norm(1, 1)};
    float numbers[hog_sums];
    std::memcpy(numbers, &cell, sizeof(numbers));
    EightFloats opposite;
    std::memcpy(&opposite, numbers + 9, sizeof(opposite));
    const EightFloats a = cell[0], b = cell[1], unsigned_a = a + opposite, limit = EightFloats{} + 0.2f;
    const float c0 = numbers[16], c1 = numbers[17], unsigned_c = numbers[8] + numbers[17];
    EightFloats sum_a{}, sum_b{}, sum_unsigned{};
    float sum_c0 = 0, sum_c1 = 0, sum_c = 0;
    for (std::size_t t = 0; t < 4; ++t) {
        EightFloats u = a * norms[t], v = b * norms[t], w = unsigned_a * norms[t];
        u = u < limit ? u : limit, v = v < limit ? v : limit, w = w < limit ? w : limit;
        const float x = std::min(0.2f, c0 * norms[t]), y = std::min(0.2f, c1 * norms[t]);
        sum_a += u, sum_b += v, sum_unsigned += w;
        sum_c0 += x, sum_c1 += y, sum_c += std::min(0.2f, unsigned_c * norms[t]);
        out[27 + t] = 0.2357f * (sum_of_lanes<float, 8>(u + v) + x + y);
    }
    sum_a *= 0.5f, sum_b *= 0.5f, sum_unsigned *= 0.5f;
    std::memcpy(out, &sum_a, sizeof(sum_a));
    std::memcpy(out + 8, &sum_b, sizeof(sum_b));
    out[16] = 0.5f * sum_c0, out[17] = 0.5f * sum_c1;
    std::memcpy(out + 18, &sum_unsigned, sizeof(sum_unsigned));
    out[26] = 0.5f * sum_c;
    out[31] = numbers[18] - 0.5f, out[32] = numbers[19], out[33] = numbers[20];
}

}  // namespace detail

/// @brief Memory for one box after another.
struct CellScratch {
    std::vector<detail::CellSums> sums;
    std::vector<float> energy, cells;
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
    auto& [sums, energy, unused, xs, ys] = scratch;
    const auto lines = [&](std::vector<int>& at, int count, double first, double cell, double step) {
        at.resize(std::size_t(count + 1));
        for (int i = 0; i <= count; ++i)
            at[std::size_t(i)] =
                int(std::lround(std::clamp((first + (i - margin) * cell) * step, -1e6, 1e6)));
    };
    lines(xs, columns, box.x, cell_width, double(level.width) / pyramid.width());
    lines(ys, rows, box.y, cell_height, double(level.height) / pyramid.height());
    sums.resize(std::size_t(columns * rows));
    energy.resize(std::size_t(columns * rows));
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const auto at = std::size_t(j * columns + i);
            energy[at] = detail::sum_cell(level, xs[std::size_t(i)], ys[std::size_t(j)],
                                          xs[std::size_t(i + 1)], ys[std::size_t(j + 1)], sums[at]);
        }
    float* to = out.data();
    for (int j = 1; j < rows - 1; ++j)
        for (int i = 1; i < columns - 1; ++i, to += cell_numbers)
            detail::normalise_cell(sums[std::size_t(j * columns + i)], energy.data() + j * columns + i,
                                   columns, to);
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
