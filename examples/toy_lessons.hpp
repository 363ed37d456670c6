// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "toy/cluttered.hpp"
#include "toy/isolated.hpp"

#include "ism/core/frame.hpp"
#include "ism/io/images.hpp"
#include "ism/train/training_image.hpp"

namespace toy {

/// @brief A toy picture as the library takes pictures: brightness, depth in metres, camera.
[[nodiscard]] inline ism::Frame to_frame(const ToyScene& scene) {
    return {.gray = ism::to_gray(scene.color),
            .depth_m = ism::to_metres(scene.depth_mm, 0.001),
            .camera = scene.camera};
}

/// @brief Labelled pictures of single toys to learn from: `toys` of each class, two views of each.
[[nodiscard]] inline std::vector<ism::TrainingImage> make_lessons(int toys) {
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

/// @brief A cluttered table on which no toy of make_lessons() stands.
[[nodiscard]] inline ToyScene make_test() {
    return render_cluttered(3, {.first_instance = 100});
}

/// @brief The picture of a file; a cluttered table where there is no file.
[[nodiscard]] inline ism::RgbImage read_or_render(const char* file) {
    return file != nullptr ? ism::read_rgb(file) : make_test().color;
}

}  // namespace toy
