// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>

#include "ism/core/frame.hpp"
#include "ism/core/image.hpp"

namespace ism {

/// @brief The colours of a frame, which has to live longer; those of a grey one are its brightness in 8 bits.
class FrameColors {
public:
    explicit FrameColors(const Frame& frame) : frame_(frame) {
        if (!frame.color.empty()) return;
        brightness_ = RgbImage(frame.gray.width(), frame.gray.height());
        std::transform(frame.gray.pixels().begin(), frame.gray.pixels().end(), brightness_.pixels().begin(),
                       [](float gray) {
                           const float byte = 255 * std::clamp(gray, 0.0f, 1.0f) + 0.5f;
                           const auto rounded = static_cast<std::uint8_t>(byte);
                           return Rgb{rounded, rounded, rounded};
                       });
    }
    explicit FrameColors(Frame&&) = delete;

    [[nodiscard]] const RgbImage& image() const { return frame_.color.empty() ? brightness_ : frame_.color; }

private:
    const Frame& frame_;
    RgbImage brightness_;
};

}  // namespace ism
