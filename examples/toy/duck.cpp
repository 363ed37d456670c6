// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "toy/duck.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "toy/decal.hpp"

namespace toy {

Model make_duck(int instance, std::uint64_t seed) {
    ism::Random random(seed);
    const float size = float(random.uniform(0.15, 0.19)), pi = std::numbers::pi_v<float>;
    const float plump = float(random.uniform(0.9, 1.1)), big_head = float(random.uniform(0.92, 1.12));
    const bool yellow = random.uniform() < 0.6;
    const Vec body = yellow ? hsv(float(random.uniform(0.125, 0.16)), 0.9f, 0.95f)
                            : random_hsv(random, {0, 0.35f, 0.92f}, {1, 0.8f, 0.92f});
    const Vec beak = hsv(float(random.uniform(0.02, 0.085)), 0.93f, 0.95f);
    const Vec dress = hsv(float(random.uniform()), 0.85f, 0.75f), pale{0.85f, 0.84f, 0.8f},
              dark{0.012f, 0.012f, 0.016f};
    const int costume = instance % 5;  // 0 nothing, 1 scarf, 2 sailor, 3 spots, 4 cap
    const auto pattern = std::uint32_t(random.bits());
    const Vec trunk{0.02f * size, 0, 0.25f * size}, half{0.44f * size, 0.31f * size * plump, 0.26f * size};
    const Vec head{-0.23f * size, 0, 0.62f * size};
    const float skull = 0.215f * size * big_head;

    Model model;
    model.add(surface(36, 30, true,
                      [&](float u, float v) {
                          const float a = 2 * pi * u, b = pi * v;
                          Vec q{-std::cos(b), std::sin(b) * std::cos(a), std::sin(b) * std::sin(a)};
                          const float tail = smooth_step(0.35f, 1.0f, q.x);
                          q.y *= 1 - 0.45f * tail;
                          q.z = std::max(q.z * (1 - 0.35f * tail), -0.9f) + 0.85f * tail * tail;
                          return trunk + half * q;
                      }),
              [=](const Vec& p, const Vec&) {
                  const float water = p.z / size;
                  const float dx = (p.x - 0.10f * size) / (0.26f * size),
                              dz = (p.z - 0.30f * size - 0.25f * (p.x - 0.1f * size)) / (0.135f * size);
                  const float r = dx * dx + dz * dz;
                  if (std::abs(p.y) > 0.12f * size && r < 1) {
                      // Wing: outline and three rows of feathers.
                      const float scallop = dx * 2.6f + 0.22f * std::abs(std::sin(dz * 5.0f));
                      if (r > 0.84f) return Surface{body * 0.4f, 0.5f};
                      if (dx > -0.35f && scallop - std::floor(scallop) < 0.16f)
                          return Surface{body * 0.42f, 0.5f};
                      return Surface{costume == 2 ? dress : body * 0.94f, 0.5f};
                  }
                  if (costume == 2 && water > 0.17f && water < 0.44f && p.x < 0.3f * size)
                      return Surface{floor_int(water * 30) % 2 != 0 ? pale : dress, 0.45f};
                  if (costume == 3 && motif(0, p.x / size * 9, p.z / size * 9, pattern) != 0)
                      return Surface{dress, 0.5f};
                  return Surface{water < 0.08f ? body * 0.8f : body, 0.5f};
              });
    model.add(ellipsoid(head, {skull, skull * 0.93f, skull * 0.97f}, 36), [=](const Vec& p, const Vec&) {
        const Vec q = (p - head) * (1 / skull);
        const float dx = q.x + 0.42f, dz = q.z - 0.25f, r = dx * dx + dz * dz * 0.7f;
        if (std::abs(q.y) > 0.3f) {
            if ((dx + 0.05f) * (dx + 0.05f) + (dz - 0.09f) * (dz - 0.09f) < 0.006f)
                return Surface{pale, 0.8f};
            if (r < 0.042f) return Surface{dark, 0.9f};
            if (r < 0.10f) return Surface{pale, 0.7f};
            if (r < 0.125f) return Surface{body * 0.25f, 0.5f};
            const float cx = q.x + 0.3f, cz = q.z + 0.35f;
            if (cx * cx + cz * cz < 0.035f) return Surface{mix(body, Vec{0.9f, 0.25f, 0.2f}, 0.6f), 0.5f};
        }
        if (costume == 4 && q.z > 0.5f) return Surface{std::abs(q.z - 0.56f) < 0.07f ? pale : dress, 0.3f};
        return Surface{body, 0.5f};
    });
    const Vec tip{head.x - skull * 1.12f, 0, head.z - skull * 0.12f};
    for (const float lip : {1.0f, -1.0f})
        model.add(
            surface(20, 16, true,
                    [&](float u, float v) {
                        const float a = 2 * pi * u, b = pi * v;
                        const Vec q{-std::cos(b), std::sin(b) * std::cos(a), std::sin(b) * std::sin(a)};
                        const float curl = lip > 0 ? 0.22f * q.x * q.x : -0.05f;
                        return tip + skull * Vec{0.5f * q.x, 0.46f * q.y, 0.13f * q.z + lip * 0.10f + curl};
                    }),
            [=](const Vec& p, const Vec&) {
                const bool nostril = lip > 0 && std::abs(p.x - tip.x - 0.05f * skull) < 0.06f * skull &&
                                     std::abs(std::abs(p.y) - 0.2f * skull) < 0.07f * skull;
                return Surface{nostril ? beak * 0.2f : lip > 0 ? beak : beak * 0.7f, 0.6f};
            });
    if (costume == 1 || costume == 2)
        model.add(tube(
                      12, 36,
                      [&](float t) {
                          const float a = 2 * pi * t;
                          return Vec{head.x + 0.03f * size, 0, head.z - skull * 0.86f} +
                                 Vec{0.19f * size * std::cos(a), 0.19f * size * std::sin(a),
                                     0.02f * size * std::cos(a)};
                      },
                      [&](float) { return 0.038f * size; }),
                  [=](const Vec& p, const Vec&) {
                      const bool odd = floor_int(std::atan2(p.y, p.x - head.x) * 5) % 2 != 0;
                      return Surface{costume == 1 && odd ? pale : dress, 0.15f};
                  });
    if (costume == 4)
        model.add(ellipsoid({head.x - skull * 0.75f, 0, head.z + skull * 0.52f},
                            {0.6f * skull, 0.55f * skull, 0.07f * skull}),
                  plain(dress, 0.3f));
    return finished(std::move(model));
}

}  // namespace toy
