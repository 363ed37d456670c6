// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/error.hpp"

namespace ism {

/// @brief A colour in CIE Lab with all three numbers about 0 … 255: L in parts of 255, a and b around 128.
using Lab = std::array<float, 3>;

/// @brief From sRGB to Lab (white of D65).
class LabTable {
public:
    LabTable() {
        for (std::size_t i = 0; i < linear_.size(); ++i) {
            const double v = double(i) / 255;
            linear_[i] = float(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
        }
        for (std::size_t i = 0; i < root_.size(); ++i) {
            const double t = double(i) / steps;
            root_[i] = float(t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116);
        }
    }
    /// @param r, g, b  0 … 255
    [[nodiscard]] Lab operator()(float r, float g, float b) const {
        const float red = linear(r), green = linear(g), blue = linear(b);
        const float x = root((0.412453f * red + 0.357580f * green + 0.180423f * blue) / 0.950456f);
        const float y = root(0.212671f * red + 0.715160f * green + 0.072169f * blue);
        const float z = root((0.019334f * red + 0.119193f * green + 0.950227f * blue) / 1.088754f);
        return {2.55f * (116 * y - 16), 500 * (x - y) + 128, 200 * (y - z) + 128};
    }

private:
    static constexpr int steps = 1024;
    [[nodiscard]] float linear(float v) const {
        return linear_[std::size_t(std::clamp(v, 0.0f, 255.0f) + 0.5f)];
    }
    [[nodiscard]] float root(float t) const {
        const float at = std::clamp(t, 0.0f, 1.0f) * steps;
        const auto i = std::min<std::size_t>(steps - 1, std::size_t(at));
        return root_[i] + (at - float(i)) * (root_[i + 1] - root_[i]);
    }

    std::array<float, 256> linear_{};
    std::array<float, steps + 1> root_{};
};

/// @brief The pixels of a picture by their colour, for histograms of its parts: bins of 4 × 4 × 4 in Lab, of
/// which only the range that the picture has is kept.
class ColorBins {
public:
    /// @param rgb  three numbers a pixel, 0 … 255
    explicit ColorBins(std::span<const float> rgb) : bin_(rgb.size() / 3) {
        const LabTable to_lab;
        std::vector<std::array<std::uint8_t, 3>> levels(bin_.size());
        std::array<std::uint8_t, 3> low{255, 255, 255}, high{0, 0, 0};
        for (std::size_t i = 0; i < bin_.size(); ++i) {
            const Lab lab = to_lab(rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]);
            for (std::size_t k = 0; k < 3; ++k) {
                const float least = k == 0 ? 0.0f : 64.0f, most = k == 0 ? 255.0f : 191.0f;
                levels[i][k] = std::uint8_t(std::clamp(lab[k], least, most) / width);
                low[k] = std::min(low[k], levels[i][k]), high[k] = std::max(high[k], levels[i][k]);
            }
        }
        std::array<std::size_t, 3> sides{};
        for (std::size_t k = 0; k < 3; ++k)
            sides[k] = std::size_t(std::max(0, high[k] - low[k])) + 1 + 2 * reach;
        strides_ = {sides[1] * sides[2], sides[2], 1};
        count_ = sides[0] * strides_[0];
        for (std::size_t i = 0; i < bin_.size(); ++i) {
            std::size_t bin = 0;
            for (std::size_t k = 0; k < 3; ++k)
                bin += (std::size_t(levels[i][k] - low[k]) + reach) * strides_[k];
            bin_[i] = std::uint32_t(bin);
        }
    }

    /// @brief How much more often each pixel's colour is seen in the figure than in the ground: the logarithm
    /// of the ratio of both smoothed histograms.
    /// @param figure  p(figure) of each pixel
    /// @param limit   of the result, to both sides
    /// @throws Error where the number of pixels is another.
    [[nodiscard]] std::vector<float> log_ratio(std::span<const float> figure, float limit) const {
        expect(figure.size() == bin_.size(), "ColorBins::log_ratio: pixels", bin_.size(), figure.size());
        std::vector<float> in(count_, 0.0f), out(count_, 0.0f);
        double all_in = 0, all_out = 0;
        for (std::size_t i = 0; i < bin_.size(); ++i) {
            in[bin_[i]] += figure[i], out[bin_[i]] += 1 - figure[i];
            all_in += figure[i], all_out += 1 - figure[i];
        }
        smooth(in), smooth(out);
        const float by_in = float(1 / std::max(all_in, 1e-9)), by_out = float(1 / std::max(all_out, 1e-9));
        std::vector<float> result(bin_.size());
        for (std::size_t i = 0; i < bin_.size(); ++i)
            result[i] = std::clamp(std::log((in[bin_[i]] * by_in + rare) / (out[bin_[i]] * by_out + rare)),
                                   -limit, limit);
        return result;
    }

private:
    static constexpr float width = 4;     ///< of a bin
    static constexpr float rare = 1e-6f;  ///< part of the pixels that any colour has
    static constexpr std::size_t reach =
        2;  ///< empty bins around the range, so that smoothing may run over its ends

    /// Along each axis with 1 3 4 3 1.
    void smooth(std::vector<float>& histogram) const {
        std::vector<float> smoothed(histogram.size(), 0.0f);
        for (const std::size_t stride : strides_) {
            const float* from = histogram.data();
            float* to = smoothed.data();
            const std::size_t end = histogram.size() - 2 * stride;
            for (std::size_t i = 2 * stride; i < end; ++i)
                to[i] = (4 * from[i] + 3 * (from[i - stride] + from[i + stride]) +
                         (from[i - 2 * stride] + from[i + 2 * stride])) /
                        12;
            std::swap(histogram, smoothed);
        }
    }

    std::vector<std::uint32_t> bin_;
    std::array<std::size_t, 3> strides_{};
    std::size_t count_ = 0;
};

}  // namespace ism
