// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "ism/core/image.hpp"

namespace ism {

inline constexpr Rgb black{0, 0, 0}, white{255, 255, 255};

/// @brief Between two colours: `from` at share 0, `to` at share 1.
[[nodiscard]] inline Rgb mix(Rgb from, Rgb to, double share) {
    const auto channel = [share](std::uint8_t a, std::uint8_t b) {
        return std::uint8_t(a + (b - a) * std::clamp(share, 0.0, 1.0) + 0.5);
    };
    return {channel(from.r, to.r), channel(from.g, to.g), channel(from.b, to.b)};
}

/// @brief Brightness of a colour (ITU-R BT.601 weights), 0 … 1.
[[nodiscard]] constexpr double brightness(Rgb c) {
    return (0.299 * c.r + 0.587 * c.g + 0.114 * c.b) / 255;
}

/// @brief Relative luminance of a colour, 0 … 1 (WCAG 2.1; sRGB as IEC 61966-2-1 has it).
[[nodiscard]] inline double luminance(Rgb c) {
    const auto linear = [](std::uint8_t channel) {
        const double value = channel / 255.0;
        return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(c.r) + 0.7152 * linear(c.g) + 0.0722 * linear(c.b);
}

/// @brief Black or white, whichever has more contrast with the colour (WCAG 2.1): 4.5 or more with any.
[[nodiscard]] inline Rgb ink_on(Rgb ground) {
    return luminance(ground) > 0.179 ? black : white;
}

/// @brief 0 black … 1 white; NaN is black.
[[nodiscard]] inline Rgb grey_color(double value) {
    return mix(black, white, value > 0 ? value : 0);
}

/// @brief A colour for a value 0 … 1 whose brightness grows evenly with it: night blue, violet, red, orange,
/// pale yellow. NaN is the colour of 0.
[[nodiscard]] inline Rgb heat_color(double value) {
    constexpr std::array<Rgb, 6> stops = {
        {{10, 8, 34}, {70, 20, 112}, {150, 36, 110}, {220, 76, 62}, {248, 150, 30}, {252, 250, 190}}};
    const double at = (value > 0 ? std::min(value, 1.0) : 0.0) * (stops.size() - 1);
    const std::size_t i = std::min<std::size_t>(std::size_t(at), stops.size() - 2);
    return mix(stops[i], stops[i + 1], at - double(i));
}

/// @brief A colour for each class: ten that are easy to tell apart, then hues a golden angle apart.
[[nodiscard]] inline Rgb class_color(std::size_t class_index) {
    constexpr std::array<Rgb, 10> colors = {{{0, 166, 237},
                                             {255, 127, 17},
                                             {57, 181, 74},
                                             {230, 57, 70},
                                             {155, 93, 229},
                                             {255, 200, 0},
                                             {0, 187, 160},
                                             {241, 91, 181},
                                             {139, 105, 60},
                                             {120, 144, 200}}};
    if (class_index < colors.size()) return colors[class_index];
    const double hue = std::fmod(double(class_index) * 0.6180339887498949, 1.0) * 6;
    const auto channel = [hue](double shift) {
        const double distance = std::abs(std::fmod(hue + shift, 6.0) - 3);
        return std::uint8_t(std::lround(60 + 180 * std::clamp(distance - 1, 0.0, 1.0)));
    };
    return {channel(0), channel(4), channel(2)};
}

}  // namespace ism
