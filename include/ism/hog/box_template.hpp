// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "ism/core/geometry.hpp"

namespace ism {

/// @brief How a box is divided: columns × rows cells, with a ring of one more around it or without.
struct BoxGrid {
    int columns = 0, rows = 0;
    bool ring = true;
    [[nodiscard]] int all_columns() const { return columns + 2 * int(ring); }
    [[nodiscard]] int all_rows() const { return rows + 2 * int(ring); }
    [[nodiscard]] std::size_t cells() const { return std::size_t(all_columns()) * std::size_t(all_rows()); }
    /// @brief Where cell i, counted row after row, lies in an image; the ring lies around the box.
    [[nodiscard]] Box cell(const Box& box, std::size_t i) const {
        const double width = box.width / columns, height = box.height / rows;
        const int column = int(i) % all_columns() - int(ring), row = int(i) / all_columns() - int(ring);
        return {box.x + column * width, box.y + row * height, width, height};
    }
    [[nodiscard]] bool operator==(const BoxGrid&) const = default;
};

/// @brief What each cell of a box adds to the score of a template, row after row as the image shows them, the
/// bias shared among them: above 0 a cell speaks for the class, and all together they are the score.
struct CellShares {
    BoxGrid grid = {};
    Box box = {};  ///< that it judged, pixels of the image
    std::vector<float> shares = {};
    [[nodiscard]] bool operator==(const CellShares&) const = default;
};

/// @brief Numbers of a cell: 18 directions, 9 without sign, 4 norms (Felzenszwalb et al. 2010), 3 of colour.
inline constexpr std::size_t cell_numbers = 34;

/// @brief What a class looks like: a linear template over the cells of a box, which may also show it
/// mirrored.
struct BoxTemplate {
    BoxGrid grid = {};
    float bias = 0;
    float log_aspect = 0, log_aspect_spread = 1;  ///< of width over height, in training
    std::vector<float> weights = {};
    [[nodiscard]] bool operator==(const BoxTemplate&) const = default;

    /// @brief What is taken from the score of a box for its aspect.
    [[nodiscard]] double aspect_penalty(const Box& box) const {
        const double d = (std::log(box.width / box.height) - log_aspect) / log_aspect_spread;
        return 0.05 * std::min(9.0, d * d);
    }
};

}  // namespace ism
