// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "ism/core/geometry.hpp"

namespace ism {

/// @brief The most that Placing::Side::offset may be, of either sign: a box that overlaps its mask's by an
/// IoU of .3 or more keeps an area, wherever its sides are placed.
inline constexpr double most_placing_offset = 0.14;

/// @brief Where an object of a class lies by the box that was judged and by that of the mask which was cut
/// out in it. Each side is placed by itself: legs that are hard to cut out say little of where an animal
/// ends, its back says much.
struct Placing {
    /// @brief Of one side, left, top, right or bottom.
    struct Side {
        double share = 0.9;  ///< how far it goes from the judged box to the mask's, 0 … 1
        double offset = 0;   ///< … and farther to the right or down, in parts of the judged box's side
        [[nodiscard]] bool operator==(const Side&) const = default;
    };
    std::array<Side, 4> sides = {};
    [[nodiscard]] bool operator==(const Placing&) const = default;

    /// @brief The box of the object; without area only where the two hardly overlap.
    [[nodiscard]] Box place(const Box& judged, const Box& mask) const {
        const auto placed = [](const Side& side, double from, double to, double length) {
            return from + side.share * (to - from) + side.offset * length;
        };
        const double left = placed(sides[0], judged.x, mask.x, judged.width),
                     top = placed(sides[1], judged.y, mask.y, judged.height),
                     right = placed(sides[2], judged.x + judged.width, mask.x + mask.width, judged.width),
                     bottom = placed(sides[3], judged.y + judged.height, mask.y + mask.height, judged.height);
        return {left, top, right - left, bottom - top};
    }
};

}  // namespace ism
