// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "support/depth_scene.hpp"

#include "ism/codebook/match_nearest.hpp"
#include "ism/core/frame.hpp"
#include "ism/detect/scene.hpp"
#include "ism/train/describe_object.hpp"
#include "ism/train/training_features.hpp"

/// Painted blocks before a wall (synthetic), whose features are made, not found: each has places on its front
/// with directions and descriptors of its own.
namespace metric_scene {

constexpr std::size_t dimension = 16;
constexpr int width = depth_scene::width / 2, height = depth_scene::height / 2;
constexpr ism::Camera camera{depth_scene::camera.fx / 2, depth_scene::camera.fy / 2,
                             depth_scene::camera.cx / 2, depth_scene::camera.cy / 2};
constexpr std::array<ism::Rgb, 2> paint{{{200, 30, 30}, {30, 60, 210}}};
constexpr std::array<ism::Vec3f, 2> half_sides{{{0.12f, 0.07f, 0.03f}, {0.06f, 0.10f, 0.05f}}};

/// A block of a class; `front_m` is the middle of its front.
struct Thing {
    std::uint32_t class_index;
    ism::Vec3f front_m;
    ism::Rotation rotation = {};

    [[nodiscard]] depth_scene::Block block() const {
        const ism::Vec3f half = half_sides[class_index];
        return {front_m + rotate(rotation, {0, 0, half.z}), half, rotation};
    }
};

/// What a camera and a perfect detector of features see.
struct View {
    ism::Frame frame;
    std::vector<ism::RegionMask> masks = {};  ///< of the things
    std::vector<std::uint32_t> classes = {};
    ism::FeatureSet<float> found{{}, ism::Descriptors<float>(dimension)};
};

/// A direction in the space of descriptors, the same for the same number; with a little noise.
inline std::vector<float> descriptor(std::uint64_t number, ism::Random& noise) {
    ism::Random random(number + 1);
    std::vector<float> row(dimension);
    double sum = 0;
    for (float& value : row) {
        value = float(random.normal() + 0.05 * noise.normal());
        sum += double(value) * value;
    }
    for (float& value : row) value /= float(std::sqrt(sum));
    return row;
}

/// @param each  features of a thing
inline View seen(const std::vector<Thing>& things, std::uint64_t seed, int each = 30) {
    std::vector<depth_scene::Shape> shapes{depth_scene::Plane{{0, 0, -1}, -1.6f}};
    for (const Thing& thing : things) shapes.push_back(thing.block());
    const depth_scene::Picture picture = depth_scene::render(shapes);
    ism::Random noise(seed);
    View view{.frame = {.gray = ism::GrayImage(width, height, 0.5f),
                        .color = ism::RgbImage(width, height, ism::Rgb{120, 120, 120}),
                        .depth_m = ism::DepthMap(width, height),
                        .camera = camera}};
    for (std::size_t t = 0; t < things.size(); ++t) {
        ism::Mask mask(width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                if (contains(picture.regions[t + 1], 2 * x, 2 * y)) {
                    mask(x, y) = 1;
                    view.frame.color(x, y) = paint[things[t].class_index];
                }
        view.masks.push_back(region_of(mask));
        view.classes.push_back(things[t].class_index);
    }
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) view.frame.depth_m(x, y) = picture.depth_m(2 * x, 2 * y);
    const auto add = [&](ism::Point2 at, double angle, float depth_m, double size_m, std::uint64_t number) {
        view.found.features.push_back({.x = float(at.x),
                                       .y = float(at.y),
                                       .scale = float(size_m * camera.fx / depth_m),
                                       .angle = float(angle),
                                       .strength = 1,
                                       .depth_m = depth_m});
        view.found.descriptors.push_back(descriptor(number, noise));
    };
    for (const Thing& thing : things) {
        ism::Random places(40 + thing.class_index);
        const ism::Vec3f half = half_sides[thing.class_index];
        for (int i = 0; i < each; ++i) {
            const ism::Vec3f on{float(places.uniform(-0.85, 0.85)) * half.x,
                                float(places.uniform(-0.85, 0.85)) * half.y, 0};
            const double turn = places.uniform(-3, 3), size_m = places.uniform(0.004, 0.01);
            const ism::Vec3f p = thing.front_m + rotate(thing.rotation, on);
            const ism::Vec3f ahead =
                p + 1e-3f * rotate(thing.rotation, {float(std::cos(turn)), float(std::sin(turn)), 0});
            const ism::Point2 at = project(camera, to_point3(p)), next = project(camera, to_point3(ahead));
            add(at, std::atan2(next.y - at.y, next.x - at.x), p.z, size_m,
                1000 * (thing.class_index + 1) + std::uint64_t(i));
        }
    }
    ism::Random wall(seed + 7);
    for (int i = 0; i < 15; ++i) {
        const ism::Point2 at{wall.uniform(5, width - 6), wall.uniform(5, 25)};
        add(at, 0, 1.6f, 0.01, 10 + wall.index(900));  // below those of things
    }
    return view;
}

/// What training keeps of views.
inline ism::TrainingFeatures lessons(const std::vector<View>& views) {
    ism::TrainingFeatures all{.class_names = {"red", "blue"}};
    all.settings = {{.detector = "made", .descriptor = "made", .dimension = dimension}};
    all.samples = {{{}, ism::Descriptors<float>(dimension)}};
    for (const View& view : views) {
        ism::TrainingView kept{.width = width, .height = height};
        kept.first_object = std::uint32_t(all.objects.size());
        kept.depth = {view.frame.depth_m, camera, view.masks};
        for (std::size_t i = 0; i < view.masks.size(); ++i) {
            kept.labels.push_back({view.classes[i], box_of(view.masks[i])});
            all.objects.push_back(describe_object(kept.labels.back(), full_mask(view.masks[i], width, height),
                                                  "view " + std::to_string(all.views.size())));
        }
        kept.end_object = std::uint32_t(all.objects.size());
        kept.channels = {view.found};
        kept.pixels = view.frame.color;
        all.views.push_back(std::move(kept));
    }
    all.summary.images = views.size();
    return all;
}

/// Each thing from two distances, once turned in the image; in the middle, so that its front alone is seen.
inline std::vector<View> training_views() {
    std::vector<View> views;
    for (const std::uint32_t class_index : {0u, 1u})
        for (const double angle : {0.0, 0.5})
            views.push_back(seen(
                {{class_index, {0, 0, angle > 0 ? 0.95f : 0.8f}, ism::rotation_around({0, 0, 1}, angle)}},
                100 + 10 * class_index + std::uint64_t(10 * angle)));
    return views;
}

/// A view with its features matched to a model of learn_metric().
inline ism::Scene scene_of(const View& view, const ism::Model& model, ism::ThreadPool& pool) {
    ism::Scene scene{.frame = view.frame, .model = model, .pool = pool};
    scene.features = view.found.features;
    scene.matches = match_nearest(ism::WordIndex(model.channels[0].codebook), view.found.descriptors,
                                  model.channels[0].neighbours, pool);
    return scene;
}

}  // namespace metric_scene
