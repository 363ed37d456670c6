// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/config.hpp"

namespace ism {

namespace detail {

/// What goes into each number of a line that is made shorter or longer: `weights[i]` of the numbers from
/// first[i] on.
struct LineWeights {
    std::vector<std::uint32_t> first;   ///< of each new number
    std::vector<std::uint32_t> offset;  ///< of its weights; one more at the end
    std::vector<float> weight;

    LineWeights(int from, int to) {
        const double step = double(from) / to;
        offset.push_back(0);
        for (int i = 0; i < to; ++i) {
            if (step <= 1) {  // linear
                const double x = std::clamp((i + 0.5) * step - 0.5, 0.0, double(from - 1));
                const int left = std::min(int(x), std::max(0, from - 2));
                first.push_back(std::uint32_t(left));
                weight.push_back(float(1 - (x - left)));
                if (from > 1) weight.push_back(float(x - left));
            } else {  // the mean of what it covers
                const double begin = i * step, end = (i + 1) * step;
                first.push_back(std::uint32_t(begin));
                for (int j = int(begin); j < std::min<double>(from, end); ++j)
                    weight.push_back(float((std::min(end, j + 1.0) - std::max(begin, double(j))) / step));
            }
            offset.push_back(std::uint32_t(weight.size()));
        }
    }
};

}  // namespace detail

/// @brief An image of so many numbers a pixel in another size, row after row: where it shrinks each pixel is
/// the mean of what it covers, where it grows it is interpolated linearly.
template <std::size_t channels>
requires(channels > 0) class ResizedRows {
public:
    /// @param image  width · height · channels numbers; they have to stay as long as this
    ResizedRows(std::span<const float> image, int width, int height, int new_width, int new_height)
        : image_(image),
          width_(std::size_t(width)),
          new_width_(std::size_t(new_width)),
          same_(width == new_width && height == new_height),
          across_(width, new_width),
          down_(height, new_height),
          line_(width_ * channels) {}

    /// @brief Row y of the new size.
    /// @param out  new_width · channels numbers
    void write(std::size_t y, std::span<float> out) {
        const auto old_row = [&](std::size_t at) { return image_.subspan(at * line_.size(), line_.size()); };
        if (same_) {
            std::copy_n(old_row(y).begin(), line_.size(), out.begin());
            return;
        }
        std::fill(line_.begin(), line_.end(), 0.0f);
        for (std::uint32_t k = down_.offset[y]; k < down_.offset[y + 1]; ++k) {
            const std::span<const float> from = old_row(down_.first[y] + k - down_.offset[y]);
            for (std::size_t i = 0; i < line_.size(); ++i) line_[i] += down_.weight[k] * from[i];
        }
        for (std::size_t x = 0; x < new_width_; ++x) {
            const float* from = line_.data() + across_.first[x] * channels;
            float sums[channels] = {};
            for (std::uint32_t k = across_.offset[x]; k < across_.offset[x + 1]; ++k, from += channels)
                for (std::size_t c = 0; c < channels; ++c) sums[c] += across_.weight[k] * from[c];
            std::copy_n(sums, channels, out.data() + x * channels);
        }
    }

private:
    std::span<const float> image_;
    std::size_t width_, new_width_;
    bool same_;
    detail::LineWeights across_, down_;
    std::vector<float> line_;  // of the old width
};

/// @brief All rows of ResizedRows.
template <std::size_t channels>
[[nodiscard]] std::vector<float> resize_area(std::span<const float> image, int width, int height,
                                             int new_width, int new_height) {
    const std::size_t row = std::size_t(new_width) * channels;
    std::vector<float> result(row * std::size_t(new_height));
    ResizedRows<channels> rows(image, width, height, new_width, new_height);
    for (std::size_t y = 0; y < std::size_t(new_height); ++y)
        rows.write(y, std::span(result).subspan(y * row, row));
    return result;
}

}  // namespace ism
