// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ism/core/box_region.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"

namespace ism::detail {

/// A picture of an object's box and of what lies around, as an example of how it may look.
struct ObjectPicture {
    RgbImage picture;
    Box box;  ///< in the picture
};

/// Colours between pixels by bilinear interpolation; outside the edge is repeated.
class ColorSampler {
public:
    /// A region of an image at `factor` ≤ 1 times its size.
    ColorSampler(ImageView<const Rgb> image, const BoxRegion& region, double factor)
        : left_(region.x), top_(region.y) {
        const int columns = std::max(1, int(std::lround(region.width * factor))),
                  rows = std::max(1, int(std::lround(region.height * factor)));
        across_ = double(columns) / region.width, down_ = double(rows) / region.height;
        const std::vector<float> numbers = region_colors(image, region, columns, rows);
        for (std::size_t k = 0; k < 3; ++k) {
            planes_[k] = GrayImage(columns, rows);
            const auto pixels = planes_[k].pixels();
            for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = numbers[3 * i + k];
        }
    }

    /// Around a place in the image, where pixel (x, y) reaches from there to (x + 1, y + 1).
    [[nodiscard]] Rgb operator()(double x, double y) const {
        const float u = float((x - left_) * across_ - 0.5), v = float((y - top_) * down_ - 0.5);
        const auto mixed = [&](std::size_t k) {
            return std::uint8_t(sample_bilinear(planes_[k], u, v) + 0.5f);
        };
        return {mixed(0), mixed(1), mixed(2)};
    }

private:
    std::array<GrayImage, 3> planes_ = {};
    int left_, top_;
    double across_ = 1, down_ = 1;
};

/// Turns an object about the middle of its box. Where it is larger than 400 × 400 pixels, the picture is
/// smaller.
/// @param angle_rad  clockwise
/// @param margin     around the box, as a part of the root of its area
[[nodiscard]] inline ObjectPicture turned_object(ImageView<const Rgb> image, const Box& box, double angle_rad,
                                                 double margin) {
    constexpr double max_side = 400;
    const double side = std::sqrt(box.area()), factor = std::min(1.0, max_side / side),
                 cosine = std::cos(angle_rad), sine = std::sin(angle_rad);
    const double width = box.width + 2 * margin * side, height = box.height + 2 * margin * side,
                 x = box.x + box.width / 2, y = box.y + box.height / 2;
    const double seen_width = width * std::abs(cosine) + height * std::abs(sine),
                 seen_height = width * std::abs(sine) + height * std::abs(cosine);
    const BoxRegion seen({x - seen_width / 2, y - seen_height / 2, seen_width, seen_height}, 0, image.width(),
                         image.height());
    const ColorSampler color(image, seen, factor);
    ObjectPicture turned{
        .picture = RgbImage(int(std::ceil(width * factor)), int(std::ceil(height * factor))),
        .box = {margin * side * factor, margin * side * factor, box.width * factor, box.height * factor}};
    for (int row = 0; row < turned.picture.height(); ++row)
        for (int column = 0; column < turned.picture.width(); ++column) {
            const double dx = (column + 0.5) / factor - width / 2, dy = (row + 0.5) / factor - height / 2;
            turned.picture(column, row) = color(x + cosine * dx + sine * dy, y - sine * dx + cosine * dy);
        }
    return turned;
}

}  // namespace ism::detail
