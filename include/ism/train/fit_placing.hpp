// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "ism/core/geometry.hpp"
#include "ism/model/placing.hpp"

namespace ism {

/// @brief An object: the box that was judged on an image that the judges had not seen, that of the mask which
/// was cut out in it, and that of its label.
struct PlacedBox {
    Box judged = {}, mask = {}, label = {};
};

namespace detail {

/// How far a side of the mask and of the label is from that of the judged box, in parts of the latter's side.
struct SideOffsets {
    double mask = 0, label = 0;
};

/// The side that fits offsets best: a linear regression where errors count in proportion and not by their
/// squares once they are large (Huber 1964, by reweighting), drawn towards the usual way as by a few
/// examples.
[[nodiscard]] inline Placing::Side fit_side(std::span<const SideOffsets> offsets) {
    constexpr double worth = 5;          // examples
    constexpr double sq_spread = 0.004;  // of the mask's offsets in an example of the usual kind
    constexpr double large_error = 0.02;
    const Placing::Side usual;
    double share = usual.share, offset = usual.offset;
    for (int round = 0; round < 20; ++round) {
        double count = worth, sum_x = 0, sum_y = 0, xx = worth * sq_spread, xy = xx * usual.share;
        for (const auto& [x, y] : offsets) {
            const double error = std::abs(y - share * x - offset);
            const double weight = large_error / std::max(error, large_error);
            count += weight, sum_x += weight * x, sum_y += weight * y;
            xx += weight * x * x, xy += weight * x * y;
        }
        share = (count * xy - sum_x * sum_y) / (count * xx - sum_x * sum_x);
        offset = (sum_y - share * sum_x) / count;
    }
    if (share < 0 || share > 1) {  // as far as may be, and the mean offset that is left
        share = std::clamp(share, 0.0, 1.0), offset = 0;
        double sum = 0;
        for (const auto& [x, y] : offsets) sum += std::clamp(y - share * x, -large_error, large_error);
        offset = sum / (worth + double(offsets.size()));
    }
    return {share, std::clamp(offset, -most_placing_offset, most_placing_offset)};
}

}  // namespace detail

/// @brief Learns from objects of a class where its boxes lie. Of few objects it is drawn towards the mask's.
[[nodiscard]] inline Placing fit_placing(std::span<const PlacedBox> objects) {
    std::array<std::vector<detail::SideOffsets>, 4> offsets;
    for (const auto& [judged, mask, label] : objects) {
        const auto add = [](std::vector<detail::SideOffsets>& side, double from, double by_mask,
                            double by_label, double length) {
            side.push_back({(by_mask - from) / length, (by_label - from) / length});
        };
        add(offsets[0], judged.x, mask.x, label.x, judged.width);
        add(offsets[1], judged.y, mask.y, label.y, judged.height);
        add(offsets[2], judged.x + judged.width, mask.x + mask.width, label.x + label.width, judged.width);
        add(offsets[3], judged.y + judged.height, mask.y + mask.height, label.y + label.height,
            judged.height);
    }
    Placing placing;
    for (std::size_t side = 0; side < offsets.size(); ++side)
        placing.sides[side] = detail::fit_side(offsets[side]);
    return placing;
}

}  // namespace ism
