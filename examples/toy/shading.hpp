// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "toy/light.hpp"
#include "toy/noise.hpp"
#include "toy/raster.hpp"

#include "ism/core/image.hpp"

namespace toy {

/// @brief What the lamp reaches (shadow map; Williams 1978) and how near things stand to the table.
class Shadows {
public:
    Shadows(std::span<const Placed> things, const Light& light, ShadowArea area, int size)
        : area_(area),
          size_(size),
          away_(light.to_lamp),
          side_(normalised(cross(Vec{0, 1, 0}, away_))),
          up_(cross(away_, side_)),
          map_(size, size, -1e9f),
          contact_(contact_size, contact_size) {
        const float scale = float(size) / (2 * area.radius), cell = float(contact_size) / (2 * area.radius);
        RasterTarget low(contact_size, contact_size, -0.06f);
        for (const Placed& thing : things)
            for (const Part& part : thing.model.parts) {
                world_.clear();
                for (const Vertex& vertex : part.mesh.vertices)
                    world_.push_back(thing.pose.to_world(vertex.position) - area.centre);
                for (const auto& [a, b, c] : part.mesh.triangles) {
                    const std::array corners{world_[a], world_[b], world_[c]};
                    std::array<RasterPoint, 3> lit, down;
                    for (std::size_t i = 0; i < 3; ++i) {
                        const Vec p = corners[i];
                        lit[i] = {dot(p, side_) * scale + float(size) / 2,
                                  dot(p, up_) * scale + float(size) / 2, dot(p, away_)};
                        down[i] = {p.x * cell + contact_size / 2.0f, p.y * cell + contact_size / 2.0f,
                                   -(p.z + area.centre.z)};
                    }
                    for_each_sample(lit, size, size, [&](int x, int y, float value) {
                        map_(x, y) = std::max(map_(x, y), value);
                    });
                    low.draw(down, 0);
                }
            }
        for (int y = 0; y < contact_size; ++y)
            for (int x = 0; x < contact_size; ++x)
                contact_(x, y) = std::clamp(1 + low.nearness(x, y) / 0.06f, 0.0f, 1.0f);
        const int reach = std::max(1, int(0.013f * cell));
        for (int pass = 0; pass < 3; ++pass) blur(reach);
    }

    /// @brief How much of the lamp is seen from world point p, 0 … 1; `turn` spreads the samples.
    [[nodiscard]] float lit(Vec p, Vec normal, int taps, std::uint32_t turn) const {
        const Vec q = p - area_.centre + normal * 0.0025f;
        const float scale = float(size_) / (2 * area_.radius);
        const float x = dot(q, side_) * scale + float(size_) / 2, y = dot(q, up_) * scale + float(size_) / 2;
        const float nearness = dot(q, away_) + 0.0015f, reach = 0.007f * scale;
        float sum = 0;
        const float start = float(turn & 255u) / 256;
        for (int i = 0; i < taps; ++i) {
            const float r = reach * std::sqrt((float(i) + 0.5f) / float(taps));
            float a = float(i) * 0.381966f + start;  // golden angle
            a = (a - float(int(a))) * 4 - 2;         // a square spiral is as good as a round one
            const float dx = std::abs(a) - 1, dy = a > 0 ? 1 - std::abs(dx) : std::abs(dx) - 1;
            const int ix = int(x + 1.3f * r * dx + 0.5f), iy = int(y + 1.3f * r * dy + 0.5f);
            sum += !map_.contains(ix, iy) || map_(ix, iy) <= nearness ? 1.0f : 0.0f;
        }
        return sum / float(taps);
    }

    /// @brief How much of the room's light reaches the table at world point p: 1 far from things.
    [[nodiscard]] float open(Vec p) const {
        const float cell = float(contact_size) / (2 * area_.radius);
        const float x = (p.x - area_.centre.x) * cell + contact_size / 2.0f,
                    y = (p.y - area_.centre.y) * cell + contact_size / 2.0f;
        if (x < 0 || y < 0 || x > contact_size - 1 || y > contact_size - 1) return 1;
        return 1 - 0.75f * ism::sample_bilinear(contact_, x, y);
    }

private:
    static constexpr int contact_size = 256;

    /// One pass of a box filter along rows, turned, twice.
    void blur(int reach) {
        for (int turn = 0; turn < 2; ++turn) {
            ism::Image<float> out(contact_size, contact_size);
            for (int y = 0; y < contact_size; ++y) {
                const auto row = contact_.row(y);
                float sum = 0;
                for (int x = -reach; x < contact_size; ++x) {
                    if (x + reach < contact_size) sum += row[std::size_t(x + reach)];
                    if (x - reach - 1 >= 0) sum -= row[std::size_t(x - reach - 1)];
                    if (x >= 0) out(y, x) = sum / float(2 * reach + 1);
                }
            }
            contact_ = std::move(out);
        }
    }

    ShadowArea area_;
    int size_;
    Vec away_, side_, up_;
    ism::Image<float> map_, contact_;
    std::vector<Vec> world_;
};

/// @brief What a mirror shows in direction r: a room with a bright ceiling and two windows.
[[nodiscard]] inline Vec room_mirror(Vec r) {
    const float up = smooth_step(-0.2f, 0.9f, r.z);
    Vec seen = mix(Vec{0.12f, 0.10f, 0.085f}, Vec{0.62f, 0.66f, 0.72f}, up);
    const float window = smooth_step(0.86f, 0.9f, dot(r, Vec{-0.62f, -0.45f, 0.643f}));
    const float other = smooth_step(0.93f, 0.95f, dot(r, Vec{0.75f, -0.35f, 0.561f}));
    return seen + Vec{2.2f, 2.2f, 2.1f} * window + Vec{1.0f, 1.0f, 1.1f} * other;
}

/// @brief The light that leaves a surface facing `n` towards the unit direction `to_eye`. `lamp_share` and
/// `room_share` say how much of the lamp and of the room it sees.
[[nodiscard]] inline Vec shade(const Surface& surface, Vec n, Vec to_eye, const Light& light,
                               float lamp_share, float room_share) {
    const float facing = std::max(0.0f, dot(n, light.to_lamp));
    const Vec room = mix(light.bounce, light.sky, 0.5f + 0.5f * n.z) * room_share;
    Vec out = surface.albedo * (light.lamp * (facing * lamp_share) + room);
    if (surface.gloss > 0.02f) {
        const float slope = std::clamp(dot(n, to_eye), 0.0f, 1.0f), s1 = 1 - slope, s2 = s1 * s1;
        const float fresnel = (0.04f + 0.96f * s2 * s2 * s1) * surface.gloss * surface.gloss;
        out = out + room_mirror(n * (2 * slope) - to_eye) * (fresnel * (0.3f + 0.7f * room_share));
        float spark = std::max(0.0f, dot(n, normalised(light.to_lamp + to_eye)));
        for (int i = 0; i < 5; ++i) spark *= spark;  // to the 32nd
        out = out + light.lamp * (spark * lamp_share * surface.gloss * 0.35f);
    }
    return out;
}

}  // namespace toy
