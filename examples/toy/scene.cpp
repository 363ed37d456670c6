// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "toy/scene.hpp"

#include <algorithm>
#include <utility>

#include "toy/noise.hpp"

#include "ism/core/error.hpp"

namespace toy {

ism::Camera toy_camera(const ToyOptions& options) {
    ism::expect(options.width >= 64 && options.height >= 64, "toy picture size", "at least 64x64",
                ism::lazy_text(options.width, "x", options.height));
    const ism::Camera camera{options.focal_px, options.focal_px, (options.width - 1) / 2.0,
                             (options.height - 1) / 2.0};
    ism::check(camera);
    return camera;
}

namespace detail {

ism::Point3 centre_in_camera(const Placed& thing, const Viewer& viewer) {
    const Vec p = viewer.pose.to_local(thing.pose.to_world((thing.model.low + thing.model.high) * 0.5f));
    return {p.x, p.y, p.z};
}

ToyScene take_picture(std::span<const Placed> things, const Geometry& geometry, std::span<const Label> labels,
                      const Room& room, const Light& light, const Viewer& viewer, ShadowArea area,
                      const ToyOptions& options, std::uint64_t seed) {
    const Rendering seen = render(things, geometry, room, light, viewer, area, options.width, options.height);
    double sum = 0;
    for (const Vec& c : seen.light.pixels()) sum += 0.3 * c.x + 0.6 * c.y + 0.1 * c.z;
    const double mean = sum / double(seen.light.pixels().size());
    const float exposure = light.exposure * float(std::clamp(0.36 / mean, 0.5, 2.0));
    ToyScene scene;
    scene.color = sense_colour(seen, exposure, options.colour, std::uint32_t(derived_seed(seed, 1)));
    scene.depth_mm = sense_depth(seen, viewer.camera, options.depth, std::uint32_t(derived_seed(seed, 2)));
    scene.camera = viewer.camera;
    for (std::size_t t = 0; t < things.size(); ++t) {
        const int object = things[t].object;
        if (object < 0) continue;
        const Label& label = labels[std::size_t(object)];
        ToyObject truth{label.class_index,
                        label.instance,
                        ism::Mask(options.width, options.height),
                        {},
                        centre_in_camera(things[t], viewer),
                        seen.visible[t]};
        for (int y = 0; y < options.height; ++y)
            for (int x = 0; x < options.width; ++x) truth.mask(x, y) = seen.object(x, y) == object;
        truth.box = ism::mask_box(truth.mask);
        scene.objects.push_back(std::move(truth));
    }
    scene.exact_m = seen.depth_m;
    return scene;
}

}  // namespace detail

}  // namespace toy
