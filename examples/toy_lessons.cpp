// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "toy_lessons.hpp"

#include <cstddef>
#include <string>

#include "toy/cluttered.hpp"
#include "toy/isolated.hpp"

#include "ism/io/images.hpp"

namespace toy {

ism::Frame to_frame(const ToyScene& scene) {
    return {.gray = ism::to_gray(scene.color),
            .depth_m = ism::to_metres(scene.depth_mm, 0.001),
            .camera = scene.camera};
}

std::vector<ism::TrainingImage> make_lessons(int toys) {
    const ToyOptions options{.width = 320, .height = 240};
    std::vector<ism::TrainingImage> lessons;
    for (std::size_t c = 0; c < class_names().size(); ++c)
        for (int instance = 0; instance < toys; ++instance)
            for (const double side : {-0.5, 0.5}) {
                const ToyView view{.turn_deg = side * largest_turn_deg(c), .seed = lessons.size() + 1};
                const ToyScene scene = render_isolated(c, instance, view, options);
                const ToyObject& toy = scene.objects.front();
                lessons.push_back({.frame = to_frame(scene),
                                   .objects = {{.class_index = std::uint32_t(toy.class_index),
                                                .box = toy.box,
                                                .mask = toy.mask}},
                                   .name = class_names()[c] + " " + std::to_string(instance)});
            }
    return lessons;
}

ToyScene make_test() {
    return render_cluttered(3, {.first_instance = 100});
}

ism::RgbImage read_or_render(const char* file) {
    return file != nullptr ? ism::read_rgb(file) : make_test().color;
}

}  // namespace toy
