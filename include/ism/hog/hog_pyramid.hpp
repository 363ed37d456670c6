// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "ism/core/image.hpp"
#include "ism/core/resize_area.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/hog/hog_level.hpp"

namespace ism {

/// @brief Gradients and colours of an image at resolutions half an octave apart, for any box of any size.
class HogPyramid {
public:
    static constexpr int finest = -1, coarsest = 11;
    static constexpr double max_pixels = 2e6;  ///< of a level: 100 MB of sums; larger images begin coarser

    HogPyramid() = default;
    /// @param first  the finest level that is needed: 0 is the image's own resolution, −1 half an octave
    /// finer
    HogPyramid(ImageView<const Rgb> color, int first, ThreadPool& pool) { assign(color, first, pool); }

    /// @brief Describes another image, in the memory of the last.
    void assign(ImageView<const Rgb> color, int first, ThreadPool& pool) {
        first_ = std::clamp(first, finest, coarsest), width_ = color.width(), height_ = color.height();
        while (first_<coarsest&& double(width_) * height_ * std::exp2(-first_)> max_pixels) ++first_;
        // Levels 0, 2, 4 … as images of four numbers a pixel, from the finest that is needed: each level is
        // made from one of less than twice its own size.
        std::array<std::vector<float>, coarsest / 2 + 1> images;
        const int base = std::max(0, first_ / 2);
        const auto [base_width, base_height] = size_at(2 * base);
        std::vector<float> row(4 * std::size_t(width_));  // red, green and blue, 0 … 1, and nothing
        const auto row_of_image = [&](std::size_t y) -> std::span<const float> {
            float* to = row.data();
            for (const Rgb c : color.row(int(y))) {
                to[0] = c.r / 255.0f, to[1] = c.g / 255.0f, to[2] = c.b / 255.0f;
                to += 4;
            }
            return row;
        };
        images[std::size_t(base)] = resize_area<4>(row_of_image, width_, height_, base_width, base_height);
        std::size_t numbers = 0;
        for (int k = first_; k <= coarsest; ++k) {
            const auto [w, h] = size_at(k);
            if (k > std::max(0, first_) && std::min(w, h) < 12) break;
            if (k % 2 == 0 && k / 2 > base) {
                const auto [from_w, from_h] = size_at(k - 2);
                images[std::size_t(k / 2)] =
                    resize_area<4>(images[std::size_t(k / 2 - 1)], from_w, from_h, w, h);
            }
            level(k).width = w, level(k).height = h;
            numbers += HogLevel::count(w, h);
            last_ = k;
        }
        if (!memory_ || memory_size_ < numbers) {
            memory_.reset(), memory_size_ = 0;  // given back before there is more
            const std::size_t size =
                numbers + numbers / 2;  // room for larger images; untouched, it costs nothing
            memory_ = std::make_unique_for_overwrite<std::uint16_t[]>(size);
            memory_size_ = size;
        }
        std::size_t begin = 0;
        for (int k = first_; k <= last_; ++k) {
            const std::size_t count = HogLevel::count(level(k).width, level(k).height);
            level(k).sums = {memory_.get() + begin, count};
            begin += count;
        }
        pool.for_each(std::size_t(last_ - first_ + 1), [&](std::size_t i, unsigned) {
            const int k = first_ + int(i), from = std::max(0, k / 2);
            const auto [w, h] = size_at(2 * from);
            HogLevel& filled = level(k);
            ResizedRows<4> rows({images[std::size_t(from)], 4 * std::size_t(w)}, w, h, filled.width,
                                filled.height);
            detail::fill_level(filled, rows);
        });
    }

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    /// @brief The level at which a length of so many pixels is nearest to 8.
    [[nodiscard]] const HogLevel& level_for(double cell_px) const {
        const int wanted = int(std::lround(2 * std::log2(std::max(1e-3, cell_px) / 8)));
        return levels_[std::size_t(std::clamp(wanted, first_, last_) - finest)];
    }

private:
    [[nodiscard]] HogLevel& level(int k) { return levels_[std::size_t(k - finest)]; }
    /// Width and height of level k.
    [[nodiscard]] std::array<int, 2> size_at(int k) const {
        const double step = std::exp2(k / 2.0);
        return {std::max(2, int(std::lround(width_ / step))), std::max(2, int(std::lround(height_ / step)))};
    }

    int first_ = 0, last_ = 0, width_ = 0, height_ = 0;
    std::unique_ptr<std::uint16_t[]> memory_;  // the sums of all levels
    std::size_t memory_size_ = 0;
    std::array<HogLevel, coarsest - finest + 1> levels_;  // those from first_ to last_
};

}  // namespace ism
