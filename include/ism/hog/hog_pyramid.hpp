// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "ism/core/image.hpp"
#include "ism/core/resize_area.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/hog/hog_level.hpp"

namespace ism {

/// @brief Gradients and colours of an image at resolutions half an octave apart, for any box of any size.
class HogPyramid {
public:
    static constexpr int finest = -2, coarsest = 11;
    static constexpr double max_pixels = 2e6;  ///< of a level: 200 MB of sums; larger images begin coarser

    HogPyramid() = default;
    /// @param first  the finest level that is needed: 0 is the image's own resolution, −2 twice that
    HogPyramid(ImageView<const Rgb> color, int first, ThreadPool& pool) { assign(color, first, pool); }

    /// @brief Describes another image, in the memory of the last.
    void assign(ImageView<const Rgb> color, int first, ThreadPool& pool) {
        first_ = std::clamp(first, finest, coarsest), width_ = color.width(), height_ = color.height();
        while (first_<coarsest&& double(width_) * height_ * std::exp2(-first_)> max_pixels) ++first_;
        image_.clear();
        image_.reserve(std::size_t(width_) * std::size_t(height_) * 3);
        for (int y = 0; y < height_; ++y)
            for (const Rgb c : color.row(y))
                image_.insert(image_.end(), {c.r / 255.0f, c.g / 255.0f, c.b / 255.0f});
        std::vector<std::vector<float>> images;
        std::size_t numbers = 0;
        const auto level = [&](std::size_t i) -> HogLevel& {
            return levels_[std::size_t(first_ - finest) + i];
        };
        for (int k = first_; k <= coarsest; ++k) {
            const double step = std::exp2(k / 2.0);
            const int w = std::max(2, int(std::lround(width_ / step))),
                      h = std::max(2, int(std::lround(height_ / step)));
            if (k > std::max(0, first_) && std::min(w, h) < 12) break;
            const std::size_t i = images.size();
            if (i >= 2 && k >= 2)
                images.push_back(
                    resize_area(images[i - 2], level(i - 2).width, level(i - 2).height, 3, w, h));
            else
                images.push_back(resize_area(image_, width_, height_, 3, w, h));
            level(i).width = w, level(i).height = h;
            numbers += HogLevel::count(w, h);
        }
        last_ = first_ + int(images.size()) - 1;
        if (memory_size_ < numbers) {
            memory_.reset(), memory_size_ = 0;  // given back before there is more
            const std::size_t size =
                numbers + numbers / 2;  // room for larger images; untouched, it costs nothing
            memory_ = std::make_unique_for_overwrite<float[]>(size);
            memory_size_ = size;
        }
        std::size_t begin = 0;
        for (std::size_t i = 0; i < images.size(); ++i) {
            const std::size_t count = HogLevel::count(level(i).width, level(i).height);
            level(i).sums = {memory_.get() + begin, count};
            begin += count;
        }
        pool.for_each(images.size(),
                      [&](std::size_t i, unsigned) { detail::fill_level(level(i), images[i]); });
    }

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    /// @brief The level at which a length of so many pixels is nearest to 8.
    [[nodiscard]] const HogLevel& level_for(double cell_px) const {
        const int wanted = int(std::lround(2 * std::log2(std::max(1e-3, cell_px) / 8)));
        return levels_[std::size_t(std::clamp(wanted, first_, last_) - finest)];
    }

private:
    int first_ = 0, last_ = 0, width_ = 0, height_ = 0;
    std::vector<float> image_;         // its colours, 0 … 1
    std::unique_ptr<float[]> memory_;  // the sums of all levels
    std::size_t memory_size_ = 0;
    std::array<HogLevel, coarsest - finest + 1> levels_;  // those from first_ to last_
};

}  // namespace ism
