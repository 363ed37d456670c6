// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ism/core/lists.hpp"
#include "ism/core/order.hpp"
#include "ism/feature/feature.hpp"
#include "ism/feature/workspace.hpp"

namespace ism {

/// @brief Keeps at most `count` features, strong and evenly spread over the image, in their order: the image
/// (width × height pixels) is cut into cells which take turns giving their strongest.
inline void keep_strongest_evenly(std::vector<Feature>& features, std::size_t count, int width, int height,
                                  Workspace& workspace) {
    if (features.size() <= count) return;
    const double area = std::max(1.0, double(width) * height);
    const double side = std::sqrt(area / std::max(1.0, double(count) / 8));
    const double columns = std::floor(width / side) + 1;
    const auto order = workspace.ranked(features.size());
    const auto dropped = workspace.numbers(Scratch::dropped, features.size());
    for (std::size_t i = 0; i < features.size(); ++i) {
        const double column = std::clamp(std::floor(double(features[i].x) / side), 0.0, columns - 1);
        const double cell = std::max(0.0, std::floor(double(features[i].y) / side)) * columns + column;
        order[i] = {detail::joined(std::uint32_t(cell), detail::falling(features[i].strength)),
                    std::uint32_t(i)};
    }
    detail::sort_ranked(order.data(), order.size());
    std::uint64_t last_cell = order.front().key >> 32;
    std::uint32_t turn = 0;
    for (detail::Ranked& next : order) {
        const std::uint64_t cell = next.key >> 32;
        if (cell != last_cell) turn = 0;
        last_cell = cell;
        next.key = detail::joined(turn++, std::uint32_t(next.key));
    }
    detail::sort_ranked(order.data(), order.size());
    std::fill(dropped.begin(), dropped.end(), 1u);
    for (const detail::Ranked& strong : order.first(count)) dropped[strong.index] = 0;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < features.size(); ++i)
        if (dropped[i] == 0) features[kept++] = features[i];
    detail::keep_first(features, kept);
}

}  // namespace ism
