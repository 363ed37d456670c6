// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "toy/robot.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "toy/decal.hpp"

namespace toy {

Model make_robot(int instance, std::uint64_t seed) {
    ism::Random random(seed);
    const auto vary = [&](double low, double high) { return float(random.uniform(low, high)); };
    const float size = vary(0.20, 0.25);
    const float hue = vary(0, 1);
    const Vec tin = random.uniform() < 0.35 ? Vec{0.42f, 0.44f, 0.46f}
                                            : random_hsv(random, {hue, 0.3f, 0.5f}, {hue, 0.85f, 0.85f});
    const Vec second = random_hsv(random, {hue + 0.3f, 0.5f, 0.5f}, {hue + 0.7f, 0.9f, 0.9f});
    const Vec dark{0.02f, 0.02f, 0.025f}, pale{0.85f, 0.84f, 0.8f}, lamp = hsv(vary(0, 1), 0.75f, 0.98f);
    const float chest_x = vary(0.19, 0.23) * size, chest_z = vary(0.19, 0.22) * size,
                hip = vary(0.22, 0.26) * size;
    const float head_x = vary(0.13, 0.18) * size, head_z = vary(0.115, 0.14) * size, deep = 0.13f * size;
    const float chest_at = hip + chest_z, head_at = hip + 2 * chest_z + 0.035f * size + head_z;
    const int panel = instance % 4, eyes = int(random.index(3)), mouth = int(random.index(3));
    const auto pattern = std::uint32_t(random.bits());

    Model model;
    model.add(rounded_box({0, 0, chest_at}, {chest_x, deep, chest_z}, 0.03f * size), [=](const Vec& p,
                                                                                         const Vec& n) {
        const float u = p.x / chest_x, v = (p.z - chest_at) / chest_z;
        if (n.y > -0.6f) return Surface{std::abs(v) > 0.9f ? second : tin, 0.6f};
        // Rivets in the corners, a framed panel of one of four kinds.
        const float rx = std::abs(u) - 0.86f, rz = std::abs(v) - 0.86f;
        if (rx * rx + rz * rz < 0.004f) return Surface{tin * 0.35f, 0.6f};
        if (std::abs(u) > 0.74f || std::abs(v) > 0.74f) return Surface{tin, 0.6f};
        if (std::abs(u) > 0.66f || std::abs(v) > 0.66f) return Surface{second, 0.6f};
        const float a = u / 0.66f, b = v / 0.66f;
        if (b < -0.1f) {
            const float cell_x = (a + 1) * 2, cell_z = (b + 1) / 0.9f * 2;
            const int i = floor_int(cell_x), j = floor_int(cell_z);
            const float x = cell_x - float(i) - 0.5f, z = cell_z - float(j) - 0.5f;
            const bool on = panel % 2 == 0 ? x * x + z * z < 0.1f : std::max(std::abs(x), std::abs(z)) < 0.3f;
            return Surface{on ? hsv(hash_unit(i, j, pattern), 0.85f, 0.95f) : dark, 0.5f};
        }
        if (panel < 2) {  // a dial
            const float x = a, z = (b - 0.1f), r = x * x + z * z;
            if (z > 0 && r < 0.64f) {
                const float angle = std::atan2(z, x) * 12 / 3.14159f;
                if (r > 0.42f && angle - std::floor(angle) < 0.4f) return Surface{dark, 0.3f};
                if (std::abs(x - z * (panel == 0 ? 0.6f : -0.4f)) < 0.07f)
                    return Surface{{0.7f, 0.02f, 0.02f}, 0.3f};
                return Surface{pale, 0.4f};
            }
            return Surface{dark, 0.5f};
        }
        if (panel == 2) {  // a screen with a curve
            const float curve = 0.4f + 0.22f * std::sin(a * 7) * std::cos(a * 3);
            return Surface{std::abs(b - curve) < 0.09f ? Vec{0.1f, 0.9f, 0.25f} : Vec{0.01f, 0.08f, 0.04f},
                           0.7f};
        }
        return Surface{floor_int(b * 9) % 2 != 0 ? tin * 0.5f : dark, 0.6f};  // a grille
    });
    model.add(rounded_box({0, 0, head_at}, {head_x, deep * 0.85f, head_z}, 0.03f * size), [=](const Vec& p,
                                                                                              const Vec& n) {
        const float u = p.x / head_x, v = (p.z - head_at) / head_z;
        if (n.y > -0.6f) return Surface{std::abs(v + 0.1f) < 0.12f ? second : tin, 0.6f};
        const float ex = (std::abs(u) - 0.45f) * head_x / (0.05f * size),
                    ez = (v - 0.22f) * head_z / (0.05f * size);
        const float r = eyes == 1 ? std::max(ex * ex, ez * ez) : ex * ex + ez * ez;
        if (r < 0.16f) return Surface{dark, 0.9f};
        if (r < 0.62f) return Surface{eyes == 2 ? lamp : pale, 0.8f};
        if (r < 1.0f) return Surface{dark, 0.6f};
        if (v < -0.32f && v > -0.78f && std::abs(u) < 0.62f) {
            if (mouth == 0) return Surface{floor_int((u + 1) * 9) % 2 != 0 ? pale : dark, 0.5f};
            if (mouth == 1) return Surface{std::abs(v + 0.55f) < 0.08f ? dark : second, 0.5f};
            return Surface{floor_int((u + 1) * 6) % 2 != floor_int((v + 1) * 9) % 2 ? dark : second, 0.5f};
        }
        return Surface{tin, 0.6f};
    });
    const auto limb = [&](Vec from, Vec to, float radius) {
        const int rings = 9;
        model.add(tube(
                      14, 27, [=](float t) { return mix(from, to, t); },
                      [=](float t) {
                          return radius *
                                 (0.85f + 0.15f * std::cos(t * float(rings) * 2 * std::numbers::pi_v<float>));
                      }),
                  [=](const Vec& p, const Vec&) {
                      const float t = dot(p - from, to - from) / dot(to - from, to - from) * float(rings);
                      return Surface{t - std::floor(t) < 0.5f ? second : second * 0.35f, 0.3f};
                  });
    };
    const float spread = vary(0.02, 0.1) * size, leg = chest_x * 0.52f;
    for (const float side : {-1.0f, 1.0f}) {
        const Vec shoulder{side * (chest_x - 0.005f), 0, chest_at + chest_z * 0.6f};
        const Vec hand{side * (chest_x + 0.05f * size + spread), -0.03f * size,
                       chest_at - chest_z * vary(0.5, 0.9)};
        limb(shoulder, hand, 0.034f * size);
        model.add(ellipsoid(shoulder, Vec{1, 1, 1} * (0.05f * size), 16), plain(tin, 0.7f));
        model.add(ellipsoid(hand, Vec{1, 1, 1} * (0.048f * size), 16), plain(tin, 0.7f));
        limb({side * leg, 0, hip + 0.01f}, {side * leg, 0, 0.04f * size}, 0.045f * size);
        model.add(rounded_box({side * leg, -0.04f * size, 0.04f * size},
                              {0.075f * size, 0.13f * size, 0.04f * size}, 0.02f * size),
                  [=](const Vec& p, const Vec& n) {
                      return Surface{n.z < 0.5f && p.z < 0.025f * size ? dark : tin, 0.6f};
                  });
    }
    model.add(
        ellipsoid({0, 0, hip + 2 * chest_z + 0.015f * size}, {0.05f * size, 0.05f * size, 0.05f * size}, 16),
        plain(second, 0.4f));
    const float top = head_at + head_z, aerial = vary(0.05, 0.11) * size;
    limb({0, 0, top - 0.005f}, {0, 0, top + aerial}, 0.012f * size);
    model.add(ellipsoid({0, 0, top + aerial}, Vec{1, 1, 1} * (0.032f * size), 16), plain(lamp, 0.8f));
    return finished(std::move(model));
}

}  // namespace toy
