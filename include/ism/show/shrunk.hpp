// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ism/core/image.hpp"
#include "ism/core/resize_area.hpp"

namespace ism {

/// @brief An image made so much smaller, 0 < zoom ≤ 1; each pixel is the mean of those it stands for.
[[nodiscard]] inline RgbImage shrunk(ImageView<const Rgb> image, double zoom) {
    std::vector<float> numbers;
    numbers.reserve(std::size_t(image.width()) * std::size_t(image.height()) * 3);
    for (int y = 0; y < image.height(); ++y)
        for (const Rgb& pixel : image.row(y))
            numbers.insert(numbers.end(), {float(pixel.r), float(pixel.g), float(pixel.b)});
    const auto side = [&](int px) { return std::max(1, int(std::lround(zoom * px))); };
    RgbImage small(side(image.width()), side(image.height()));
    numbers = resize_area<3>(numbers, image.width(), image.height(), small.width(), small.height());
    for (std::size_t i = 0; i < small.pixels().size(); ++i)
        small.pixels()[i] = {std::uint8_t(numbers[3 * i] + 0.5f), std::uint8_t(numbers[3 * i + 1] + 0.5f),
                             std::uint8_t(numbers[3 * i + 2] + 0.5f)};
    return small;
}

}  // namespace ism
