// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "ism/core/image.hpp"
#include "ism/core/resize_area.hpp"
#include "ism/core/thread_pool.hpp"

namespace ism {

inline constexpr std::size_t hog_directions = 18;  ///< of gradients, over the full circle
inline constexpr std::size_t hog_sums = 24;        ///< directions, three means of colour, and nothing

/// @brief Gradients and colours of an image at one resolution, as sums over all pixels above and to the left:
/// four of them give the sum over any rectangle (Viola and Jones 2001; for gradients Porikli 2005).
struct HogLevel {
    int width = 0, height = 0;  ///< pixels of the level
    std::vector<float> sums;    ///< (width + 1) · (height + 1) times hog_sums numbers

    [[nodiscard]] const float* at(int x, int y) const {
        return sums.data() + (std::size_t(y) * std::size_t(width + 1) + std::size_t(x)) * hog_sums;
    }
};

namespace detail {

/// Where a gradient points, 0 … 18: an odd polynomial of the smaller slope, exact to 0.002 of a direction.
[[nodiscard]] inline float hog_direction(float x, float y) {
    const float across = std::abs(x), along = std::abs(y);
    const float large = std::max(across, along), small = std::min(across, along);
    const float t = large > 0 ? small / large : 0, s = t * t;
    // (Abramowitz and Stegun 1964, 4.4.47)
    float turn = t * (2.864405f + s * (-0.946238f + s * (0.516066f + s * (-0.243888f + s * 0.059688f))));
    if (along > across) turn = 4.5f - turn;
    if (x < 0) turn = 9 - turn;
    if (y < 0) turn = 18 - turn;
    return turn;
}

/// One level from its colours, three numbers a pixel.
[[nodiscard]] inline HogLevel hog_level(const std::vector<float>& rgb, int width, int height) {
    HogLevel level{width, height, {}};
    const std::size_t row_numbers = std::size_t(width + 1) * hog_sums;
    level.sums.assign(row_numbers * std::size_t(height + 1), 0);
    for (int y = 0; y < height; ++y) {
        const float* row = rgb.data() + std::size_t(y) * std::size_t(width) * 3;
        const float* above = rgb.data() + std::size_t(std::max(0, y - 1)) * std::size_t(width) * 3;
        const float* below = rgb.data() + std::size_t(std::min(height - 1, y + 1)) * std::size_t(width) * 3;
        const float* up = level.sums.data() + std::size_t(y) * row_numbers;
        float* out = level.sums.data() + std::size_t(y + 1) * row_numbers;
        std::array<float, hog_sums> sum{};
        for (int x = 0; x < width; ++x) {
            const float *left = row + std::max(0, x - 1) * 3, *right = row + std::min(width - 1, x + 1) * 3;
            float best_x = 0, best_y = 0, most = -1;
            for (int k = 0; k < 3; ++k) {
                const float gx = right[k] - left[k], gy = below[x * 3 + k] - above[x * 3 + k];
                const float sq = gx * gx + gy * gy;
                if (sq > most) most = sq, best_x = gx, best_y = gy;
            }
            const float strength = std::sqrt(most), turn = hog_direction(best_x, best_y);
            const auto direction = std::min<std::size_t>(hog_directions - 1, std::size_t(turn));
            const float part = turn - float(direction);
            sum[direction] += strength * (1 - part);
            sum[direction + 1 < hog_directions ? direction + 1 : 0] += strength * part;
            const float* c = row + x * 3;
            sum[hog_directions] += (c[0] + c[1] + c[2]) / 3;
            sum[hog_directions + 1] += c[0] - c[1];
            sum[hog_directions + 2] += (c[0] + c[1]) / 2 - c[2];
            const float* of_above = up + std::size_t(x + 1) * hog_sums;
            float* to = out + std::size_t(x + 1) * hog_sums;
            for (std::size_t k = 0; k < hog_sums; ++k) to[k] = of_above[k] + sum[k];
        }
    }
    return level;
}

}  // namespace detail

/// @brief Gradients and colours of an image at resolutions half an octave apart, for any box of any size.
class HogPyramid {
public:
    static constexpr int finest = -2, coarsest = 11;
    static constexpr double max_pixels = 2e6;  ///< of a level: 200 MB of sums; larger images begin coarser

    HogPyramid() = default;
    /// @param first  the finest level that is needed: 0 is the image's own resolution, −2 twice that
    HogPyramid(ImageView<const Rgb> color, int first, ThreadPool& pool)
        : first_(std::clamp(first, finest, coarsest)), width_(color.width()), height_(color.height()) {
        while (first_<coarsest&& double(width_) * height_ * std::exp2(-first_)> max_pixels) ++first_;
        std::vector<float> image;
        image.reserve(std::size_t(width_) * std::size_t(height_) * 3);
        for (int y = 0; y < height_; ++y)
            for (const Rgb c : color.row(y))
                image.insert(image.end(), {c.r / 255.0f, c.g / 255.0f, c.b / 255.0f});
        std::vector<std::vector<float>> images;
        std::vector<std::pair<int, int>> sizes;
        for (int k = first_; k <= coarsest; ++k) {
            const double step = std::exp2(k / 2.0);
            const int w = std::max(2, int(std::lround(width_ / step))),
                      h = std::max(2, int(std::lround(height_ / step)));
            if (k > std::max(0, first_) && std::min(w, h) < 12) break;
            const std::size_t i = images.size();
            if (i >= 2 && k >= 2)
                images.push_back(
                    resize_area(images[i - 2], sizes[i - 2].first, sizes[i - 2].second, 3, w, h));
            else
                images.push_back(resize_area(image, width_, height_, 3, w, h));
            sizes.emplace_back(w, h);
        }
        levels_.resize(images.size());
        pool.for_each(images.size(), [&](std::size_t i, unsigned) {
            levels_[i] = detail::hog_level(images[i], sizes[i].first, sizes[i].second);
        });
    }

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    /// @brief The level at which a length of so many pixels is nearest to 8.
    [[nodiscard]] const HogLevel& level_for(double cell_px) const {
        const int wanted = int(std::lround(2 * std::log2(std::max(1e-3, cell_px) / 8)));
        return levels_[std::size_t(std::clamp(wanted - first_, 0, int(levels_.size()) - 1))];
    }

private:
    int first_ = 0, width_ = 0, height_ = 0;
    std::vector<HogLevel> levels_;
};

}  // namespace ism
