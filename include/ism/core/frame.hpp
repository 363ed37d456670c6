// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "ism/core/camera.hpp"
#include "ism/core/image.hpp"

namespace ism {

/// @brief One image of a camera: brightness and, optionally, colour, registered depth in metres (both of the
/// size of `gray`; empty = none) and the camera itself.
struct Frame {
    GrayImage gray;
    RgbImage color = {};
    DepthMap depth_m = {};
    std::optional<Camera> camera = {};
};

/// @brief Whether any pixel of a depth image has a reading.
[[nodiscard]] inline bool has_reading(const DepthMap& depth_m) {
    for (const float value : depth_m.pixels())
        if (is_depth(value)) return true;
    return false;
}

/// @brief Validates the sizes of `frame`, that its depth has readings, and its camera. The brightness itself
/// is validated where features are extracted.
/// @throws Error where the image is smaller than 16×16, colour or depth is of another size, the depth is
/// without a single reading, or the camera is not one.
inline void check(const Frame& frame) {
    const auto has_size_of_gray = [&](const auto& image) {
        return image.width() == frame.gray.width() && image.height() == frame.gray.height();
    };
    expect(frame.gray.width() >= 16 && frame.gray.height() >= 16, "image size", "at least 16x16",
           size_text(frame.gray));
    expect(frame.color.empty() || has_size_of_gray(frame.color), "color image size", size_text(frame.gray),
           size_text(frame.color));
    if (!frame.depth_m.empty()) {
        expect(has_size_of_gray(frame.depth_m), "depth image size", size_text(frame.gray),
               size_text(frame.depth_m));
        expect(has_reading(frame.depth_m), "depth image", "at least one reading above 0", "none");
    }
    if (frame.camera) check(*frame.camera);
}

}  // namespace ism
