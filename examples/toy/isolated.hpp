// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "toy/scene.hpp"
#include "toy/toys.hpp"

namespace toy {

/// @brief From where one toy is looked at.
struct ToyView {
    double distance_m = 0.85;  ///< from the camera to the toy's middle
    double pitch_deg = 20;     ///< how steeply the camera looks down
    double turn_deg = 0;       ///< of the toy from its best view; to the right is positive
    std::uint64_t seed = 1;    ///< of table, light and noise
};

/// @brief A view to learn from: the toy alone, near the middle, on a nearly plain table.
/// @throws ism::Error for a class, instance, view or picture size that cannot be.
[[nodiscard]] ToyScene render_isolated(std::size_t class_index, int instance, const ToyView& view,
                                       const ToyOptions& options = {});

}  // namespace toy
