// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "ism/feature/descriptor.hpp"

namespace ism {

/// @brief A grey patch as descriptor (as Leibe, Leonardis & Schiele 2008 used): 25×25 samples over ±6 scales,
/// turned by Feature::angle, number row · 25 + column. Mean and deviation are taken out: a sample z
/// deviations from the mean becomes 128 + 42·z, rounded and kept within 0 … 255; a patch without contrast is
/// all 128. Outside the image the edge pixels are repeated.
struct GrayPatch {
    using Scalar = std::uint8_t;
    static constexpr int side = 25;
    static constexpr std::size_t dimension = std::size_t(side) * side;
    static constexpr std::string_view name = "gray-patch";
    static constexpr float support_radius = 6;
    static constexpr float reach = 8.5f;                  ///< half the diagonal, scales
    static constexpr double sq_length = 625.0 * 42 * 42;  ///< around grey 128

    /// A sample stands for a square of the patch: it is taken from the level blurred by about half its side.
    [[nodiscard]] static float level_scale(const Feature& f) { return 0.5f * spacing(f); }

    void describe(const ScaleSpace& space, const Feature& f, std::span<std::uint8_t, dimension> out) const {
        const LevelIndex at = space.nearest_level(level_scale(f));
        const ImageView<const float> image = space.level(at.octave, at.level);
        const float pixels = 1 / space.step(at.octave);
        const float cosine = std::cos(f.angle) * spacing(f), sine = std::sin(f.angle) * spacing(f);
        std::array<float, dimension> values;
        float sum = 0;
        for (int row = 0; row < side; ++row)
            for (int column = 0; column < side; ++column) {
                const float u = float(column - side / 2), v = float(row - side / 2);
                const float value = sample_bilinear(image, (f.x + cosine * u - sine * v) * pixels,
                                                    (f.y + sine * u + cosine * v) * pixels);
                values[std::size_t(row) * side + std::size_t(column)] = value;
                sum += value;
            }
        const float mean = sum / float(dimension);
        float squares = 0;
        for (const float value : values) squares += (value - mean) * (value - mean);
        const float deviation = std::sqrt(squares / float(dimension));
        const float gain = deviation > 1e-5f ? 42 / deviation : 0;
        for (std::size_t i = 0; i < dimension; ++i)
            out[i] = std::uint8_t(std::clamp(128.5f + gain * (values[i] - mean), 0.0f, 255.0f));
    }

private:
    [[nodiscard]] static float spacing(const Feature& f) { return 2 * support_radius * f.scale / side; }
};

}  // namespace ism
