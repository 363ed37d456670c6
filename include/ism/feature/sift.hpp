// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <string_view>

#include "ism/feature/descriptor.hpp"
#include "ism/feature/gradient.hpp"

namespace ism {

namespace detail {

inline constexpr int sift_cells = 4;   // along a side
inline constexpr int sift_angles = 8;  // in a cell
inline constexpr float sift_cell = 3;  // side of a cell in units of the feature's scale
inline constexpr std::size_t sift_size = sift_cells * sift_cells * sift_angles;

/// The histogram of gradient directions in 4×4 cells, each gradient shared between the neighbouring cells and
/// directions and weighted by a Gaussian of half the window's side (Lowe 2004, section 6.1), not yet
/// normalised. (x, y) and sigma are in pixels of `image`.
class SiftWindow {
public:
    SiftWindow(ImageView<const float> image, float x, float y, float sigma, float angle)
        : image_(image),
          x_(x),
          y_(y),
          reach_(0.5f * (sift_cells + 1) * sift_cell * sigma *
                 (std::fabs(std::cos(angle)) + std::fabs(std::sin(angle)))),
          cosine_(std::cos(angle) / (sift_cell * sigma)),
          sine_(std::sin(angle) / (sift_cell * sigma)),
          turn_(std::remainder(angle, 2 * std::numbers::pi_v<float>) * per_radian) {}

    void histogram(std::span<float, sift_size> out) {
        if (std::fabs(x_) < too_far && std::fabs(y_) < too_far && reach_ < too_far) {  // not for NaN
            const int y1 = last_at(y_, image_.height());
            for (int y = first_at(y_); y <= y1; ++y) add_row(y);
            share_out();
        }
        for (int v = 0; v < sift_cells; ++v)
            for (int u = 0; u < sift_cells; ++u) {
                const std::size_t cell = std::size_t((v + 1) * padded + u + 1) * bins;
                float* to = out.data() + (v * sift_cells + u) * sift_angles;
                for (std::size_t b = 0; b < sift_angles; ++b) to[b] = even_[cell + b] + odd_[cell + b];
                to[0] += even_[cell + sift_angles] + odd_[cell + sift_angles];
                for (std::size_t b = 0; b < sift_angles; ++b) to[b] = std::max(to[b], 0.0f);
            }
    }

private:
    static constexpr int padded = sift_cells + 2, bins = sift_angles + 1;  // the last bin is the first
    static constexpr float per_radian = sift_angles / (2 * std::numbers::pi_v<float>);
    static constexpr float too_far = 1e6f;  // pixels: a window of which no coordinate overflows
    static constexpr float middle = (sift_cells + 1) * 0.5f;

    /// The first and last pixel in reach along one axis, of those with a gradient.
    [[nodiscard]] int first_at(float centre) const {
        return int(std::clamp(std::ceil(centre - reach_), 1.0f, 1e6f));
    }
    [[nodiscard]] int last_at(float centre, int side) const {
        return int(std::clamp(std::floor(centre + reach_), 0.0f, float(side - 2)));
    }

    /// Where on a row a coordinate start + slope · dx of the window lies within it.
    static void narrow(float start, float slope, float& low, float& high) {
        constexpr float flat = 1e-6f;
        if (std::fabs(slope) < flat) {
            if (!(start > 0 && start < sift_cells + 1)) low = 1, high = -1;
            return;
        }
        const float a = -start / slope, b = (sift_cells + 1 - start) / slope;
        low = std::max(low, std::min(a, b)), high = std::min(high, std::max(a, b));
    }

    void add_row(int row) {
        const float dy = float(row) - y_;
        float low = -reach_, high = reach_;
        narrow(sine_ * dy + middle, cosine_, low, high);
        narrow(cosine_ * dy + middle, -sine_, low, high);
        const int last = std::min(last_at(x_, image_.width()), int(std::floor(x_ + high)));
        for (int x = std::max(first_at(x_), int(std::ceil(x_ + low))); x <= last;) {
            const std::size_t count =
                std::min(std::size_t(last - x + 1), GradientBatch::capacity - batch_.count);
            batch_.add_row(image_, x, row, count, x_, y_);
            x += int(count);
            if (batch_.count == GradientBatch::capacity) share_out();
        }
    }

    void share_out() {
        batch_.make_polar();
        // the histogram bin of each gradient and its trilinear shares: 2×2 cells, two directions in each
        alignas(64) std::array<std::int32_t, GradientBatch::capacity> place;
        alignas(64) std::array<GradientBatch::Numbers, 8> part;
        for (std::size_t k = 0; k < batch_.count; ++k) {
            const float dx = batch_.dx[k], dy = batch_.dy[k];
            const float across = cosine_ * dx + sine_ * dy, along = cosine_ * dy - sine_ * dx;
            const float value = batch_.magnitude[k] * small_exp(0.125f * (across * across + along * along));
            // cells from −1 (half a cell before the first) to 4; +1 for the padding. Rounding may put a
            // sample slightly outside, and its share slightly below 0.
            const float u = across + middle, v = along + middle;
            const int iu = std::min(std::max(int(u), 0), sift_cells);
            const int iv = std::min(std::max(int(v), 0), sift_cells);
            float bin = batch_.angle[k] * per_radian - turn_;
            bin += bin < 0 ? float(sift_angles) : 0.0f;
            bin += bin < 0 ? float(sift_angles) : 0.0f;
            bin -= bin >= sift_angles ? float(sift_angles) : 0.0f;
            const int ib = std::min(int(bin), sift_angles - 1);
            const float au = u - float(iu), av = v - float(iv), ab = bin - float(ib);
            const float upper = value * (1 - av), lower = value * av;
            const float ul = upper * (1 - au), ur = upper * au, ll = lower * (1 - au), lr = lower * au;
            part[0][k] = ul * (1 - ab), part[1][k] = ul * ab;
            part[2][k] = ur * (1 - ab), part[3][k] = ur * ab;
            part[4][k] = ll * (1 - ab), part[5][k] = ll * ab;
            part[6][k] = lr * (1 - ab), part[7][k] = lr * ab;
            place[k] = (iv * padded + iu) * bins + ib;
        }
        // neighbours often share a bin: two histograms, so that no sum waits for the one before it
        for (std::size_t k = 0; k < batch_.count; ++k) {
            float* to = ((k & 1) == 0 ? even_.data() : odd_.data()) + place[k];
            to[0] += part[0][k], to[1] += part[1][k];
            to[bins] += part[2][k], to[bins + 1] += part[3][k];
            to += padded * bins;
            to[0] += part[4][k], to[1] += part[5][k];
            to[bins] += part[6][k], to[bins + 1] += part[7][k];
        }
        batch_.count = 0;
    }

    ImageView<const float> image_;
    float x_, y_, reach_, cosine_, sine_, turn_;
    GradientBatch batch_;
    alignas(64) std::array<float, padded * padded * bins> even_{}, odd_{};
};

/// The sum of f(value), in eight partial sums as SIMD lanes would hold them.
template <class F>
[[nodiscard]] float sum_of(std::span<const float, sift_size> row, const F& f) {
    std::array<float, 8> parts{};
    for (std::size_t i = 0; i < sift_size; i += 8)
        for (std::size_t j = 0; j < 8; ++j) parts[j] += f(row[i + j]);
    return ((parts[0] + parts[4]) + (parts[1] + parts[5])) + ((parts[2] + parts[6]) + (parts[3] + parts[7]));
}

/// To unit length, no number above 0.2, to unit length again; all 0 stays so.
inline void normalise_sift(std::span<float, sift_size> row) {
    for (const float most : {0.2f, 1.0f}) {
        const float sum = sum_of(row, [](float value) { return value * value; });
        if (!(sum > 1e-12f)) return std::fill(row.begin(), row.end(), 0.0f);
        const float factor = 1 / std::sqrt(sum);
        for (float& value : row) value = value * factor < most ? value * factor : most;
    }
}

}  // namespace detail

/// @brief SIFT: histograms of 8 gradient directions in 4×4 cells of 3 scales a side, of unit length (Lowe
/// 2004, section 6). Number (row · 4 + column) · 8 + direction; rows run along y, directions from x towards
/// y, both turned by Feature::angle (upright where that is 0). A window without any gradient gives zeros.
struct Sift {
    using Scalar = float;
    static constexpr std::size_t dimension = detail::sift_size;
    static constexpr std::string_view name = "sift";
    static constexpr float support_radius = detail::sift_cell * detail::sift_cells / 2;
    static constexpr float reach = 10.7f;  ///< half the diagonal of 5×5 cells, scales
    static constexpr double sq_length = 1;

    [[nodiscard]] static float level_scale(const Feature& f) { return f.scale; }

    void describe(const ScaleSpace& space, const Feature& f, std::span<float, dimension> out) const {
        const auto [image, step] = space.sampling(level_scale(f));
        detail::SiftWindow(image, f.x / step, f.y / step, f.scale / step, f.angle).histogram(out);
        detail::normalise_sift(out);
    }
};

/// @brief RootSIFT: the square roots of SIFT divided by its sum, of unit length; Euclidean distance between
/// them is Hellinger's between SIFTs (Arandjelović & Zisserman 2012).
struct RootSift {
    using Scalar = float;
    static constexpr std::size_t dimension = Sift::dimension;
    static constexpr std::string_view name = "root-sift";
    static constexpr float support_radius = Sift::support_radius, reach = Sift::reach;
    static constexpr double sq_length = 1;

    [[nodiscard]] static float level_scale(const Feature& f) { return Sift::level_scale(f); }

    void describe(const ScaleSpace& space, const Feature& f, std::span<float, dimension> out) const {
        Sift{}.describe(space, f, out);
        const float sum = detail::sum_of(out, [](float value) { return value; });
        if (!(sum > 0)) return;
        const float factor = 1 / sum;
        for (float& value : out) value = std::sqrt(value * factor);
    }
};

}  // namespace ism
