// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "toy/mug.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "toy/decal.hpp"

namespace toy {

Model make_mug(int instance, std::uint64_t seed) {
    ism::Random random(seed);
    const float height = float(random.uniform(0.115, 0.14)),
                radius = height * float(random.uniform(0.38, 0.46));
    const float flare = float(random.uniform(0.85, 1.1)), foot = radius * flare;
    const float belly = float(random.uniform(-0.03, 0.07)) * radius;
    const float hue = float(random.uniform()), wall = 0.004f;
    const bool pale = random.uniform() < 0.6;
    const Vec ground = pale ? hsv(hue, 0.12f, 0.94f) : hsv(hue, 0.8f, float(random.uniform(0.5, 0.85)));
    const Vec ink = pale ? random_hsv(random, {0, 0.9f, 0.45f}, {1, 0.9f, 0.85f}) : Vec{0.85f, 0.83f, 0.76f};
    const Vec ink2 = hsv(float(random.uniform()), 0.85f, 0.8f);
    const int kind = instance;
    const auto pattern = std::uint32_t(random.bits());
    const bool two_tone = random.uniform() < 0.4;
    const float cells = std::floor(float(random.uniform(8, 13)));
    const float pi = std::numbers::pi_v<float>;
    const auto outside = [=](float t) { return mix(foot, radius, t) + belly * std::sin(pi * t); };

    Model model;
    std::array<Turned, 24> outline{};
    std::size_t at = 0;
    outline[at++] = {0.0f, 0.001f};
    outline[at++] = {foot * 0.93f, 0.0f};
    for (int i = 0; i <= 10; ++i)
        outline[at++] = {outside(float(i) / 10), 0.004f + (height - 0.006f) * float(i) / 10};
    outline[at++] = {radius - wall * 0.5f, height};
    for (int i = 10; i >= 1; --i)
        outline[at++] = {outside(float(i) / 10) - wall, height * float(i) / 10 - 0.002f};
    model.add(lathe(std::span(outline).first(at), {}, 48), [=](const Vec& p, const Vec& n) {
        const float r = std::sqrt(p.x * p.x + p.y * p.y), t = p.z / height;
        const bool inner = n.x * p.x + n.y * p.y < 0 || r < outside(t) - wall * 0.7f;
        if (inner) return Surface{two_tone ? ink : mix(ground, Vec{0.85f, 0.85f, 0.83f}, 0.5f), 0.5f};
        if (t > 0.965f || std::abs(t - 0.9f) < 0.012f || std::abs(t - 0.1f) < 0.012f)
            return Surface{ink, 0.6f};
        if (t < 0.13f || t > 0.87f) return Surface{ground, 0.6f};
        const float u = std::atan2(p.y, p.x) / (2 * pi) * cells,
                    v = (t - 0.13f) * height / (2 * pi * radius) * cells;
        const int colour = motif(kind, u, v, pattern);
        return Surface{colour == 0 ? ground : colour == 1 ? ink : ink2, 0.6f};
    });
    const float reach = radius * float(random.uniform(0.72, 0.95)),
                thick = height * float(random.uniform(0.055, 0.075));
    const float square = float(random.uniform(2.0, 3.5));
    model.add(tube(
                  14, 26,
                  [&](float t) {
                      const float a = pi * (t - 0.5f);
                      const auto bulge = [&](float c) {
                          return std::copysign(std::pow(std::abs(c), 2 / square), c);
                      };
                      return Vec{radius * std::min(1.0f, flare) * 0.93f + reach * bulge(std::cos(a)), 0.0f,
                                 height * (0.52f + 0.31f * bulge(std::sin(a)))};
                  },
                  [&](float t) { return thick * (1.0f + 0.25f * std::abs(2 * t - 1)); }),
              plain(two_tone ? ink : ground, 0.6f));
    return finished(std::move(model));
}

}  // namespace toy
