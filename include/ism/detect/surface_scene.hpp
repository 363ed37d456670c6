// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/shared.hpp"
#include "ism/depth/local_frame.hpp"
#include "ism/depth/surface.hpp"
#include "ism/detect/scene.hpp"
#include "ism/feature/feature.hpp"

namespace ism {

/// @brief The local frame of each feature; none where the surface has none.
[[nodiscard]] inline std::vector<std::optional<LocalFrame>> local_frames(const Surface& surface,
                                                                         std::span<const Feature> features) {
    std::vector<std::optional<LocalFrame>> frames;
    for (const Feature& f : features) frames.push_back(local_frame(surface, f.x, f.y, f.angle));
    return frames;
}

/// @throws Error where the frame has no depth or no camera.
inline void add_surface(Scene& scene) {
    if (scene.surface) return;
    expect(!scene.frame.depth_m.empty(), "depth image", "one, since the vote space uses depth", "none");
    expect(scene.frame.camera.has_value(), "camera", "one, since the vote space is in metres", "none");
    scene.surface =
        Shared<const Surface>::make(surface_of(scene.frame.depth_m, *scene.frame.camera, scene.pool));
    scene.frames = local_frames(*scene.surface, scene.features);
}

}  // namespace ism
