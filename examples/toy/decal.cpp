// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "toy/decal.hpp"

#include <array>
#include <cmath>

namespace toy {

bool on_digit(int digit, float u, float v) {
    static constexpr std::array<std::uint32_t, 10> dots{
        0b111101101101111, 0b010110010010111, 0b111001111100111, 0b111001111001111, 0b101101111001001,
        0b111100111001111, 0b111100111101111, 0b111001001010010, 0b111101111101111, 0b111101111001111};
    if (u < 0 || u >= 1 || v < 0 || v >= 1) return false;
    const int column = int(u * 3), row = int((1 - v) * 5);
    return (dots[std::size_t(digit % 10)] >> (14 - std::min(row, 4) * 3 - column)) & 1u;
}

bool on_star(float u, float v, int points, float depth) {
    const float pi = 3.14159265f, sector = 2 * pi / float(points);
    const float radius = std::sqrt(u * u + v * v);
    if (radius > 1) return false;
    const float angle = std::fmod(std::atan2(u, v) + 4 * pi, sector) / sector;
    const float along = std::abs(angle - 0.5f) * 2;  // 1 at a ray, 0 between two
    return radius < depth + (1 - depth) * along * along * (0.4f + 0.6f * along);
}

bool on_heart(float u, float v) {
    const float x = u * 1.15f, y = v * 1.15f + 0.1f;
    const float a = x * x + y * y - 1;
    return a * a * a - x * x * y * y * y < 0 && std::abs(x) < 1.2f && std::abs(y) < 1.3f;
}

bool on_print(float u, float v, int rows, std::uint32_t seed) {
    if (u < 0 || u >= 1 || v < 0 || v >= 1) return false;
    const int row = int(v * float(rows));
    const float in_row = v * float(rows) - float(row);
    if (in_row < 0.25f || in_row > 0.8f || u > 0.6f + 0.4f * hash_unit(row, 7, seed)) return false;
    const int column = int(u * 11 * float(rows)), letter = column / 4, part = column % 4;
    if (part == 3 || letter % (4 + row % 3) == 0) return false;
    const int line = int((in_row - 0.25f) / 0.11f);
    return hash_unit(letter * 4 + part, row * 8 + line, seed) > 0.35f;
}

int motif(int kind, float u, float v, std::uint32_t seed) {
    const int row = floor_int(v), column = floor_int(u + (row % 2 != 0 ? 0.5f : 0.0f));
    const float x = (u + (row % 2 != 0 ? 0.5f : 0.0f) - float(column)) * 2 - 1, y = (v - float(row)) * 2 - 1;
    const int ink = hash_cell(column, row, seed) % 3 == 0 ? 2 : 1;
    switch (kind % 8) {
        case 0:
            return x * x + y * y < 0.4f ? ink : 0;
        case 1:
            return std::abs(y) < 0.35f ? (row % 2 != 0 ? 1 : 2) : 0;
        case 2: {
            const float wave = std::abs(u * 2 - 2 * std::floor(u) - 1) + v;
            const float part = wave - std::floor(wave);
            return part < 0.33f ? 1 : part < 0.5f ? 2 : 0;
        }
        case 3:
            return ((floor_int(u * 2) + floor_int(v * 2)) % 2 != 0) ? 1 : 0;
        case 4:
            return on_star(x * 1.15f, y * 1.15f, 5) ? ink : 0;
        case 5:
            return on_heart(x * 1.4f, y * 1.4f) ? ink : 0;
        case 6:
            return x * x + y * y < 0.09f ? 2 : on_star(x * 1.1f, y * 1.1f, 6, 0.35f) ? 1 : 0;
        default: {
            const float wave = v * 1.5f + 0.25f * std::sin(u * 6.2831853f);
            const float part = wave - std::floor(wave);
            return part < 0.3f ? 1 : part > 0.45f && part < 0.6f ? 2 : 0;
        }
    }
}

}  // namespace toy
