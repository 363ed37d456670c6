// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>

#include "ism/core/camera.hpp"
#include "ism/core/image.hpp"

namespace ism {

/// @brief What one shot of a camera gives: brightness, and where there is a depth sensor its registered
/// depth in metres (empty = none) and the camera.
struct Frame {
    GrayImage gray;
    DepthMap depth_m = {};
    std::optional<Camera> camera = {};
};

/// @brief Does nothing where `frame` can be used.
/// @throws Error where the image is smaller than 16×16, the depth is of another size or without a single
/// reading, or the camera is not one.
inline void check(const Frame& frame) {
    expect(frame.gray.width() >= 16 && frame.gray.height() >= 16, "image size", "at least 16x16",
           size_text(frame.gray));
    for (const float value : frame.gray.pixels())
        expect(std::isfinite(value), "image brightness", "finite values", value);
    if (!frame.depth_m.empty()) {
        expect(frame.depth_m.width() == frame.gray.width() && frame.depth_m.height() == frame.gray.height(),
               "depth image size", size_text(frame.gray), size_text(frame.depth_m));
        bool any = false;
        for (const float value : frame.depth_m.pixels()) any = any || is_depth(value);
        expect(any, "depth image", "at least one reading above 0", "none");
    }
    if (frame.camera) check(*frame.camera);
}

}  // namespace ism
