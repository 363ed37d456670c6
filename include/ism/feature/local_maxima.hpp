// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "ism/core/image.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/order.hpp"
#include "ism/feature/feature.hpp"
#include "ism/feature/workspace.hpp"

namespace ism::detail {

/// Out of `value` and its eight neighbours: whether it is the largest. Of equal neighbours the first in
/// reading order counts as larger, so that a flat top of several pixels gives one maximum.
[[nodiscard]] inline bool is_maximum(ImageView<const float> image, int x, int y) {
    const float value = image(x, y);
    return value > image(x - 1, y - 1) && value > image(x, y - 1) && value > image(x + 1, y - 1) &&
           value > image(x - 1, y) && value >= image(x + 1, y) && value >= image(x - 1, y + 1) &&
           value >= image(x, y + 1) && value >= image(x + 1, y + 1);
}

/// Top of the parabola through three neighbouring values, relative to the middle one; within ±0.5 where that
/// is the largest.
[[nodiscard]] inline float parabola_top(float before, float middle, float after) {
    const float curvature = before - 2 * middle + after;
    return curvature < 0 ? std::clamp(0.5f * (before - after) / curvature, -0.5f, 0.5f) : 0.0f;
}

/// Where between the pixels the maximum near (x, y) lies: top of the quadratic through its neighbours.
struct SubPixel {
    float dx = 0, dy = 0, value = 0;
};
[[nodiscard]] inline SubPixel refine_maximum(ImageView<const float> image, int x, int y) {
    const float value = image(x, y);
    const float gx = 0.5f * (image(x + 1, y) - image(x - 1, y));
    const float gy = 0.5f * (image(x, y + 1) - image(x, y - 1));
    const float xx = image(x + 1, y) - 2 * value + image(x - 1, y);
    const float yy = image(x, y + 1) - 2 * value + image(x, y - 1);
    const float xy =
        0.25f * (image(x + 1, y + 1) - image(x - 1, y + 1) - image(x + 1, y - 1) + image(x - 1, y - 1));
    const float det = xx * yy - xy * xy;
    if (!(det > 1e-6f * xx * xx)) return {0, 0, value};
    const float dx = std::clamp((xy * gy - yy * gx) / det, -1.0f, 1.0f);
    const float dy = std::clamp((xy * gx - xx * gy) / det, -1.0f, 1.0f);
    return {dx, dy, value + 0.5f * (gx * dx + gy * dy)};
}

/// The features of all lists, from small scales to large, each octave of scales from top to bottom, without
/// repetitions: the same however they are spread over the lists.
[[nodiscard]] inline std::vector<Feature> in_order(const std::vector<std::vector<Feature>>& lists,
                                                   Workspace& workspace) {
    std::vector<Feature> found = workspace.empty_list(), all = workspace.empty_list();
    for (const std::vector<Feature>& list : lists)
        for (const Feature& f : list) found.push_back(f);
    const auto order = workspace.ranked(found.size());
    for (std::uint32_t i = 0; i < order.size(); ++i)
        order[i] = {joined(std::bit_cast<std::uint32_t>(found[i].scale) >> 23, rising(found[i].y)), i};
    sort_ranked(order.data(), order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        all.push_back(found[order[i].index]);
        // few are of one octave and one row
        for (std::size_t k = i; k > 0 && order[k - 1].key == order[i].key; --k) {
            Feature &before = all[k - 1], &after = all[k];
            const auto key = [](const Feature& f) { return joined(rising(f.x), rising(f.scale)); };
            if (key(before) < key(after) || (key(before) == key(after) && before.strength <= after.strength))
                break;
            std::swap(before, after);
        }
    }
    workspace.reuse(std::move(found));
    std::size_t kept = 0;
    for (const Feature& f : all)
        if (kept == 0 || f.y != all[kept - 1].y || f.x != all[kept - 1].x || f.scale != all[kept - 1].scale)
            all[kept++] = f;
    keep_first(all, kept);
    return all;
}

/// Drops each feature that lies within `radius` scales of a stronger one which stays and whose scale differs
/// by less than `ratio`; the others stay in order.
inline void drop_duplicates(std::vector<Feature>& features, float radius, float ratio, Workspace& workspace) {
    const std::size_t count = features.size();
    const auto by_y = workspace.numbers(Scratch::order, count);
    const auto place = workspace.numbers(Scratch::place, count);
    const auto order = workspace.ranked(count);
    const auto dropped = workspace.numbers(Scratch::dropped, count);
    std::fill(dropped.begin(), dropped.end(), 0u);
    for (std::uint32_t i = 0; i < count; ++i) order[i] = {rising(features[i].y), i};
    sort_ranked(order.data(), order.size());
    for (std::uint32_t i = 0; i < count; ++i) by_y[i] = order[i].index, place[by_y[i]] = i;
    for (std::uint32_t i = 0; i < count; ++i) order[i] = {falling(features[i].strength), i};
    sort_ranked(order.data(), order.size());
    for (const Ranked& strongest : order) {
        const std::uint32_t i = strongest.index;
        if (dropped[i] != 0) continue;
        const Feature& strong = features[i];
        const float reach = radius * strong.scale;
        const auto drop_near = [&](std::uint32_t j) {
            const Feature& f = features[j];
            const float dx = f.x - strong.x, dy = f.y - strong.y;
            if (std::fabs(dy) > reach) return false;
            if (dx * dx + dy * dy <= reach * reach && f.scale < strong.scale * ratio &&
                strong.scale < f.scale * ratio)
                dropped[j] = 1;
            return true;
        };
        for (std::size_t k = place[i] + std::size_t(1); k < count && drop_near(by_y[k]); ++k) continue;
        for (std::size_t k = place[i]; k > 0 && drop_near(by_y[k - 1]); --k) continue;
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i)
        if (dropped[i] == 0) features[kept++] = features[i];
    keep_first(features, kept);
}

}  // namespace ism::detail
