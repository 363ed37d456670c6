// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "toy/side_by_side.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "toy/noise.hpp"
#include "toy/placement.hpp"
#include "toy/toys.hpp"

namespace toy {

ToyScene render_side_by_side(std::uint64_t scene_seed, const std::vector<int>& instances,
                             const ToyOptions& options) {
    using namespace detail;
    ism::expect(instances.size() >= 2, "cars side by side: instances", "2 or more", instances.size());
    ism::Random random(derived_seed(scene_seed, 303));
    const auto vary = [&](double low, double high) { return float(random.uniform(low, high)); };
    const std::size_t first = random.index(instances.size()),
                      second = (first + 1 + random.index(instances.size() - 1)) % instances.size();
    const std::array<Label, 2> labels{{{0, instances[first]}, {0, instances[second]}}};
    const float eye_z = vary(0.10, 0.13);
    const Viewer viewer = look_at(toy_camera(options), {0, 0, eye_z}, {0, 1, 0.04f}, 0);
    const bool left_is_near = random.uniform() < 0.5;
    const float near_m = vary(0.70, 0.76), far_m = vary(0.96, 1.06);
    const std::array<float, 2> distance{left_is_near ? near_m : far_m, left_is_near ? far_m : near_m};

    std::vector<Placed> things;
    std::array<float, 2> length_px{};
    for (std::size_t i = 0; i < 2; ++i) {
        things.push_back({make_toy(0, labels[i].instance, options.seed), {}, int(i)});
        const Model& m = things[i].model;
        length_px[i] = (m.high.x - m.low.x) * float(options.focal_px) / distance[i];
    }
    // Wheels stand at about .3 of a car's length from its middle.
    const float apart_px = vary(0.57, 0.63) * (length_px[0] + length_px[1]);
    const float half_width_px = float(options.width - 1) / 2,
                half_view = half_width_px / float(options.focal_px);
    const float degree = std::numbers::pi_v<float> / 180, middle_px = vary(-40, 40);
    for (std::size_t i = 0; i < 2; ++i) {
        const float across = (middle_px + (i == 0 ? -0.5f : 0.5f) * apart_px) / half_width_px;
        const Vec at = spot(eye_z, distance[i], across, half_view);
        things[i].pose = standing(at, std::atan2(-at.x, at.y) + vary(-6, 6) * degree);
    }
    const Room room = make_room(random, true);
    Light light;
    light.to_lamp = normalised({vary(-0.8, 0.8), vary(-0.6, 0.05), 1});
    return take_picture(things, draw(things, viewer, options.width, options.height), labels, room, light,
                        viewer, {{0, 0.9f, 0.08f}, 0.8f}, options, scene_seed);
}

}  // namespace toy
