// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "toy_cars.hpp"

namespace reproduce {

/// A picture whose depth has noise added, normal, this many metres at 1 m and growing with the square of the
/// distance.
[[nodiscard]] Shot with_depth_noise(Shot shot, double noise_m, std::uint64_t seed);
/// … has holes of 5 px around places by chance, until this share of it is gone.
[[nodiscard]] Shot with_holes(Shot shot, double share, std::uint64_t seed);
/// … is moved to the right against the colours.
[[nodiscard]] Shot with_shifted_depth(Shot shot, int shift_px);
/// A picture that a camera turned around its optical axis would take; what leaves the picture is lost, and
/// with it objects of which more than half does.
[[nodiscard]] Shot turned_in_plane(const Shot& shot, double degrees);

}  // namespace reproduce
