// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "toy/render.hpp"
#include "toy/sensor.hpp"

#include "ism/core/camera.hpp"
#include "ism/core/geometry.hpp"

namespace toy {

/// @brief What all pictures of a set share.
struct ToyOptions {
    std::uint64_t seed = 1;         ///< of the toys: the same seed and instance give the same toy
    int width = 640, height = 480;  ///< pixels; the principal point is the middle
    double focal_px = 525;
    DepthSensor depth = {};
    ColourSensor colour = {};
};

/// @brief A toy that is seen in a scene.
struct ToyObject {
    std::size_t class_index = 0;  ///< into class_names()
    int instance = 0;             ///< which toy of its class
    ism::Mask mask;               ///< its visible pixels
    ism::Box box;                 ///< around them
    ism::Point3 position_m;       ///< the middle of the box around the whole toy, camera frame
    double visible = 1;  ///< share of its outline's area that nothing hides and the frame does not cut
};

/// @brief An RGB-D picture with all that is known about it.
struct ToyScene {
    ism::RgbImage color;
    ism::RawDepth depth_mm;  ///< as a sensor reads it; 0 = no reading
    ism::DepthMap exact_m;   ///< without the sensor's faults
    ism::Camera camera;
    std::vector<ToyObject> objects;
};

/// @brief The camera of the options.
/// @throws ism::Error where the picture is smaller than 64 × 64 or the focal length not positive.
[[nodiscard]] inline ism::Camera toy_camera(const ToyOptions& options) {
    ism::expect(options.width >= 64 && options.height >= 64, "toy picture size", "at least 64x64",
                ism::lazy_text(options.width, "x", options.height));
    const ism::Camera camera{options.focal_px, options.focal_px, (options.width - 1) / 2.0,
                             (options.height - 1) / 2.0};
    ism::check(camera);
    return camera;
}

namespace detail {

/// Which toy a Placed stands for.
struct Label {
    std::size_t class_index;
    int instance;
};

/// The middle of a model's box in the camera frame.
inline ism::Point3 centre_in_camera(const Placed& thing, const Viewer& viewer) {
    const Vec p = viewer.pose.to_local(thing.pose.to_world((thing.model.low + thing.model.high) * 0.5f));
    return {p.x, p.y, p.z};
}

/// Renders, lets the sensors look and writes down the truth. Placed::object ≥ 0 are indices into `labels`.
inline ToyScene take_picture(std::span<const Placed> things, const Geometry& geometry,
                             std::span<const Label> labels, const Room& room, const Light& light,
                             const Viewer& viewer, ShadowArea area, const ToyOptions& options,
                             std::uint64_t seed) {
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
