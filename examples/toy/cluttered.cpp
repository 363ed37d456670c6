// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "toy/cluttered.hpp"

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "toy/clutter.hpp"
#include "toy/noise.hpp"
#include "toy/placement.hpp"
#include "toy/toys.hpp"

namespace toy {

ToyScene render_cluttered(std::uint64_t scene_seed, const ClutterOptions& clutter,
                          const ToyOptions& options) {
    using namespace detail;
    ism::expect(clutter.least_toys >= 0 && clutter.least_toys <= clutter.most_toys, "number of toys",
                "least 0 or more, most not below",
                ism::lazy_text(clutter.least_toys, " to ", clutter.most_toys));
    ism::expect(clutter.least_things >= 0 && clutter.least_things <= clutter.most_things,
                "number of other things", "least 0 or more, most not below",
                ism::lazy_text(clutter.least_things, " to ", clutter.most_things));
    ism::expect(clutter.instances > 0 && clutter.first_instance >= 0, "toy instances",
                "at least one, from 0 on",
                ism::lazy_text(clutter.instances, " from ", clutter.first_instance));
    ism::expect(clutter.near_m >= 0.5 && clutter.near_m <= clutter.far_m && clutter.far_m <= 1.8,
                "toy distances", "0.5 to 1.8 m, near first",
                ism::lazy_text(clutter.near_m, " to ", clutter.far_m));
    const ism::Camera camera = toy_camera(options);
    ism::Random random(derived_seed(scene_seed, 202));
    const auto vary = [&](double low, double high) { return float(random.uniform(low, high)); };
    const auto count = [&](int least, int most) {
        return least + int(random.index(std::uint64_t(most - least + 1)));
    };
    const float degree = std::numbers::pi_v<float> / 180;

    const float eye_z = vary(0.30, 0.42);
    const Vec aim{0, vary(0.95, 1.1), 0.02f};
    const float roll = vary(-2, 2) * degree;
    const Viewer first_viewer = look_at(camera, {0, 0, eye_z}, aim, roll);
    const float half_view = float((options.width - 1) / 2.0 / options.focal_px);
    const Room room = make_room(random, true);
    Light light;
    const float side = random.uniform() < 0.7 ? -1.0f : 1.0f, from_side = side * vary(0.35, 0.9);
    light.to_lamp = normalised({from_side, vary(-0.6, 0.05), 1});
    const float warm = vary(-0.1, 0.12);
    light.lamp = light.lamp * Vec{1 + warm, 1, 1 - warm};
    light.exposure = vary(0.9, 1.12);

    std::vector<Placed> things;
    std::vector<Label> labels;
    const auto free_place = [&](const Placed& thing, float margin) {
        const Footprint own = footprint(thing, margin);
        for (const Placed& other : things)
            if (collide(own, footprint(other, 0))) return false;
        return true;
    };
    const int toys = count(clutter.least_toys, clutter.most_toys),
              first_class = int(random.index(class_names().size()));
    const int first_instance = int(random.index(std::uint64_t(clutter.instances)));
    const double ratio = clutter.far_m / clutter.near_m;
    for (int i = 0; i < toys; ++i) {
        // Cars are as many as the others together.
        const std::size_t class_index =
            i % 2 == 0 ? 0 : 1 + std::size_t(first_class + i / 2) % (class_names().size() - 1);
        // Toy after toy from a random one on, so that none stands there twice while there are enough.
        const int instance = class_index == 0 && !clutter.cars.empty()
                                 ? clutter.cars[std::size_t(first_instance + i / 2) % clutter.cars.size()]
                                 : clutter.first_instance + (first_instance + i) % clutter.instances;
        Placed toy{make_toy(class_index, instance, options.seed), {}, int(labels.size())};
        for (int attempt = 0; attempt < 60; ++attempt) {
            // The first two stand near and far, the others anywhere between.
            const double share = i == 0   ? random.uniform(0, 0.2)
                                 : i == 1 ? random.uniform(0.8, 1)
                                          : random.uniform();
            const Vec at =
                spot(eye_z, float(clutter.near_m * std::pow(ratio, share)), vary(-0.92, 0.92), half_view);
            const double turn = largest_turn_deg(class_index);
            toy.pose = standing(at, std::atan2(-at.x, at.y) + vary(-turn, turn) * degree);
            if (!in_picture(toy, first_viewer, options) || !free_place(toy, 0.012f)) continue;
            things.push_back(toy), labels.push_back({class_index, instance});
            break;
        }
    }
    const std::size_t placed_toys = things.size();
    const auto place_clutter = [&](int kind, Vec at) {
        Placed thing{make_clutter(kind, random.bits()), standing(at, vary(-3.1, 3.1)),
                     -2 - int(things.size())};
        const bool fits = free_place(thing, 0.004f);
        if (fits) things.push_back(std::move(thing));
        return fits;
    };
    for (std::size_t i = 0; i < placed_toys; ++i) {
        if (random.uniform() >= clutter.occluder_share) continue;
        const Model& m = things[i].model;
        const float beside = vary(-0.55, 0.55) * (m.high.x - m.low.x), before = m.low.y - vary(0.04, 0.09);
        static_cast<void>(place_clutter(int(random.index(small_clutter_kinds)),
                                        things[i].pose.to_world({beside, before, 0})));
    }
    const int others = count(clutter.least_things, clutter.most_things);
    for (int i = 0; i < others; ++i)
        for (int attempt = 0; attempt < 4; ++attempt) {
            const float distance = vary(0.6, 1.75), across = vary(-1.0, 1.0);
            if (place_clutter(int(random.index(clutter_kinds)), spot(eye_z, distance, across, half_view)))
                break;
        }
    // Toys that are hidden too much are taken away; this only shows more of the others.
    Geometry geometry = draw(things, first_viewer, options.width, options.height);
    std::vector<Placed> kept;
    for (std::size_t i = 0; i < things.size(); ++i)
        if (things[i].object < 0 || geometry.visible[i] >= clutter.least_visible) kept.push_back(things[i]);
    Viewer viewer = first_viewer;
    std::uint64_t noise_seed = scene_seed;
    if (clutter.frame > 0) {
        noise_seed = derived_seed(scene_seed, 1000 + clutter.frame);
        ism::Random shake(noise_seed);
        const auto off = [&] { return float(clutter.shake_m * shake.normal()); };
        const float x = off(), y = off(), z = off();
        viewer = look_at(camera, {x, y, eye_z + z}, aim, roll);
    }
    if (kept.size() < things.size() || clutter.frame > 0)
        geometry = draw(kept, viewer, options.width, options.height);
    return take_picture(kept, geometry, labels, room, light, viewer, {{0, 1.0f, 0.08f}, 1.05f}, options,
                        noise_seed);
}

}  // namespace toy
