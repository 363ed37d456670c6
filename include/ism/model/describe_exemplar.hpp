// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/box_region.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/hog/describe_cells.hpp"
#include "ism/model/mask_exemplar.hpp"

namespace ism {

/// @brief A box, and what it looks like.
struct ExemplarView {
    Box box;
    std::vector<std::uint8_t> cells = {};  ///< as MaskExemplar::cells
};

/// @brief What boxes look like that hardly differ from one, to be compared with exemplars: its surroundings
/// are brought to a size at which a cell is about 8 pixels, and the cells of each are described.
/// @param boxes  that reach beyond `box` by at most a twentieth of its sides
[[nodiscard]] inline std::vector<ExemplarView> describe_exemplar(ImageView<const Rgb> color, const Box& box,
                                                                 std::span<const Box> boxes) {
    const BoxRegion region(box, 0.25, color.width(),
                           color.height());  // what the norms of the ring's cells need
    const double zoom = 8 * exemplar_cells / std::sqrt(box.area());
    const auto side = [&](int px) { return int(std::clamp(std::lround(px * zoom), 16L, 2000L)); };
    const int width = side(region.width), height = side(region.height);
    const std::vector<float> numbers = region_colors(color, region, width, height);
    RgbImage patch(width, height);
    for (std::size_t i = 0; i < patch.pixels().size(); ++i)
        patch.pixels()[i] = {std::uint8_t(numbers[3 * i] + 0.5f), std::uint8_t(numbers[3 * i + 1] + 0.5f),
                             std::uint8_t(numbers[3 * i + 2] + 0.5f)};
    ThreadPool alone(1);
    const HogPyramid pyramid(patch, 0, alone);
    const BoxGrid grid{exemplar_cells, exemplar_cells, true};
    std::vector<float> cells(grid.cells() * cell_numbers);
    CellScratch scratch;
    const double sx = double(width) / region.width, sy = double(height) / region.height;
    std::vector<ExemplarView> views;
    for (const Box& own : boxes) {
        const Box there{(own.x - region.x) * sx, (own.y - region.y) * sy, own.width * sx, own.height * sy};
        describe_cells(pyramid, there, grid, cells, scratch);
        ExemplarView view{own, std::vector<std::uint8_t>(exemplar_bytes)};
        constexpr std::size_t first = hog_directions;  // those without sign follow those with
        for (std::size_t k = 0; k < exemplar_numbers; ++k)
            for (std::size_t i = 0; i < grid.cells(); ++i)
                view.cells[k * grid.cells() + i] =
                    std::uint8_t(std::clamp(510 * cells[i * cell_numbers + first + k], 0.0f, 255.0f));
        views.push_back(std::move(view));
    }
    return views;
}

/// @brief What a box looks like, as MaskExemplar::cells.
[[nodiscard]] inline std::vector<std::uint8_t> describe_exemplar(ImageView<const Rgb> color, const Box& box) {
    return std::move(describe_exemplar(color, box, std::span(&box, 1)).front().cells);
}

/// @brief The cells of an exemplar as a mirror shows it.
[[nodiscard]] inline std::vector<std::uint8_t> mirrored_exemplar(const std::vector<std::uint8_t>& cells) {
    std::vector<std::uint8_t> result(cells.size());
    constexpr std::size_t side = exemplar_side, first = hog_directions;
    for (std::size_t k = 0; k < exemplar_numbers; ++k)
        for (std::size_t row = 0; row < side; ++row)
            for (std::size_t column = 0; column < side; ++column)
                result[((mirrored_number(first + k) - first) * side + row) * side + column] =
                    cells[(k * side + row) * side + side - 1 - column];
    return result;
}

}  // namespace ism
