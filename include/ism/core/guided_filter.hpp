// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/image.hpp"

namespace ism {

/// @brief The mean of each pixel's window of (2 · radius + 1)² pixels, or of what of it lies in the image.
[[nodiscard]] inline GrayImage box_mean(ImageView<const float> image, int radius) {
    expect(radius >= 0, "box_mean: radius", "0 or more", radius);
    const int width = image.width(), height = image.height();
    radius = std::min(radius, std::max(width, height));  // more is no more
    GrayImage result(width, height);
    // Running sums in double: of numbers within 0 ... 1 what goes out again leaves no trace.
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

/// @brief A colour image as three of numbers: red, green and blue.
using ColorPlanes = std::array<GrayImage, 3>;

/// @brief What follows the edges of a colour image: at each pixel the sum of slope · guide over its three
/// numbers, and offset.
struct GuidedFit {
    ColorPlanes slope;
    GrayImage offset;
};

namespace detail {

/// x of A · x = b, for a symmetric A with positive eigenvalues: xx, xy, xz, yy, yz, zz.
[[nodiscard]] inline std::array<double, 3> solve_symmetric(const std::array<double, 6>& a,
                                                           const std::array<double, 3>& b) {
    const auto [xx, xy, xz, yy, yz, zz] = a;
    const double i = yy * zz - yz * yz, j = xz * yz - xy * zz, k = xy * yz - xz * yy;
    const double by = 1 / (xx * i + xy * j + xz * k);
    const double m = xx * zz - xz * xz, n = xy * xz - xx * yz, o = xx * yy - xy * xy;
    return {by * (i * b[0] + j * b[1] + k * b[2]), by * (j * b[0] + m * b[1] + n * b[2]),
            by * (k * b[0] + n * b[1] + o * b[2])};
}

}  // namespace detail

/// @brief Fits an image by linear functions of a colour image, one a window, and takes at each pixel the mean
/// of those whose windows it lies in: the guided filter (He, Sun and Tang 2010). It may be fitted at a lower
/// resolution than the guide it is applied to (He and Sun 2015).
/// @param guide, image  of one size
/// @param radius        of the windows, pixels
/// @param epsilon       variance of the guide below which a window counts as flat; of guides 0 … 1 at least
///                      1e-6, since less is within errors of rounding
/// @throws Error for images of different sizes, a radius below 0, or an epsilon that is not above 0.
[[nodiscard]] inline GuidedFit guided_fit(const ColorPlanes& guide, ImageView<const float> image, int radius,
                                          double epsilon) {
    for (const GrayImage& plane : guide)
        expect(plane.width() == image.width() && plane.height() == image.height(),
               "guided_fit: size of the image", size_text(plane), size_text(image));
    expect(epsilon > 0, "guided_fit: epsilon", "above 0", epsilon);
    const int width = image.width(), height = image.height();
    const auto mean_product = [&](ImageView<const float> a, ImageView<const float> b) {
        GrayImage product(width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) product(x, y) = a(x, y) * b(x, y);
        return box_mean(product, radius);
    };
    const auto& [red, green, blue] = guide;
    const ColorPlanes mean{box_mean(red, radius), box_mean(green, radius), box_mean(blue, radius)};
    const GrayImage mean_image = box_mean(image, radius);
    const std::array<GrayImage, 6> squares{mean_product(red, red),    mean_product(red, green),
                                           mean_product(red, blue),   mean_product(green, green),
                                           mean_product(green, blue), mean_product(blue, blue)};
    ColorPlanes slope{mean_product(red, image), mean_product(green, image), mean_product(blue, image)};
    GrayImage offset(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double r = mean[0](x, y), g = mean[1](x, y), b = mean[2](x, y), p = mean_image(x, y);
            const auto a = detail::solve_symmetric(
                {squares[0](x, y) - r * r + epsilon, squares[1](x, y) - r * g, squares[2](x, y) - r * b,
                 squares[3](x, y) - g * g + epsilon, squares[4](x, y) - g * b,
                 squares[5](x, y) - b * b + epsilon},
                {slope[0](x, y) - r * p, slope[1](x, y) - g * p, slope[2](x, y) - b * p});
            for (std::size_t k = 0; k < 3; ++k) slope[k](x, y) = float(a[k]);
            offset(x, y) = float(p - a[0] * r - a[1] * g - a[2] * b);
        }
    for (GrayImage& plane : slope) plane = box_mean(plane, radius);
    return {std::move(slope), box_mean(offset, radius)};
}

}  // namespace ism
