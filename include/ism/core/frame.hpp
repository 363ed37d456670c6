// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
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

/// @brief The colours of a frame; those of a grey one are its brightness in 8 bits.
[[nodiscard]] inline RgbImage colors_of(const Frame& frame) {
    if (!frame.color.empty()) return frame.color;
    RgbImage color(frame.gray.width(), frame.gray.height());
    std::transform(frame.gray.pixels().begin(), frame.gray.pixels().end(), color.pixels().begin(),
                   [](float gray) {
                       const auto byte = static_cast<std::uint8_t>(255 * std::clamp(gray, 0.0f, 1.0f) + 0.5f);
                       return Rgb{byte, byte, byte};
                   });
    return color;
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
        const auto pixels = frame.depth_m.pixels();
        expect(std::any_of(pixels.begin(), pixels.end(), [](float value) { return is_depth(value); }),
               "depth image", "at least one reading above 0", "none");
    }
    if (frame.camera) check(*frame.camera);
}

}  // namespace ism
