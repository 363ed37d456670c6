// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "toy/scene.hpp"

namespace toy {

/// @brief Two cars side by side in the picture, one well behind the other, so close that the wheels that face
/// each other are as far apart as those of a car between them (Zhang and Kjellström, Fig. 10), seen from
/// little above the table. Nothing else stands there.
/// @param instances  of the cars; two of them are taken
/// @throws ism::Error for less than two instances or a picture size that cannot be.
[[nodiscard]] ToyScene render_side_by_side(std::uint64_t scene_seed, const std::vector<int>& instances,
                                           const ToyOptions& options = {});

}  // namespace toy
