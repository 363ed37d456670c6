// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "toy/room.hpp"

#include <array>
#include <cmath>

#include "toy/decal.hpp"

namespace toy {

Room make_room(ism::Random& random, bool busy) {
    static constexpr std::array<Vec, 5> woods{{{0.42f, 0.24f, 0.11f},
                                               {0.55f, 0.36f, 0.19f},
                                               {0.30f, 0.16f, 0.08f},
                                               {0.62f, 0.47f, 0.30f},
                                               {0.38f, 0.27f, 0.18f}}};
    static constexpr std::array<int, 8> tables{0, 0, 0, 1, 2, 2, 3, 4};  // wood most often
    Room room;
    room.wall_y = float(random.uniform(1.9, 2.6));
    room.seed = std::uint32_t(random.bits());
    room.table = busy ? tables[random.index(tables.size())] : 5;
    room.wall = busy ? int(random.index(4)) : 0;
    room.turn = float(random.uniform(-0.5, 0.5));
    room.table_colour = room.table == 0 ? woods[random.index(woods.size())]
                                        : random_hsv(random, {0, 0.08f, 0.55f}, {1, 0.36f, 0.85f});
    room.table_second = random_hsv(random, {0, 0.02f, 0.75f}, {1, 0.15f, 0.92f});
    room.wall_colour = random_hsv(random, {0, 0.05f, 0.6f}, {1, 0.35f, 0.85f});
    room.wall_second = room.wall_colour * float(random.uniform(0.6, 0.85));
    if (!busy) room.table_colour = random_hsv(random, {0, 0.02f, 0.6f}, {1, 0.25f, 0.82f});
    return room;
}

Surface table_surface(const Room& room, Vec p, float blur_m) {
    const float c = std::cos(room.turn), s = std::sin(room.turn);
    const float u = c * p.x + s * p.y, v = c * p.y - s * p.x;
    const Vec base = room.table_colour;
    const auto band = [blur_m](float distance) {
        return std::clamp(0.5f - distance / (blur_m + 1e-5f), 0.0f, 1.0f);
    };
    const auto stripe = [](float x, float period) {
        return std::abs(x / period - std::floor(x / period) - 0.5f) * 2;
    };
    switch (room.table) {
        case 0: {
            const float wide = 0.11f;
            const int plank = floor_int(v / wide);
            const float from_edge = std::min(v - float(plank) * wide, float(plank + 1) * wide - v);
            const float shift = hash_unit(plank, 1, room.seed) * 9,
                        tone = 0.78f + 0.35f * hash_unit(plank, 2, room.seed);
            const float rings = cloud_noise(u * 2.2f + shift, v * 26 + shift, room.seed, 3);
            const float grain = value_noise(u * 14 + shift, v * 420, room.seed + 9u);
            const float line = std::abs(rings * 9 - std::floor(rings * 9) - 0.5f) * 2;
            return {base * (tone * (0.66f + 0.32f * line + 0.2f * grain) *
                            (1 - 0.75f * band(from_edge - 0.0012f))),
                    0.22f};
        }
        case 1: {
            const float a = band((stripe(u, 0.05f) - 0.5f) * 0.025f),
                        b = band((stripe(v, 0.05f) - 0.5f) * 0.025f);
            const float weave = 0.93f + 0.07f * value_noise(u * 500, v * 500, room.seed);
            return {mix(room.table_second, base * 0.8f, (a + b) * 0.5f) * weave, 0.0f};
        }
        case 2: {
            const float weave = 0.8f + 0.2f * value_noise(u * 260, v * 60, room.seed) +
                                0.2f * value_noise(u * 60, v * 260, room.seed + 3u);
            return {base * (weave * (0.75f + 0.3f * cloud_noise(u * 6, v * 6, room.seed + 5u, 2))), 0.0f};
        }
        case 3: {
            const float speck = value_noise(u * 210, v * 210, room.seed),
                        cloud = cloud_noise(u * 9, v * 9, room.seed + 2u, 3);
            const Vec stone = mix(base, room.table_second, 0.35f + 0.4f * cloud);
            return {speck > 0.78f   ? stone * 0.62f
                    : speck < 0.17f ? mix(stone, Vec{0.9f, 0.9f, 0.88f}, 0.3f)
                                    : stone,
                    0.3f};
        }
        case 4: {
            const float a = band((stripe(u, 0.09f) - 0.4f) * 0.045f),
                        b = band((std::abs(stripe(u, 0.09f) - 0.7f) - 0.06f) * 0.045f);
            const float weave = 0.88f + 0.12f * value_noise(u * 420, v * 420, room.seed);
            return {mix(mix(room.table_second, base, a), base * 0.35f, b) * weave, 0.0f};
        }
        default:
            return {base * (0.86f + 0.14f * cloud_noise(u * 7, v * 7, room.seed, 3) +
                            0.05f * value_noise(u * 300, v * 300, room.seed + 4u)),
                    0.05f};
    }
}

Surface wall_surface(const Room& room, Vec p, float blur_m) {
    const Vec base = room.wall_colour, second = room.wall_second;
    const auto band = [blur_m](float distance) {
        return std::clamp(0.5f - distance / (blur_m + 1e-5f), 0.0f, 1.0f);
    };
    const float rough = 0.92f + 0.12f * cloud_noise(p.x * 9, p.z * 9, room.seed + 20u, 3);
    if (p.z < 0.09f && p.z > 0)
        return {Vec{0.8f, 0.8f, 0.78f} * (1 - 0.6f * band(std::abs(p.z - 0.075f) - 0.003f)), 0.2f};
    switch (room.wall) {
        case 1: {
            const float t = p.x / 0.16f - std::floor(p.x / 0.16f);
            return {mix(base, second, band((std::abs(t - 0.5f) - 0.22f) * 0.16f)) * rough, 0};
        }
        case 2:
            return {
                (motif(int(room.seed % 8), p.x / 0.09f, p.z / 0.09f, room.seed) != 0 ? second : base) * rough,
                0};
        case 3: {
            const float high = 0.065f, wide = 0.21f;
            const int row = floor_int(p.z / high);
            const float x = p.x + (row % 2 != 0 ? wide / 2 : 0.0f);
            const int column = floor_int(x / wide);
            const float edge = std::min({p.z - float(row) * high, float(row + 1) * high - p.z,
                                         x - float(column) * wide, float(column + 1) * wide - x});
            const Vec brick =
                mix(Vec{0.42f, 0.16f, 0.09f}, base, 0.3f) * (0.7f + 0.5f * hash_unit(column, row, room.seed));
            return {mix(brick, Vec{0.55f, 0.53f, 0.5f}, band(edge - 0.006f)) * rough, 0};
        }
        default:
            return {base * rough, 0};
    }
}

}  // namespace toy
