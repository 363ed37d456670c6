// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "toy/scene.hpp"

namespace toy {

/// @brief What stands on a cluttered table.
struct ClutterOptions {
    int least_toys = 4, most_toys = 7;
    int least_things = 11, most_things = 17;  ///< of no class
    int first_instance = 0,
        instances = 12;          ///< toys are instances first … first + instances − 1 of their class
    std::vector<int> cars = {};  ///< cars are these instances instead; none = as other toys
    double near_m = 0.62, far_m = 1.4;  ///< distances of toys from the camera
    double occluder_share = 0.4;        ///< of toys that get something small put before them
    double least_visible = 0.3;         ///< toys of which less is seen are taken off the table
    std::uint64_t frame = 0;  ///< of a sequence of the same table: from the second on (1, 2 …) the camera is
                              ///< a little elsewhere and the sensors' noise is another
    double shake_m = 0.003;  ///< standard deviation of the camera's place in these, along each axis
};

/// @brief A cluttered table with toys of all classes and other things, partly hiding each other; toys stand
/// near their best view, at distances that differ by a factor of up to 2. Every toy left on the table is
/// among the objects, wholly inside the picture and at least `least_visible` of it seen.
/// @throws ism::Error for a picture size or counts that cannot be.
[[nodiscard]] ToyScene render_cluttered(std::uint64_t scene_seed, const ClutterOptions& clutter = {},
                                        const ToyOptions& options = {});

}  // namespace toy
