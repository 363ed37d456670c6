// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
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

/// @brief An image of `channels` numbers a pixel in another size: where it shrinks each pixel is the mean of
/// what it covers, where it grows it is interpolated linearly.
[[nodiscard]] inline std::vector<float> resize_area(const std::vector<float>& image, int width, int height,
                                                    int channels, int new_width, int new_height) {
    if (width == new_width && height == new_height) return image;
    const detail::LineWeights across(width, new_width), down(height, new_height);
    const std::size_t n = std::size_t(channels), old_row = std::size_t(width) * n,
                      row = std::size_t(new_width) * n;
    std::vector<float> result(row * std::size_t(new_height)), line(old_row);
    for (std::size_t y = 0; y < std::size_t(new_height); ++y) {
        std::fill(line.begin(), line.end(), 0.0f);
        for (std::uint32_t k = down.offset[y]; k < down.offset[y + 1]; ++k) {
            const float* from = image.data() + std::size_t(down.first[y] + k - down.offset[y]) * old_row;
            for (std::size_t i = 0; i < old_row; ++i) line[i] += down.weight[k] * from[i];
        }
        for (std::size_t x = 0; x < std::size_t(new_width); ++x)
            for (std::uint32_t k = across.offset[x]; k < across.offset[x + 1]; ++k)
                for (std::size_t c = 0; c < n; ++c)
                    result[y * row + x * n + c] +=
                        across.weight[k] * line[(across.first[x] + k - across.offset[x]) * n + c];
    }
    return result;
}

}  // namespace ism
