// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "toy_cars.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "toy/cluttered.hpp"
#include "toy/isolated.hpp"
#include "toy/noise.hpp"
#include "toy/side_by_side.hpp"
#include "toy/toys.hpp"

#include "ism/core/random.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/dataset/rle.hpp"
#include "ism/io/images.hpp"

namespace reproduce {

namespace {

ism::Frame frame_of(const toy::ToyScene& scene) {
    return {.gray = ism::to_gray(scene.color),
            .color = scene.color,
            .depth_m = ism::to_metres(scene.depth_mm, 0.001),
            .camera = scene.camera};
}

Shot shot_of(const toy::ToyScene& scene, std::size_t number) {
    Shot shot{.frame = frame_of(scene),
              .labels = {.id = std::int64_t(number) + 1,
                         .file = "toy " + std::to_string(number),
                         .width = scene.color.width(),
                         .height = scene.color.height(),
                         .camera = scene.camera}};
    for (const toy::ToyObject& object : scene.objects)
        if (object.class_index == 0)
            shot.labels.objects.push_back({.id = std::int64_t(shot.labels.objects.size()) + 1,
                                           .box = object.box,
                                           .segmentation = ism::compress_mask(object.mask),
                                           .position_m = object.position_m});
    return shot;
}

template <class Render>
std::vector<Shot> render_all(std::size_t count, unsigned threads, const Render& render) {
    std::vector<Shot> shots(count);
    ism::parallel_for(count, threads, [&](std::size_t i) { shots[i] = shot_of(render(i), i); });
    return shots;
}

}  // namespace

CarSplit split_cars(std::uint64_t seed, std::size_t cars, std::size_t unseen) {
    std::vector<int> all(cars);
    for (std::size_t i = 0; i < cars; ++i) all[i] = int(i);
    ism::Random random(toy::derived_seed(seed, 404));
    for (std::size_t i = 0; i < unseen; ++i) std::swap(all[i], all[i + random.index(cars - i)]);
    const auto cut = all.begin() + std::ptrdiff_t(unseen);
    CarSplit split{{cut, all.end()}, {all.begin(), cut}};
    std::sort(split.learnt.begin(), split.learnt.end());
    return split;
}

std::vector<ism::TrainingImage> car_lessons(const std::vector<int>& instances, unsigned threads) {
    constexpr std::size_t views = 2;
    std::vector<ism::TrainingImage> lessons(instances.size() * views);
    ism::parallel_for(lessons.size(), threads, [&](std::size_t i) {
        const int instance = instances[i / views];
        const std::uint64_t own = toy::derived_seed(std::uint64_t(instance), 500 + i % views);
        ism::Random random(own);
        const double part = (double(i % views) + random.uniform(0.15, 0.85)) / double(views) * 2 - 1;
        toy::ToyView view{.distance_m = 0.8 * random.uniform(0.95, 1.05),
                          .pitch_deg = random.uniform(13, 30)};
        view.turn_deg = part * toy::largest_turn_deg(0), view.seed = own;
        const toy::ToyScene scene = toy::render_isolated(0, instance, view, {.width = 320, .height = 240});
        const toy::ToyObject& car = scene.objects.front();
        lessons[i] = {.frame = frame_of(scene),
                      .objects = {{.box = car.box,
                                   .mask = car.mask,
                                   .instance = std::to_string(instance),
                                   .position_m = car.position_m}},
                      .name = "car " + std::to_string(instance)};
    });
    return lessons;
}

std::vector<Shot> car_tables(const std::vector<int>& instances, const Tables& tables, std::uint64_t seed,
                             unsigned threads) {
    toy::ClutterOptions clutter;
    clutter.near_m = tables.near_m, clutter.far_m = tables.far_m, clutter.cars = instances;
    return render_all(tables.count, threads, [&](std::size_t i) {
        return toy::render_cluttered(toy::derived_seed(seed, 600 + i), clutter);
    });
}

std::vector<Shot> cars_side_by_side(const std::vector<int>& instances, std::size_t count, std::uint64_t seed,
                                    unsigned threads) {
    return render_all(count, threads, [&](std::size_t i) {
        return toy::render_side_by_side(toy::derived_seed(seed, 700 + i), instances);
    });
}

ism::Dataset dataset_of(std::span<const Shot> shots, std::vector<std::string> class_names) {
    ism::Dataset dataset{.class_names = std::move(class_names)};
    for (std::size_t c = 0; c < dataset.class_names.size(); ++c)
        dataset.category_ids.push_back(std::int64_t(c) + 1);
    for (const Shot& shot : shots) dataset.images.push_back(shot.labels);
    return dataset;
}

}  // namespace reproduce
