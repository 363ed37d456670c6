// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>

#include "ism/core/frame.hpp"
#include "ism/core/image.hpp"

namespace ism {

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

}  // namespace ism
