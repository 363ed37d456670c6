// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/callable.hpp"

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

/// @brief The rows of an image whose numbers lie one after another.
struct RowsInMemory {
    std::span<const float> image;
    std::size_t row_numbers = 0;
    [[nodiscard]] std::span<const float> operator()(std::size_t y) const {
        return image.subspan(y * row_numbers, row_numbers);
    }
};

/// @brief An image of so many numbers a pixel in another size, row after row: where it shrinks each pixel is
/// the mean of what it covers, where it grows it is interpolated linearly.
/// @tparam Rows  tells the width · channels numbers of a row of the image; they stay until the next is told
template <std::size_t channels, Callable<std::size_t> Rows = RowsInMemory>
requires(channels > 0) class ResizedRows {
public:
    ResizedRows(Rows rows, int width, int height, int new_width, int new_height)
        : rows_(std::move(rows)),
          same_(width == new_width && height == new_height),
          across_(width, new_width),
          down_(height, new_height),
          line_(std::size_t(width) * channels) {}

    /// @brief Row y of the new size.
    /// @param out  new_width · channels numbers
    void write(std::size_t y, std::span<float> out) {
        if (same_) {
            std::copy_n(rows_(y).begin(), line_.size(), out.begin());
            return;
        }
        std::fill(line_.begin(), line_.end(), 0.0f);
        for (std::uint32_t k = down_.offset[y]; k < down_.offset[y + 1]; ++k) {
            const std::span<const float> from = rows_(down_.first[y] + k - down_.offset[y]);
            for (std::size_t i = 0; i < line_.size(); ++i) line_[i] += down_.weight[k] * from[i];
        }
        for (std::size_t x = 0; x < across_.first.size(); ++x) {
            const float* from = line_.data() + across_.first[x] * channels;
            float sums[channels] = {};
            for (std::uint32_t k = across_.offset[x]; k < across_.offset[x + 1]; ++k, from += channels)
                for (std::size_t c = 0; c < channels; ++c) sums[c] += across_.weight[k] * from[c];
            std::copy_n(sums, channels, out.data() + x * channels);
        }
    }

private:
    Rows rows_;
    bool same_;
    detail::LineWeights across_, down_;
    std::vector<float> line_;  // of the old width
};

/// @brief All rows of ResizedRows.
template <std::size_t channels, Callable<std::size_t> Rows>
[[nodiscard]] std::vector<float> resize_area(Rows rows, int width, int height, int new_width,
                                             int new_height) {
    const std::size_t row = std::size_t(new_width) * channels;
    std::vector<float> result(row * std::size_t(new_height));
    ResizedRows<channels, Rows> resized(std::move(rows), width, height, new_width, new_height);
    for (std::size_t y = 0; y < std::size_t(new_height); ++y)
        resized.write(y, std::span(result).subspan(y * row, row));
    return result;
}

/// @brief The same of an image whose width · height · channels numbers lie one after another.
template <std::size_t channels>
[[nodiscard]] std::vector<float> resize_area(std::span<const float> image, int width, int height,
                                             int new_width, int new_height) {
    return resize_area<channels>(RowsInMemory{image, std::size_t(width) * channels}, width, height, new_width,
                                 new_height);
}

}  // namespace ism
