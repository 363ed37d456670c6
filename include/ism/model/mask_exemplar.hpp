// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ism/config.hpp"

namespace ism {

/// @brief Cells a side of a box that is compared with exemplars, whatever its aspect, and with the ring
/// around it.
inline constexpr int exemplar_cells = 12, exemplar_side = exemplar_cells + 2;
/// @brief Numbers of a cell: 9 directions of gradients, without sign.
inline constexpr std::size_t exemplar_numbers = 9;
/// @brief Bytes of an exemplar: number k of cell (column, row), both counted with the ring, is byte
/// (k · side + row) · side + column.
inline constexpr std::size_t exemplar_bytes = exemplar_numbers * std::size_t(exemplar_side) * exemplar_side;

/// @brief A training object whose mask is lent to what looks like it, with what its box looks like.
struct MaskExemplar {
    std::uint32_t object = 0;              ///< index into ShapeModel::objects, which has the mask
    std::vector<std::uint8_t> cells = {};  ///< exemplar_bytes
    [[nodiscard]] bool operator==(const MaskExemplar&) const = default;
};

}  // namespace ism
