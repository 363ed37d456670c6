// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "toy/car.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "toy/car_paint.hpp"

namespace toy {

Model make_car(int instance, std::uint64_t seed) {
    ism::Random random(seed);
    const CarShape s = make_car_shape(instance, random);
    CarLivery l;
    const float hue = float(random.uniform()), dice = float(random.uniform());
    l.paint = dice < 0.12f  ? Vec{0.80f, 0.80f, 0.77f}
              : dice < 0.2f ? Vec{0.33f, 0.35f, 0.38f}
                            : random_hsv(random, {hue, 0.65f, 0.55f}, {hue, 0.98f, 0.95f});
    l.second = random.uniform() < 0.5 ? Vec{0.85f, 0.84f, 0.8f}
                                      : hsv(hue + float(random.uniform(0.3, 0.7)), 0.85f, 0.9f);
    l.scheme = (instance + int(random.index(3)) * 3) % 8, l.number = 1 + int(random.index(98)),
    l.spokes = 4 + int(random.index(4));
    l.rim = random.uniform() < 0.75 ? Vec{0.6f, 0.61f, 0.63f} : l.second;
    l.seed = std::uint32_t(random.bits());

    const float pi = std::numbers::pi_v<float>;
    const auto bulge = [](float c, float n) { return std::copysign(std::pow(std::abs(c), 2 / n), c); };
    Model model;
    model.add(surface(44, 44, true,
                      [&](float u, float v) {
                          const float x = -std::cos(pi * v) * s.length / 2, end = s.end_round(x);
                          const float top = s.body_top(x), middle = mix(s.bottom, top, 0.46f);
                          const float a = 2 * pi * u, y = bulge(std::cos(a), 6.0f),
                                      z = bulge(std::sin(a), 5.0f);
                          const float waist = 1 - 0.05f * (z > 0 ? z * z : 0.0f);
                          return Vec{x, y * waist * s.width / 2 * (0.25f + 0.75f * end),
                                     middle + z * end * (z > 0 ? top - middle : middle - s.bottom)};
                      }),
              [=](const Vec& p, const Vec& n) { return detail::lower_body(s, l, p, n); });
    model.add(
        surface(30, 40, false,
                [&](float u, float v) {
                    const float x = mix(s.cabin[0] - 0.01f * s.length, s.cabin[3] + 0.01f * s.length, v);
                    const float foot = s.body_top(x) - 0.02f, top = std::max(foot + 0.001f, s.cabin_top(x));
                    const float y = bulge(std::cos(pi * u), 4.5f), z = bulge(std::sin(pi * u), 4.5f);
                    const float height = foot + z * (top - foot);
                    const float narrow = 1 - s.tumble * std::max(0.0f, (height - s.belt) / (s.roof - s.belt));
                    return Vec{x, y * s.width * 0.475f * narrow * std::max(s.end_round(x), 0.4f), height};
                }),
        [=](const Vec& p, const Vec& n) { return detail::cabin(s, l, p, n); });
    for (const float axle : {s.front_axle, s.rear_axle})
        for (const float side : {-1.0f, 1.0f}) {
            const float r = s.wheel_radius, outer = s.width * 0.5f + 0.003f;
            const std::array<Turned, 10> outline{{{0.02f * r, outer - 0.001f},
                                                  {0.15f * r, outer},
                                                  {0.2f * r, outer - 0.003f},
                                                  {0.58f * r, outer - 0.004f},
                                                  {0.66f * r, outer},
                                                  {0.66f * r, outer},
                                                  {0.9f * r, outer},
                                                  {r, outer - 0.003f},
                                                  {r, outer - 0.022f},
                                                  {0.5f * r, outer - 0.024f}}};
            model.add(surface(28, 9, true,
                              [&](float u, float v) {
                                  const Turned at = outline[std::size_t(v * 9 + 0.5f)];
                                  const float a = 2 * pi * u;
                                  return Vec{axle + at.radius * std::cos(a), side * at.height,
                                             r + at.radius * std::sin(a)};
                              }),
                      [=](const Vec& p, const Vec&) { return detail::wheel(s, l, axle, p); });
        }
    return finished(std::move(model));
}

}  // namespace toy
