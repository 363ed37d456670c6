// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "toy/vec.hpp"

#include "ism/core/random.hpp"

namespace toy {

/// @brief The side view of a toy car in metres; the front is at −x.
struct CarShape {
    int kind = 0;  ///< 0 saloon, 1 hatchback, 2 van, 3 pickup, 4 sports, 5 beetle, 6 estate
    float length = 0.2f, width = 0.09f;
    float bottom = 0.015f, hood = 0.05f, belt = 0.055f, deck = 0.055f, roof = 0.085f;  ///< heights
    std::array<float, 4> cabin{};  ///< x of windscreen foot, roof front, roof rear, rear window foot
    float wheel_radius = 0.02f;
    float front_axle = 0, rear_axle = 0;  ///< x
    float softness = 0.01f;               ///< how round the roof line is, metres
    float corner = 6;                     ///< exponent of the plan and end curves; 2 = round
    float tumble = 0.15f;                 ///< how much the cabin narrows to the roof
    int side_windows = 2;

    /// @brief Height of the lower body's upper edge at x.
    [[nodiscard]] float body_top(float x) const {
        const float t = x / length;
        const float front = mix(hood, belt, smooth_step(-0.5f, cabin[0] / length, t));
        return mix(front, deck, smooth_step(cabin[2] / length, cabin[3] / length + 0.05f, t));
    }

    /// @brief Height of the cabin's upper edge at x; below the belt outside the cabin.
    [[nodiscard]] float cabin_top(float x) const {
        const float foot = body_top(x) - 0.004f;
        const float rise = foot + (roof - foot) * (x - cabin[0]) / (cabin[1] - cabin[0]);
        const float fall = foot + (roof - foot) * (cabin[3] - x) / (cabin[3] - cabin[2]);
        const auto soft_min = [this](float a, float b) {
            const float h = std::clamp(0.5f + 0.5f * (b - a) / softness, 0.0f, 1.0f);
            return mix(b, a, h) - softness * h * (1 - h);
        };
        const float middle = (cabin[1] + cabin[2]) / 2;
        const float crown = roof - 0.25f * (x - middle) * (x - middle) / length;
        return soft_min(soft_min(rise, fall), crown);
    }

    /// @brief How much of width and height is left at x: 1 in the middle, 0 at the bumpers.
    [[nodiscard]] float end_round(float x) const {
        const float t = std::min(1.0f, std::abs(2 * x / length));
        return std::pow(std::max(0.0f, 1 - std::pow(t, corner)), 1 / corner);
    }
};

/// @brief A car of the given kind with its own proportions.
[[nodiscard]] inline CarShape make_car_shape(int kind, ism::Random& random) {
    struct Proportions {
        float height, hood, belt, deck, a, b, c, d, wheel, front, rear, softness, corner;
        int windows;
    };
    static constexpr std::array<Proportions, 7> table{{
        {0.355f, 0.200f, 0.225f, 0.220f, -0.21f, -0.07f, 0.16f, 0.31f, 0.085f, -0.30f, 0.29f, 0.05f, 7, 2},
        {0.385f, 0.205f, 0.235f, 0.240f, -0.24f, -0.09f, 0.28f, 0.44f, 0.088f, -0.30f, 0.29f, 0.05f, 7, 2},
        {0.460f, 0.250f, 0.265f, 0.265f, -0.42f, -0.27f, 0.45f, 0.49f, 0.082f, -0.29f, 0.28f, 0.05f, 9, 3},
        {0.385f, 0.225f, 0.240f, 0.225f, -0.20f, -0.10f, 0.07f, 0.11f, 0.095f, -0.30f, 0.27f, 0.03f, 9, 1},
        {0.300f, 0.180f, 0.195f, 0.205f, -0.16f, 0.00f, 0.13f, 0.40f, 0.076f, -0.31f, 0.28f, 0.07f, 5, 1},
        {0.400f, 0.205f, 0.230f, 0.210f, -0.24f, -0.08f, 0.12f, 0.42f, 0.092f, -0.29f, 0.27f, 0.13f, 3, 2},
        {0.370f, 0.200f, 0.225f, 0.225f, -0.22f, -0.09f, 0.36f, 0.46f, 0.084f, -0.30f, 0.29f, 0.04f, 7, 3},
    }};
    const Proportions& p = table[std::size_t(kind) % table.size()];
    const auto vary = [&](float value, double share) {
        return value * float(random.uniform(1 - share, 1 + share));
    };
    CarShape shape;
    shape.kind = kind % int(table.size());
    const float l = float(random.uniform(0.19, 0.235));
    shape.length = l;
    shape.width = l * vary(0.44f, 0.06);
    shape.bottom = l * vary(0.065f, 0.15);
    shape.roof = l * vary(p.height, 0.05);
    shape.hood = l * vary(p.hood, 0.06);
    shape.belt = l * vary(p.belt, 0.05);
    shape.deck = l * vary(p.deck, 0.05);
    shape.cabin = {l * p.a, l * vary(p.b, 0.1), l * vary(p.c, 0.06), l * p.d};
    shape.wheel_radius = l * vary(p.wheel, 0.08);
    shape.front_axle = l * vary(p.front, 0.03);
    shape.rear_axle = l * vary(p.rear, 0.03);
    shape.softness = l * p.softness * float(random.uniform(0.7, 1.3));
    shape.corner = vary(p.corner, 0.15);
    shape.tumble = float(random.uniform(0.12, 0.24));
    shape.side_windows = p.windows;
    return shape;
}

}  // namespace toy
