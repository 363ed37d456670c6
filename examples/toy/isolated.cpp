// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "toy/isolated.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "toy/noise.hpp"

namespace toy {

ToyScene render_isolated(std::size_t class_index, int instance, const ToyView& view,
                         const ToyOptions& options) {
    ism::expect(view.distance_m >= 0.4 && view.distance_m <= 2, "toy view distance", "0.4 to 2 m",
                view.distance_m);
    ism::expect(view.pitch_deg >= 0 && view.pitch_deg <= 60, "toy view pitch", "0 to 60 degrees",
                view.pitch_deg);
    const ism::Camera camera = toy_camera(options);
    ism::Random random(derived_seed(view.seed, 101));
    const float degree = std::numbers::pi_v<float> / 180;
    const std::vector<Placed> things{
        {make_toy(class_index, instance, options.seed), standing({}, float(view.turn_deg) * degree), 0}};
    const Vec middle = (things[0].model.low + things[0].model.high) * 0.5f;
    const float pitch = float(view.pitch_deg) * degree, far = float(view.distance_m);
    const Vec aim{middle.x + float(random.uniform(-0.01, 0.01)), middle.y,
                  middle.z + float(random.uniform(-0.01, 0.01))};
    const Vec eye{middle.x, middle.y - far * std::cos(pitch), middle.z + far * std::sin(pitch)};
    const Room room = make_room(random, false);
    Light light;
    light.to_lamp = normalised({float(random.uniform(-0.8, 0.8)), float(random.uniform(-0.6, 0.0)), 1});
    const std::array<detail::Label, 1> labels{{{class_index, instance}}};
    const Viewer viewer = look_at(camera, eye, aim, 0);
    return detail::take_picture(things, detail::draw(things, viewer, options.width, options.height), labels,
                                room, light, viewer, {{0, 0, 0.08f}, 0.4f}, options, view.seed);
}

}  // namespace toy
