// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

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
    const auto cell = workspace.numbers(Scratch::cell, features.size());
    const auto order = workspace.numbers(Scratch::order, features.size());
    const auto turn = workspace.numbers(Scratch::turn, features.size());
    for (std::size_t i = 0; i < features.size(); ++i) {
        const double column = std::clamp(std::floor(double(features[i].x) / side), 0.0, columns - 1);
        cell[i] = std::uint32_t(std::max(0.0, std::floor(double(features[i].y) / side)) * columns + column);
    }
    std::iota(order.begin(), order.end(), 0u);
    const auto sort_by = [&](std::span<const std::uint32_t> first) {
        std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return std::tuple(first[a], -features[a].strength, a) <
                   std::tuple(first[b], -features[b].strength, b);
        });
    };
    sort_by(cell);
    turn[order[0]] = 0;
    for (std::size_t i = 1; i < order.size(); ++i)
        turn[order[i]] = cell[order[i]] == cell[order[i - 1]] ? turn[order[i - 1]] + 1 : 0;
    sort_by(turn);
    std::sort(order.begin(), order.begin() + std::ptrdiff_t(count));
    for (std::size_t i = 0; i < count; ++i) features[i] = features[order[i]];
    features.resize(count);
}

}  // namespace ism
