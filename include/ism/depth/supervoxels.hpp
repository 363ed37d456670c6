// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ism/core/image.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/depth/supervoxel.hpp"
#include "ism/depth/supervoxel_passes.hpp"
#include "ism/depth/surface.hpp"

namespace ism {

/// @brief Cuts a surface into small pieces that are near each other in position, normal and image: SLIC
/// (Achanta et al. 2012) with (Δpoint² + 8·Δalong the normal²) / size_m² + Δpixel² / (2·step_px²) +
/// normal_weight·(1 − cosine) as the distance, among centres within a step. A piece need not be connected.
/// @throws Error as check(const SupervoxelOptions&) does.
[[nodiscard]] inline Supervoxels supervoxels_of(const Surface& surface, const SupervoxelOptions& options,
                                                ThreadPool& pool) {
    check(options);
    constexpr int band = 32;  // rows; sums are added band by band, whichever thread made them
    const int height = surface.height();
    Supervoxels result{Image<std::int32_t>(surface.width(), height)};
    const detail::SurfaceRows rows(surface, pool);
    std::vector<detail::SupervoxelCentre> centres = detail::first_centres(surface, options.step_px);
    std::vector<std::vector<detail::SupervoxelCentre>> sums(std::size_t((height + band - 1) / band));
    for (int pass = 0; pass < options.passes; ++pass) {
        pool.for_each(sums.size(), [&](std::size_t b, unsigned) {
            const int top = int(b) * band, bottom = std::min(height, top + band);
            detail::label_rows(rows, centres, options, top, bottom, result.labels);
            sums[b].assign(centres.size(), {});
            detail::add_rows(surface, result.labels, top, bottom, sums[b]);
        });
        for (std::size_t i = 0; i < centres.size(); ++i) {
            detail::SupervoxelCentre sum;
            for (const auto& of_band : sums) sum += of_band[i];
            centres[i] = sum.mean();
        }
    }
    result.all = detail::number_anew(centres, result.labels);
    return result;
}

}  // namespace ism
