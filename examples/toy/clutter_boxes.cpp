// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "toy/clutter_boxes.hpp"

#include <cstdint>
#include <utility>

#include "toy/decal.hpp"

namespace toy {

namespace detail {

Vec any_colour(ism::Random& random) {
    return random_hsv(random, {0, 0.35f, 0.35f}, {1, 0.9f, 0.9f});
}

Model make_books(ism::Random& random) {
    Model model;
    float base = 0;
    const int count = 1 + int(random.index(3));
    for (int i = 0; i < count; ++i) {
        const Vec half{float(random.uniform(0.075, 0.11)), float(random.uniform(0.055, 0.075)),
                       float(random.uniform(0.009, 0.02))};
        const Vec at{float(random.uniform(-0.01, 0.01)), float(random.uniform(-0.01, 0.01)), base + half.z};
        const Vec cover = any_colour(random), ink = hsv(float(random.uniform()), 0.3f, 0.95f);
        const auto pattern = std::uint32_t(random.bits());
        model.add(rounded_box(at, half, 0.002f), [=](const Vec& p, const Vec& n) {
            const Vec q = p - at;
            if (n.z > 0.7f) {
                const float u = q.x / half.x, v = q.y / half.y;
                if (std::max(std::abs(u), std::abs(v)) > 0.86f && std::max(std::abs(u), std::abs(v)) < 0.9f)
                    return Surface{ink, 0.4f};
                if (on_print(u * 0.6f + 0.5f, 0.9f - v, 5, pattern)) return Surface{ink, 0.4f};
                if (on_star(u * 1.6f - 0.5f, v * 1.6f + 0.6f, 7)) return Surface{ink * 0.7f, 0.4f};
                return Surface{cover, 0.4f};
            }
            if (n.y < -0.7f) {  // the back with its title
                if (std::abs(std::abs(q.x / half.x) - 0.85f) < 0.03f) return Surface{ink, 0.4f};
                if (on_print(q.x / half.x * 0.7f + 0.5f, 0.5f - q.z / half.z * 0.4f, 1, pattern))
                    return Surface{ink, 0.4f};
                return Surface{cover, 0.4f};
            }
            if (std::abs(q.z) > half.z - 0.003f) return Surface{cover, 0.4f};
            return Surface{Vec{0.75f, 0.7f, 0.6f} * (0.75f + 0.25f * value_noise(q.z * 1500, 0, pattern)),
                           0.05f};
        });
        base += 2 * half.z;
    }
    return model;
}

Model make_carton(ism::Random& random) {
    const bool tall = random.uniform() < 0.6;
    const Vec half = tall ? Vec{float(random.uniform(0.045, 0.07)), float(random.uniform(0.02, 0.03)),
                                float(random.uniform(0.07, 0.1))}
                          : Vec{float(random.uniform(0.06, 0.09)), float(random.uniform(0.035, 0.05)),
                                float(random.uniform(0.02, 0.035))};
    const Vec ground = any_colour(random), ink = any_colour(random), pale{0.84f, 0.82f, 0.76f};
    const auto pattern = std::uint32_t(random.bits());
    const int kind = int(random.index(8));
    Model model;
    model.add(rounded_box({0, 0, half.z}, half, 0.0015f), [=](const Vec& p, const Vec& n) {
        const float across = std::abs(n.x) > 0.7f ? p.y : p.x;
        const float up = std::abs(n.z) > 0.7f ? p.y + half.y : p.z;
        const float height = std::abs(n.z) > 0.7f ? 2 * half.y : 2 * half.z,
                    wide = std::abs(n.x) > 0.7f ? half.y : half.x;
        const float u = across / wide, v = up / height;
        if (v > 0.66f && v < 0.88f && std::abs(u) < 0.85f)
            return Surface{on_print(u * 0.55f + 0.5f, (0.88f - v) / 0.22f, 2, pattern) ? ink : pale, 0.3f};
        if (v < 0.14f || v > 0.94f) return Surface{ink, 0.3f};
        const int colour = motif(kind, across / 0.024f, up / 0.024f, pattern);
        return Surface{colour == 0 ? ground : colour == 1 ? pale : ink, 0.3f};
    });
    return model;
}

Model make_blocks(ism::Random& random) {
    Model model;
    const int count = 1 + int(random.index(3));
    float base = 0;
    for (int i = 0; i < count; ++i) {
        const float h = float(random.uniform(0.02, 0.028));
        const Vec at{float(random.uniform(-0.006, 0.006)), float(random.uniform(-0.006, 0.006)), base + h};
        const Vec wood = mix(Vec{0.62f, 0.42f, 0.22f}, any_colour(random), 0.35f), ink = any_colour(random);
        const int digit = int(random.index(10));
        const auto pattern = std::uint32_t(random.bits());
        model.add(rounded_box(at, {h, h, h}, 0.003f), [=](const Vec& p, const Vec& n) {
            const Vec q = (p - at) * (1 / h);
            const float u = std::abs(n.x) > 0.6f ? q.y : q.x, v = std::abs(n.z) > 0.6f ? q.y : q.z;
            const float rim = std::max(std::abs(u), std::abs(v));
            if (rim > 0.68f && rim < 0.82f) return Surface{ink, 0.2f};
            if (on_digit(digit, u * 0.9f + 0.5f, v * 0.8f + 0.5f)) return Surface{ink, 0.2f};
            return Surface{wood * (0.8f + 0.3f * value_noise(u * 2, v * 14, pattern)), 0.15f};
        });
        base += 2 * h;
    }
    return model;
}

}  // namespace detail

}  // namespace toy
