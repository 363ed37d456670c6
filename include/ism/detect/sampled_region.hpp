// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "ism/core/box_region.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/detect/exemplar_prior.hpp"
#include "ism/model/describe_exemplar.hpp"

namespace ism::detail {

/// The part of a picture that shows a box and what is around it, in the size that its colours are compared
/// at, beside the samples that a prior of the box has (ExemplarPrior).
class SampledRegion {
public:
    BoxRegion region;           ///< in the picture
    double zoom = 1;            ///< to the size that it is compared at …
    int width = 0, height = 0;  ///< … which is this

    SampledRegion(const Box& box, double margin, int max_side_px, int picture_width, int picture_height)
        : region(box, margin, picture_width, picture_height),
          zoom(std::min(1.0, double(max_side_px) / std::max(region.width, region.height))),
          box_(box) {
        width = std::max(2, int(std::lround(region.width * zoom)));
        height = std::max(2, int(std::lround(region.height * zoom)));
        zoom_x_ = double(width) / region.width, zoom_y_ = double(height) / region.height;
    }

    /// A prior at each pixel; 0 beyond it.
    [[nodiscard]] GrayImage to_pixels(const GrayImage& prior) const {
        GrayImage pixels(width, height, 0.0f);
        for (int y = 0; y < height; ++y) {
            const double py = region.y + (y + 0.5) / zoom_y_;
            const float v = sample_of(py - box_.y, box_.height);
            for (int x = 0; x < width; ++x) {
                const double px = region.x + (x + 0.5) / zoom_x_;
                const float u = sample_of(px - box_.x, box_.width);
                if (is_sample(u) && is_sample(v)) pixels(x, y) = sample_bilinear(prior, u, v);
            }
        }
        return pixels;
    }
    /// Pixels at each sample of a prior; one half outside the picture, where nothing is known.
    [[nodiscard]] GrayImage to_samples(const GrayImage& pixels) const {
        GrayImage samples(ExemplarPrior::side, ExemplarPrior::side, 0.5f);
        for (int y = 0; y < samples.height(); ++y) {
            const double py = box_.y + offset_px(y, box_.height) - region.y;
            for (int x = 0; x < samples.width(); ++x) {
                const double px = box_.x + offset_px(x, box_.width) - region.x;
                if (px >= 0 && py >= 0 && px <= region.width && py <= region.height)
                    samples(x, y) =
                        sample_bilinear(pixels, float(px * zoom_x_ - 0.5), float(py * zoom_y_ - 0.5));
            }
        }
        return samples;
    }

private:
    /// The sample that lies so many pixels from the edge of the box, whose side this is …
    [[nodiscard]] static float sample_of(double px, double side) {
        return float((px / (side / exemplar_cells) + ExemplarPrior::margin) * ExemplarPrior::samples - 0.5);
    }
    /// … and how many pixels that are.
    [[nodiscard]] static double offset_px(int sample, double side) {
        return ((sample + 0.5) / ExemplarPrior::samples - ExemplarPrior::margin) * (side / exemplar_cells);
    }
    [[nodiscard]] static bool is_sample(float at) { return at > -0.5f && at < ExemplarPrior::side - 0.5f; }

    Box box_;
    double zoom_x_ = 1, zoom_y_ = 1;  ///< after rounding to pixels
};

}  // namespace ism::detail
