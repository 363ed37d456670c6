// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ism/core/callable.hpp"
#include "ism/core/order.hpp"
#include "ism/feature/feature.hpp"
#include "ism/feature/scale_space.hpp"
#include "ism/feature/workspace.hpp"

namespace ism::detail {

/// The features whose surroundings lie in one octave that is held in bands, from top to bottom.
struct FeaturesOfOctave {
    std::size_t next = 0, end = 0;  // of their order
    int rows_around = 0;            // that are looked at
};

/// Calls body(i) for every feature, on many threads, while the scale space holds what is looked at around it:
/// pixels of sampling() or nearest_level() of level_scale(feature), at most `reach` scales away. Octaves that
/// are held in bands are made once more.
template <class LevelScale, Callable<std::size_t> Body>
requires Callable<LevelScale, const Feature&>
void for_each_feature(ScaleSpace& space, const std::vector<Feature>& features, float reach,
                      const LevelScale& level_scale, Workspace& workspace, const Body& body) {
    constexpr std::size_t features_per_task = 32;
    const auto each_of = [&](std::size_t count, const auto& index) {
        workspace.pool().for_each((count + features_per_task - 1) / features_per_task,
                                  [&](std::size_t task, unsigned) {
                                      const std::size_t first = task * features_per_task;
                                      const std::size_t end = std::min(count, first + features_per_task);
                                      for (std::size_t i = first; i < end; ++i) body(index(i));
                                  });
    };
    const int banded = space.banded_octaves();
    if (banded == 0) return each_of(features.size(), [](std::size_t i) { return i; });

    const auto order = workspace.ranked(features.size());
    std::array<FeaturesOfOctave, max_scale_octaves> parts{};
    for (std::size_t i = 0; i < features.size(); ++i) {
        const int o = space.nearest_level(level_scale(features[i])).octave;
        const auto held = std::uint32_t(std::min(o, banded));
        order[i] = {joined(held, rising(features[i].y)), std::uint32_t(i)};
        FeaturesOfOctave& part = parts[held];
        ++part.end;
        const float rows = std::ceil(std::min(1e6f, reach * features[i].scale / space.step(o)));
        part.rows_around = std::max(part.rows_around, int(rows) + 4);
    }
    sort_ranked(order.data(), order.size());
    for (std::size_t o = 1; o < parts.size(); ++o)
        parts[o].next = parts[o - 1].end, parts[o].end += parts[o].next;
    const auto run = [&](FeaturesOfOctave& part, std::size_t end) {
        each_of(end - part.next, [&](std::size_t i) { return order[part.next + i].index; });
        part.next = end;
    };
    run(parts[std::size_t(banded)], parts[std::size_t(banded)].end);
    for (space.rewind(); space.advance(workspace);)
        for (int o = 0; o < banded; ++o) {
            FeaturesOfOctave& part = parts[std::size_t(o)];
            const int height = space.level_height(o), ready = space.rows_ready(o);
            const auto row = [&](std::size_t i) { return int(features[order[i].index].y / space.step(o)); };
            std::size_t end = part.next;
            while (end < part.end && (ready == height || row(end) + part.rows_around < ready)) ++end;
            run(part, end);
            space.forget(o, end < part.end ? row(end) - part.rows_around : height);
        }
}

}  // namespace ism::detail
