// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "toy/clutter.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "toy/clutter_boxes.hpp"
#include "toy/decal.hpp"

namespace toy {

namespace {

using detail::any_colour;

/// A striped or spotted ball.
Model make_ball(ism::Random& random) {
    const float r = float(random.uniform(0.028, 0.055));
    const Vec first = any_colour(random),
              second = random.uniform() < 0.5 ? Vec{0.85f, 0.84f, 0.8f} : any_colour(random);
    const int kind = int(random.index(3));
    const Vec axis = normalised({float(random.normal()), float(random.normal()), float(random.normal())});
    const Vec side = normalised(cross(axis, Vec{0.3f, 0.5f, 0.8f})), other = cross(axis, side);
    const auto pattern = std::uint32_t(random.bits());
    Model model;
    model.add(ellipsoid({0, 0, r}, {r, r, r}, 40), [=](const Vec& p, const Vec&) {
        const Vec q = (p - Vec{0, 0, r}) * (1 / r);
        const float a = dot(q, axis),
                    turn = std::atan2(dot(q, side), dot(q, other)) / std::numbers::pi_v<float>;
        if (kind == 0)
            return Surface{std::abs(a) > 0.93f || floor_int((turn + 1) * 3) % 2 != 0 ? first : second, 0.6f};
        if (kind == 1) return Surface{std::abs(a) < 0.25f ? second : first, 0.6f};
        return Surface{motif(0, turn * 5, a * 3, pattern) != 0 ? first : second, 0.4f};
    });
    return model;
}

/// A tin with a label.
Model make_can(ism::Random& random) {
    const float r = float(random.uniform(0.026, 0.036)), h = float(random.uniform(0.07, 0.125));
    const Vec ground = any_colour(random), ink = any_colour(random), pale{0.85f, 0.84f, 0.8f};
    const auto pattern = std::uint32_t(random.bits());
    Model model;
    const std::array<Turned, 9> outline{{{0, 0},
                                         {r * 0.92f, 0},
                                         {r, 0.004f},
                                         {r, h - 0.006f},
                                         {r * 0.93f, h},
                                         {r * 0.93f, h},
                                         {r * 0.88f, h},
                                         {r * 0.86f, h - 0.003f},
                                         {0, h - 0.003f}}};
    model.add(lathe(outline, {}, 40), [=](const Vec& p, const Vec&) {
        const float t = p.z / h;
        if (t > 0.92f || t < 0.05f) return Surface{{0.5f, 0.5f, 0.52f}, 0.9f};
        const float u = std::atan2(p.y, p.x) / 3.14159f;
        if (t > 0.42f && t < 0.72f)
            return Surface{on_print(std::fmod(u + 2.2f, 1.0f), (0.72f - t) / 0.3f, 2, pattern) ? pale : ink,
                           0.5f};
        return Surface{motif(1, u, t * 7, pattern) != 0 && t < 0.4f ? pale : ground, 0.5f};
    });
    return model;
}

/// A plate with a printed rim.
Model make_plate(ism::Random& random) {
    const float r = float(random.uniform(0.07, 0.1));
    const Vec ground = random_hsv(random, {0, 0.1f, 0.93f}, {1, 0.1f, 0.93f}), ink = any_colour(random);
    const int kind = int(random.index(8));
    const auto pattern = std::uint32_t(random.bits());
    Model model;
    const std::array<Turned, 7> outline{{{r * 0.55f, 0},
                                         {r * 0.7f, 0.004f},
                                         {r, 0.016f},
                                         {r * 0.99f, 0.0185f},
                                         {r * 0.7f, 0.007f},
                                         {r * 0.6f, 0.005f},
                                         {0, 0.005f}}};
    model.add(lathe(outline, {}, 48), [=](const Vec& p, const Vec&) {
        const float q = std::sqrt(p.x * p.x + p.y * p.y) / r, turn = std::atan2(p.y, p.x) / 6.2831853f;
        if (q > 0.97f || std::abs(q - 0.68f) < 0.015f) return Surface{ink, 0.6f};
        if (q > 0.72f && motif(kind, turn * 24, q * 4, pattern) != 0) return Surface{ink, 0.6f};
        return Surface{ground, 0.6f};
    });
    return model;
}

/// A pot with leaves.
Model make_plant(ism::Random& random) {
    const float r = float(random.uniform(0.032, 0.045)), h = r * float(random.uniform(1.5, 1.9));
    const Vec clay = random.uniform() < 0.6 ? Vec{0.45f, 0.17f, 0.08f} : any_colour(random);
    const Vec leaf = random_hsv(random, {0.24f, 0.55f, 0.4f}, {0.38f, 0.85f, 0.65f});
    Model model;
    const std::array<Turned, 9> outline{{{0, 0},
                                         {r * 0.7f, 0},
                                         {r * 0.7f, 0},
                                         {r * 0.93f, h * 0.75f},
                                         {r * 0.93f, h * 0.75f},
                                         {r, h * 0.77f},
                                         {r, h},
                                         {r * 0.85f, h},
                                         {0, h * 0.85f}}};
    const auto pattern = std::uint32_t(random.bits());
    model.add(lathe(outline, {}, 32), [=](const Vec& p, const Vec& n) {
        if (n.z > 0.6f && p.z > h * 0.8f)
            return Surface{Vec{0.07f, 0.045f, 0.03f} * (0.5f + value_noise(p.x * 500, p.y * 500, pattern)),
                           0};
        return Surface{clay * (0.85f + 0.3f * cloud_noise(p.x * 120, p.z * 120, pattern, 2)), 0.15f};
    });
    const int count = 12 + int(random.index(8));
    for (int i = 0; i < count; ++i) {
        const float turn = float(i) * 2.4f + float(random.uniform(-0.3, 0.3)),
                    lift = float(random.uniform(0.4, 1.35));
        const float long_m = float(random.uniform(0.04, 0.085)),
                    wide = long_m * float(random.uniform(0.16, 0.26));
        const Vec out{std::cos(turn), std::sin(turn), 0}, across{-std::sin(turn), std::cos(turn), 0};
        const Vec root{0, 0, h * 0.85f}, colour = leaf * float(random.uniform(0.7, 1.3));
        model.add(surface(6, 10, false,
                          [=](float u, float v) {
                              const float side = 2 * u - 1,
                                          w = wide * std::pow(std::sin(3.14159f * std::pow(v, 0.75f)), 0.8f);
                              const float rise = v * std::sin(lift) - 0.5f * v * v * std::cos(lift);
                              return root + out * (long_m * v * (0.25f + std::cos(lift))) +
                                     across * (side * w) +
                                     Vec{0, 0, long_m * rise * 1.5f + std::abs(side) * w * 0.3f};
                          }),
                  [=](const Vec& p, const Vec&) {
                      const Vec q = p - root;
                      const float side = dot(q, across), along = dot(q, out);
                      const float vein = (along - 1.5f * std::abs(side)) * 220;
                      const bool line = std::abs(side) < 0.0011f || vein - std::floor(vein) < 0.18f;
                      return Surface{line ? colour * 1.7f : colour, 0.3f};
                  });
    }
    return model;
}

}  // namespace

Model make_clutter(int kind, std::uint64_t seed) {
    ism::Random random(seed);
    switch (kind % clutter_kinds) {
        case 0:
            return finished(detail::make_blocks(random));
        case 1:
            return finished(make_ball(random));
        case 2:
            return finished(make_can(random));
        case 3:
            return finished(detail::make_carton(random));
        case 4:
            return finished(detail::make_books(random));
        case 5:
            return finished(make_plate(random));
        default:
            return finished(make_plant(random));
    }
}

}  // namespace toy
