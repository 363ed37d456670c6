// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "support/many_classes.hpp"
#include "toy/cluttered.hpp"
#include "toy/isolated.hpp"
#include "toy_lessons.hpp"

#include "ism/core/thread_pool.hpp"

namespace bench {

/// @brief Rendered toys, each a class that is learnt from two views; pictures are cluttered tables with toys
/// of the first 16 classes, most of them twice as far or half hidden. Class i is toy i / 4 of kind i % 4, and
/// a toy differs from others of its kind in shape and print.
[[nodiscard]] inline ManyClasses toy_classes(std::size_t count) {
    const std::size_t kinds = toy::class_names().size();
    ManyClasses result{.what = "toys as classes, two views each (synthetic)"};
    for (std::size_t c = 0; c < count; ++c)
        result.names.push_back(toy::class_names()[c % kinds] + " " + std::to_string(c / kinds));
    result.images.resize(2 * count);
    ism::parallel_for(result.images.size(), 0, [&](std::size_t i) {
        const std::size_t c = i / 2, kind = c % kinds;
        const toy::ToyView view{.turn_deg = (i % 2 == 0 ? -0.5 : 0.5) * toy::largest_turn_deg(kind),
                                .seed = i + 1};
        const toy::ToyScene scene =
            toy::render_isolated(kind, int(c / kinds), view, {.width = 320, .height = 240});
        result.images[i] = {.frame = {.gray = ism::to_gray(scene.color)},
                            .objects = {{.class_index = std::uint32_t(c),
                                         .box = scene.objects.front().box,
                                         .mask = scene.objects.front().mask}},
                            .name = result.names[c]};
    });
    result.checks.resize(16);
    ism::parallel_for(result.checks.size(), 0, [&](std::size_t i) {
        const toy::ToyScene scene = toy::render_cluttered(1000 + i, {.instances = 4});
        result.checks[i].frame = {.gray = ism::to_gray(scene.color)};
        for (const toy::ToyObject& object : scene.objects)
            result.checks[i].objects.push_back(
                {.class_index = std::uint32_t(std::size_t(object.instance) * kinds + object.class_index),
                 .box = object.box});
    });
    for (std::size_t i = 0; i < 8; ++i) result.frames.push_back(result.checks[i].frame);
    return result;
}

}  // namespace bench
