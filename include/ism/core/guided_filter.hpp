// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/image.hpp"

namespace ism {

/// @brief The mean of each pixel's window of (2 · radius + 1)² pixels, or of what of it lies in the image.
[[nodiscard]] inline GrayImage box_mean(ImageView<const float> image, int radius) {
    expect(radius >= 0, "box_mean: radius", "0 or more", radius);
    const int width = image.width(), height = image.height();
    GrayImage result(width, height);
    // Running sums in double: what comes in goes out again without a trace.
    std::vector<double> columns(std::size_t(width), 0.0);
    const auto add_row = [&](int y, double sign) {
        const auto row = image.row(y);
        for (std::size_t x = 0; x < columns.size(); ++x) columns[x] += sign * row[x];
    };
    for (int y = 0; y < std::min(radius, height); ++y) add_row(y, 1);
    for (int y = 0; y < height; ++y) {
        if (y + radius < height) add_row(y + radius, 1);
        if (y - radius > 0) add_row(y - radius - 1, -1);
        const int rows = std::min(height - 1, y + radius) - std::max(0, y - radius) + 1;
        double sum = 0;
        for (int x = 0; x < std::min(radius, width); ++x) sum += columns[std::size_t(x)];
        for (int x = 0; x < width; ++x) {
            if (x + radius < width) sum += columns[std::size_t(x + radius)];
            if (x - radius > 0) sum -= columns[std::size_t(x - radius - 1)];
            const int count = rows * (std::min(width - 1, x + radius) - std::max(0, x - radius) + 1);
            result(x, y) = float(sum / count);
        }
    }
    return result;
}

/// @brief What follows the edges of another image: at each pixel slope · guide + offset.
struct GuidedFit {
    GrayImage slope, offset;
};

/// @brief Fits an image by linear functions of a guide, one a window, and takes at each pixel the mean of
/// those whose windows it lies in: the guided filter (He, Sun and Tang 2010). It may be fitted at a lower
/// resolution than the guide it is applied to (He and Sun 2015).
/// @param guide, image  of one size
/// @param radius        of the windows, pixels
/// @param epsilon       variance of the guide below which a window counts as flat
/// @throws Error for images of two sizes, a radius below 0, or an epsilon that is not above 0.
[[nodiscard]] inline GuidedFit guided_fit(ImageView<const float> guide, ImageView<const float> image,
                                          int radius, double epsilon) {
    expect(guide.width() == image.width() && guide.height() == image.height(),
           "guided_fit: size of the image", size_text(guide), size_text(image));
    expect(epsilon > 0, "guided_fit: epsilon", "above 0", epsilon);
    const int width = guide.width(), height = guide.height();
    GrayImage sq_guide(width, height), product(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            sq_guide(x, y) = guide(x, y) * guide(x, y);
            product(x, y) = guide(x, y) * image(x, y);
        }
    const GrayImage mean_guide = box_mean(guide, radius), mean_image = box_mean(image, radius);
    GrayImage slope = box_mean(product, radius), offset = box_mean(sq_guide, radius);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float g = mean_guide(x, y), m = mean_image(x, y);
            const float a = (slope(x, y) - g * m) / (offset(x, y) - g * g + float(epsilon));
            slope(x, y) = a, offset(x, y) = m - a * g;
        }
    return {box_mean(slope, radius), box_mean(offset, radius)};
}

}  // namespace ism
