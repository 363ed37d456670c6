// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "toy/render.hpp"

#include <array>
#include <cmath>

#include "toy/shading.hpp"

namespace toy {

namespace {

struct Hit {
    Vec light;
    float depth_m = 0, echo = 0;
    int object = -1;
};

/// How much of an infra-red dot pattern comes back from a surface seen at cosine `slope`.
float pattern_echo(const Surface& s, float slope) {
    const float bright = 0.35f * s.albedo.x + 0.45f * s.albedo.y + 0.2f * s.albedo.z;
    return (0.25f + std::sqrt(bright)) * smooth_step(0.03f, 0.35f, slope) * (1 - 0.35f * s.gloss);
}

}  // namespace

Rendering render(std::span<const Placed> things, const detail::Geometry& g, const Room& room,
                 const Light& light, const Viewer& viewer, ShadowArea area, int width, int height) {
    using namespace detail;
    const Shadows shadows(things, light, area, 1024);
    Rendering out{ism::Image<Vec>(width, height), ism::DepthMap(width, height),
                  ism::Image<float>(width, height), ism::Image<int>(width, height, -1), g.visible};
    const auto& cam = viewer.camera;
    const Vec eye = viewer.pose.origin;

    const auto background = [&](Vec ray, int taps, std::uint32_t turn) {
        const float to_table = ray.z < -1e-4f ? -eye.z / ray.z : 1e9f,
                    to_wall = ray.y > 1e-4f ? (room.wall_y - eye.y) / ray.y : 1e9f;
        const bool table = to_table < to_wall;
        const float depth =
            std::min({to_table, to_wall, 20.0f});  // `ray` has length 1 along the optical axis
        const Vec p = eye + ray * depth, n = table ? Vec{0, 0, 1} : Vec{0, -1, 0}, to_eye = -normalised(ray);
        const float slope = std::max(0.05f, dot(n, to_eye)), pixel_m = depth / float(cam.fx);
        const Surface s =
            table ? table_surface(room, p, pixel_m / std::sqrt(slope)) : wall_surface(room, p, pixel_m);
        const float lit = shadows.lit(p, n, taps, turn), open = table ? shadows.open(p) : 1;
        const float corner = 0.6f + 0.4f * smooth_step(0, 0.3f, table ? room.wall_y - p.y : p.z);
        return Hit{shade(s, n, to_eye, light, lit, open * corner), depth, pattern_echo(s, slope), -1};
    };
    const auto surface_hit = [&](std::int32_t number, float nearness, Vec ray, std::uint32_t turn) {
        const Flat& t = g.triangles[std::size_t(number)];
        const Corner &a = g.corners[t.corners[0]], &b = g.corners[t.corners[1]], &c = g.corners[t.corners[2]];
        const float depth = 1 / nearness;
        const Vec p = eye + ray * depth, ab = b.position - a.position, ac = c.position - a.position;
        Vec face = cross(ab, ac);
        const float square = dot(face, face);
        const Vec ap = p - a.position;
        const float wb = dot(cross(ap, ac), face) / square, wc = dot(cross(ab, ap), face) / square;
        const Vec to_eye = -normalised(ray);
        if (dot(face, to_eye) < 0) face = -face;
        Vec n = normalised(a.normal * (1 - wb - wc) + b.normal * wb + c.normal * wc);
        if (dot(n, face) < 0) n = -n;
        const float behind = dot(n, to_eye);
        if (behind < 0.02f) n = normalised(n + to_eye * (0.02f - behind));
        const Placed& thing = things[t.thing];
        const Vec local = thing.pose.to_local(p);
        const Surface s = thing.model.parts[t.part].paint(local, thing.pose.turn_back(n));
        const float low = 0.5f + 0.5f * smooth_step(-0.01f, 0.06f, p.z + 0.03f * n.z);
        return Hit{shade(s, n, to_eye, light, shadows.lit(p, n, 4, turn), low), depth,
                   pattern_echo(s, std::max(behind, 0.0f)), thing.object};
    };
    const auto ray_at = [&](float x, float y) {
        return viewer.pose.turn(
            {(x - float(cam.cx)) / float(cam.fx), (y - float(cam.cy)) / float(cam.fy), 1});
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            std::array<std::int32_t, samples * samples> numbers{};
            bool any = false;
            for (std::size_t i = 0; i < numbers.size(); ++i) {
                numbers[i] = g.seen.triangle(x * samples + int(i) % samples, y * samples + int(i) / samples);
                any = any || numbers[i] >= 0;
            }
            if (!any) {
                const Hit hit = background(ray_at(float(x), float(y)), 8, hash_cell(x, y, 1));
                out.light(x, y) = hit.light, out.depth_m(x, y) = hit.depth_m, out.echo(x, y) = hit.echo;
                continue;
            }
            std::array<Hit, samples * samples> hits;
            for (std::size_t i = 0; i < numbers.size(); ++i) {
                const int sx = x * samples + int(i) % samples, sy = y * samples + int(i) / samples;
                const Vec ray =
                    ray_at((float(sx) + 0.5f) / samples - 0.5f, (float(sy) + 0.5f) / samples - 0.5f);
                const std::uint32_t turn = hash_cell(sx, sy, 2);
                hits[i] = numbers[i] < 0 ? background(ray, 4, turn)
                                         : surface_hit(numbers[i], g.seen.nearness(sx, sy), ray, turn);
                out.light(x, y) = out.light(x, y) + hits[i].light * (1.0f / float(numbers.size()));
            }
            // The pixel belongs to what most of its samples show, the nearer one where two are equal.
            std::size_t winner = 0;
            int winner_votes = 0;
            for (std::size_t i = 0; i < hits.size(); ++i) {
                int votes = 0;
                for (const Hit& other : hits) votes += other.object == hits[i].object;
                if (votes > winner_votes || (votes == winner_votes && hits[i].depth_m < hits[winner].depth_m))
                    winner = i, winner_votes = votes;
            }
            float depth = 0, echo = 0;
            for (const Hit& hit : hits)
                if (hit.object == hits[winner].object) depth += hit.depth_m, echo += hit.echo;
            out.object(x, y) = hits[winner].object;
            out.depth_m(x, y) = depth / float(winner_votes), out.echo(x, y) = echo / float(winner_votes);
        }
    return out;
}

}  // namespace toy
