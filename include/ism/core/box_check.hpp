// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "ism/core/error.hpp"
#include "ism/core/geometry.hpp"

namespace ism {

/// @brief The shortest side of a labelled box, pixels.
inline constexpr double min_box_side_px = 0.1;

/// @brief How many times as long as the longer side of its image a side of a labelled box may be.
inline constexpr double max_box_side_in_images = 10;

/// @brief How many times as long as the shorter side of a labelled box the longer one may be.
inline constexpr double max_box_aspect = 1000;

/// @brief Validates the box of a labelled object in an image of `image_width` × `image_height` pixels:
/// finite, sides from min_box_side_px to max_box_side_in_images times the longer side of the image and of a
/// ratio up to max_box_aspect, and with some part of it in the image. A model normalises objects to one area,
/// so what is smaller or thinner would have sides of zero or of millions of pixels there.
/// @throws Error where it is not so.
inline void check_labelled_box(const Box& box, int image_width, int image_height) {
    expect(
        std::isfinite(box.x) && std::isfinite(box.y) && std::isfinite(box.width) && std::isfinite(box.height),
        "box", "finite numbers", lazy_text(box.x, ", ", box.y, ", ", box.width, ", ", box.height));
    const auto [shorter, longer] = std::minmax(box.width, box.height);
    const double longest = max_box_side_in_images * std::max(image_width, image_height);
    expect(shorter >= min_box_side_px && longer <= longest, "box",
           lazy_text("sides of ", min_box_side_px, " to ", longest, " pixels"),
           lazy_text(box.width, "x", box.height));
    expect(longer <= max_box_aspect * shorter, "box",
           lazy_text("one side at most ", max_box_aspect, " times the other"),
           lazy_text(box.width, "x", box.height));
    expect(box.x < image_width && box.y < image_height && box.x + box.width > 0 && box.y + box.height > 0,
           "box", lazy_text("a part in the image of ", image_width, "x", image_height),
           lazy_text(box.x, ", ", box.y, ", ", box.width, ", ", box.height));
}

}  // namespace ism
