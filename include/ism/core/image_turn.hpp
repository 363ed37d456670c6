// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"

namespace ism {

/// @brief Where things of an image lie in the same image turned about its middle, which is as large as it has
/// to be to show all of it.
class ImageTurn {
public:
    /// @param width, height  of the image, pixels
    /// @param angle_rad      by which it is turned, from x towards y
    ImageTurn(int width, int height, double angle_rad)
        : cosine_(std::cos(angle_rad)), sine_(std::sin(angle_rad)) {
        const auto side = [](double along, double across) {  // by a quarter sides change places as they are
            return int(std::ceil(std::abs(along) + std::abs(across) - 1e-6));
        };
        width_ = side(width * cosine_, height * sine_), height_ = side(width * sine_, height * cosine_);
        middle_ = {(width - 1) / 2.0, (height - 1) / 2.0};
        turned_middle_ = {(width_ - 1) / 2.0, (height_ - 1) / 2.0};
    }

    /// @brief Size of the turned image, pixels.
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    /// @brief Where a place of the image lies in the turned one.
    [[nodiscard]] Point2 turned(Point2 at) const {
        const double x = at.x - middle_.x, y = at.y - middle_.y;
        return {turned_middle_.x + cosine_ * x - sine_ * y, turned_middle_.y + sine_ * x + cosine_ * y};
    }
    /// @brief Where a place of the turned image lies in the image.
    [[nodiscard]] Point2 back(Point2 at) const {
        const double x = at.x - turned_middle_.x, y = at.y - turned_middle_.y;
        return {middle_.x + cosine_ * x + sine_ * y, middle_.y - sine_ * x + cosine_ * y};
    }
    /// @brief Upright in the image, the box around the ellipse that a box of the turned image holds.
    [[nodiscard]] Box back(const Box& box) const {
        return box_around(back(box.centre()), std::hypot(cosine_ * box.width, sine_ * box.height),
                          std::hypot(sine_ * box.width, cosine_ * box.height));
    }

private:
    double cosine_, sine_;
    int width_ = 0, height_ = 0;
    Point2 middle_, turned_middle_;
};

/// @brief The turned image, each pixel by what `sample` says of its place in the image, which may lie
/// outside.
template <Pixel T, class Sample>
[[nodiscard]] Image<T> turned_image(const ImageTurn& turn, const Sample& sample) {
    Image<T> turned(turn.width(), turn.height());
    for (int y = 0; y < turned.height(); ++y)
        for (int x = 0; x < turned.width(); ++x)
            turned(x, y) = sample(turn.back(Point2{double(x), double(y)}));
    return turned;
}

}  // namespace ism
