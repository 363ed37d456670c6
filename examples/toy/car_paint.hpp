// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "toy/car_shape.hpp"
#include "toy/decal.hpp"
#include "toy/model.hpp"

namespace toy {

/// @brief Paint and print of a car.
struct CarLivery {
    Vec paint, second, trim = {0.55f, 0.56f, 0.58f};
    int scheme = 0;  ///< 0 plain, 1 two-tone, 2 stripes over the roof, 3 number, 4 side band, 5 star, 6
                     ///< checks, 7 flames
    int number = 7;
    int spokes = 5;
    Vec rim;
    std::uint32_t seed = 0;
};

namespace detail {

/// The side, top or end of the lower body under the print, without windows and lamps.
inline Vec body_colour(const CarShape& s, const CarLivery& l, Vec p, Vec n) {
    const float l0 = s.length, door = (s.cabin[0] + s.cabin[2]) / 2, middle = (s.belt + s.bottom) * 0.52f;
    const bool side = std::abs(n.y) > 0.55f;
    const Vec white{0.85f, 0.85f, 0.82f}, black{0.02f, 0.02f, 0.025f};
    switch (l.scheme) {
        case 1:
            return p.z < middle + 0.004f ? l.second : p.z < middle + 0.0065f ? l.trim : l.paint;
        case 2:
            return !side && std::abs(std::abs(p.y) - 0.011f) < 0.007f ? l.second : l.paint;
        case 3: {
            const float u = (p.x - door) / (0.105f * l0), v = (p.z - middle) / (0.105f * l0);
            const float r = u * u + v * v;
            if (!side || r > 1) return std::abs(p.z - middle) < 0.006f && side ? l.second : l.paint;
            if (r > 0.8f) return black;
            const float mirrored = n.y > 0 ? -u : u;
            const bool one = l.number < 10;
            const bool ink = one ? on_digit(l.number, mirrored / 0.8f + 0.5f, v / 1.2f + 0.5f)
                                 : on_digit(l.number / 10, (mirrored + 0.65f) / 0.55f, v / 1.1f + 0.5f) ||
                                       on_digit(l.number, (mirrored - 0.1f) / 0.55f, v / 1.1f + 0.5f);
            return ink ? black : white;
        }
        case 4: {
            const float band = p.z - middle - 0.05f * p.x;
            return side && std::abs(band) < 0.008f             ? l.second
                   : side && std::abs(band - 0.011f) < 0.0012f ? white
                                                               : l.paint;
        }
        case 5: {
            const float u = (p.x - door) / (0.12f * l0), v = (p.z - middle) / (0.12f * l0);
            return side && on_star(u, v, 5) ? l.second : l.paint;
        }
        case 6: {
            const float cell = 0.0075f;
            const bool odd = (floor_int(p.x / cell) + floor_int((p.z - middle) / cell)) % 2 != 0;
            return side && std::abs(p.z - middle) < cell ? (odd ? black : white) : l.paint;
        }
        case 7: {
            const float reach = 0.35f + 0.35f * value_noise(p.z * 260, 1, l.seed);
            const float t = (p.x + l0 / 2) / (l0 * 0.75f);
            return side && t < reach ? mix(Vec{0.9f, 0.7f, 0.05f}, l.second, t / reach) : l.paint;
        }
        default:
            return l.paint;
    }
}

inline Surface lower_body(const CarShape& s, const CarLivery& l, Vec p, Vec n) {
    const Vec black{0.012f, 0.012f, 0.014f};
    const bool side = std::abs(n.y) > 0.5f;
    for (const float axle : {s.front_axle, s.rear_axle}) {
        const float dx = p.x - axle, dz = p.z - s.wheel_radius, r = std::sqrt(dx * dx + dz * dz);
        if (side && r < s.wheel_radius * 1.16f) return {black, 0.02f};
        if (side && r < s.wheel_radius * 1.28f) return {mix(l.paint, l.trim, 0.35f), 0.5f};
    }
    if (p.z < s.bottom + 0.006f) return {{0.03f, 0.03f, 0.033f}, 0.15f};
    const float l0 = s.length, nose = p.x + l0 / 2, tail = l0 / 2 - p.x;
    const float lamp_z = s.bottom + 0.62f * (s.hood - s.bottom);
    // Lamps at the corners, grille and number plate between them.
    const float front_y = (std::abs(p.y) - 0.34f * s.width) / (0.1f * s.width),
                lamp_v = (p.z - lamp_z) / (0.034f * l0);
    const bool front = nose < 0.07f * l0, rear = tail < 0.055f * l0;
    if (front && !side && front_y * front_y + lamp_v * lamp_v < 1) return {{0.9f, 0.88f, 0.7f}, 0.9f};
    if (front && side && std::abs(lamp_v) < 0.9f && nose > 0.012f * l0 && nose < 0.06f * l0)
        return {{0.92f, 0.85f, 0.55f}, 0.9f};
    if (rear && std::abs(p.y) > 0.26f * s.width && std::abs(lamp_v) < 1.1f)
        return {{0.6f, 0.01f, 0.015f}, 0.9f};
    if (front && !side && std::abs(p.y) < 0.22f * s.width && std::abs(lamp_v) < 1)
        return {floor_int(p.z * 500) % 2 != 0 ? black : l.trim, 0.6f};
    const float bumper = s.bottom + 0.2f * (s.belt - s.bottom);
    if ((nose < 0.05f * l0 || tail < 0.05f * l0) && std::abs(p.z - bumper) < 0.013f * l0)
        return {l.trim, 0.8f};
    if (side && std::abs(p.x) < 0.47f * l0 && std::abs(p.z - bumper) < 0.0016f) return {l.trim, 0.7f};
    // Door lines and handles.
    const float sill = bumper + 0.004f;
    if (side && p.z > sill) {
        const float first = s.cabin[0] + 0.03f * l0, pillar = (s.cabin[1] + s.cabin[2]) / 2;
        const float last = s.side_windows > 1 ? s.cabin[2] : pillar;
        for (const float x : {first, pillar, last})
            if (std::abs(p.x - x) < 0.0009f) return {l.paint * 0.12f, 0.1f};
        for (const float x : {pillar, last})
            if (std::abs(p.x - x + 0.05f * l0) < 0.02f * l0 && std::abs(p.z - s.belt + 0.035f * l0) < 0.0018f)
                return {l.trim, 0.8f};
    }
    if (s.kind == 3 && n.z > 0.6f && p.x > s.cabin[3] + 0.01f * l0 && tail > 0.03f * l0 &&
        std::abs(p.y) < 0.4f * s.width)
        return {Vec{0.06f, 0.06f, 0.06f} * (floor_int(p.y * 180) % 2 != 0 ? 1.0f : 1.8f), 0.1f};
    return {body_colour(s, l, p, n), 0.75f};
}

inline Surface cabin(const CarShape& s, const CarLivery& l, Vec p, Vec n) {
    const float l0 = s.length, frame = 0.022f * l0, top = s.cabin_top(p.x);
    const Vec glass = mix(Vec{0.02f, 0.028f, 0.036f}, Vec{0.10f, 0.14f, 0.17f},
                          smooth_step(-0.3f, 0.8f, std::sin((p.x + p.z * 1.2f) * 70)));
    const float sill = s.body_top(p.x) + frame * 0.6f;
    if (std::abs(n.y) > 0.5f) {
        const float begin = s.cabin[0], end = s.cabin[3];
        const float from = begin + (s.cabin[1] - begin) * 0.55f, to = s.cabin[2] + (end - s.cabin[2]) * 0.3f;
        bool pillar = p.x > to + 0.02f * l0 || p.x < begin + 0.045f * l0;
        for (int i = 1; i < s.side_windows; ++i) {
            const float x = from + (to - from) * float(i) / float(s.side_windows);
            pillar = pillar || std::abs(p.x - x) < 0.011f * l0;
        }
        const float above = std::min(top, s.roof - 0.01f * l0) - frame * 1.25f - p.z, below = p.z - sill;
        if (above > 0 && below > 0 && !pillar) return {glass, 0.95f};
        if (above > -0.0016f && below > -0.0016f && !pillar) return {l.trim, 0.8f};
    } else if (n.z < 0.85f && std::abs(n.x) > 0.2f) {
        const float half = s.width * 0.5f * (1 - s.tumble * (p.z - s.belt) / (s.roof - s.belt));
        if (p.z > sill && p.z < s.roof - frame * 0.9f && std::abs(p.y) < half * 0.8f) return {glass, 0.95f};
    }
    return {body_colour(s, l, p, n), 0.75f};
}

inline Surface wheel(const CarShape& s, const CarLivery& l, float axle, Vec p) {
    const float dx = p.x - axle, dz = p.z - s.wheel_radius, r = std::sqrt(dx * dx + dz * dz) / s.wheel_radius;
    if (r > 0.68f)
        return {std::abs(r - 0.84f) < 0.03f ? Vec{0.1f, 0.1f, 0.1f} : Vec{0.018f, 0.018f, 0.02f}, 0.12f};
    if (r > 0.6f || r < 0.16f) return {l.rim, 0.9f};
    const float turn = (std::atan2(dz, dx) / (2 * std::numbers::pi_v<float>)+1) * float(l.spokes);
    const bool spoke = std::abs(turn - std::floor(turn) - 0.5f) > 0.5f - 0.055f / r * float(l.spokes) / 5;
    return spoke ? Surface{l.rim, 0.9f} : Surface{{0.04f, 0.04f, 0.045f}, 0.2f};
}

}  // namespace detail

}  // namespace toy
