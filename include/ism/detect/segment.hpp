// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/detect/detection.hpp"
#include "ism/model/occurrence.hpp"
#include "ism/vote/axes.hpp"

namespace ism {

/// @brief How an object is cut out.
struct SegmentOptions {
    double patch_radius = 6;  ///< half a side of a mask patch, in units of the feature's scale
    double margin = 0.1;      ///< how far beyond the box to look, in parts of its sides
    int max_cells = 64;       ///< the maps are computed on at most so many points a side, then interpolated
};

namespace detail {

/// Share of figure, 0 … 1, of a training object at (x, y) from its centre, pixels of the reference size.
[[nodiscard]] inline float figure_share(const TrainingObject& object, float x, float y) {
    const Mask& mask = object.mask;
    const float column = (x / object.width + 0.5f) * static_cast<float>(mask.width()) - 0.5f;
    const float row = (y / object.height + 0.5f) * static_cast<float>(mask.height()) - 0.5f;
    const float c0 = std::floor(column), r0 = std::floor(row);
    if (!(c0 >= -1 && r0 >= -1 && c0 < static_cast<float>(mask.width()) &&
          r0 < static_cast<float>(mask.height())))
        return 0;
    const int c = static_cast<int>(c0), r = static_cast<int>(r0);
    const float ac = column - c0, ar = row - r0;
    const auto at = [&](int i, int j) { return mask.contains(i, j) ? static_cast<float>(mask(i, j)) : 0.0f; };
    return ((1 - ar) * ((1 - ac) * at(c, r) + ac * at(c + 1, r)) +
            ar * ((1 - ac) * at(c, r + 1) + ac * at(c + 1, r + 1))) /
           255.0f;
}

}  // namespace detail

/// @brief Cuts out an object top-down: each vote of its support lays the mask patch of its occurrence over
/// the feature, scaled as the vote says; figure and ground at a pixel are the sums of weight · mask and
/// weight · (1 − mask), and the mask is where figure outweighs ground (Leibe et al. 2008, section 5).
/// The part of the picture around `box` is looked at.
/// @param support  votes of one class only (Eq 5 and after: others are false positives)
[[nodiscard]] inline Segmentation segment(std::span<const Feature> features, const Shapes& shapes,
                                          std::span<const Support> support, const Box& box, int picture_width,
                                          int picture_height, const SegmentOptions& options = {}) {
    const double mx = options.margin * box.width, my = options.margin * box.height;
    const auto inside = [](double px, int end) {
        return static_cast<int>(std::clamp(px, 0.0, static_cast<double>(end)));
    };
    const int left = inside(std::floor(box.x - mx), picture_width - 1);
    const int top = inside(std::floor(box.y - my), picture_height - 1);
    const int width = std::max(1, inside(std::ceil(box.x + box.width + mx), picture_width) - left);
    const int height = std::max(1, inside(std::ceil(box.y + box.height + my), picture_height) - top);
    const int step = std::max(1, (std::max(width, height) + options.max_cells - 1) / options.max_cells);
    GrayImage figure((width + step - 1) / step, (height + step - 1) / step), ground = figure;

    // Several words may vote through the same training feature: one patch with their weights together.
    std::vector<Support> patches(support.begin(), support.end());
    const auto key = [&](const Support& s) {
        return std::pair(s.feature, shapes.occurrences[s.occurrence].feature);
    };
    std::stable_sort(patches.begin(), patches.end(),
                     [&](const Support& a, const Support& b) { return key(a) < key(b); });
    std::size_t count = 0;
    double total = 0;
    for (const Support& patch : patches) {
        total += patch.weight;
        if (count > 0 && key(patches[count - 1]) == key(patch))
            patches[count - 1].weight += patch.weight;
        else
            patches[count++] = patch;
    }
    patches.resize(count);

    for (const Support& patch : patches) {
        const Feature& f = features[patch.feature];
        const Occurrence& o = shapes.occurrences[patch.occurrence];
        const TrainingObject& object = shapes.objects[o.object];
        const double radius = options.patch_radius * f.scale;
        const auto to_reference = static_cast<float>(1 / scale_ratio(f, o));
        const auto weight = static_cast<float>(patch.weight / total);
        const auto cell = [&](double px, int cells) {
            return static_cast<int>(std::clamp(std::ceil(px / step), 0.0, static_cast<double>(cells)));
        };
        const int x0 = cell(f.x - radius - left, figure.width()),
                  x1 = cell(f.x + radius - left, figure.width());
        const int y0 = cell(f.y - radius - top, figure.height()),
                  y1 = cell(f.y + radius - top, figure.height());
        for (int y = y0; y < y1; ++y) {
            const float v = o.y + (static_cast<float>(top + y * step) - f.y) * to_reference;
            for (int x = x0; x < x1; ++x) {
                const float u = o.x + (static_cast<float>(left + x * step) - f.x) * to_reference;
                const float share = detail::figure_share(object, u, v);
                figure(x, y) += weight * share;
                ground(x, y) += weight * (1 - share);
            }
        }
    }

    Segmentation result{.x = left, .y = top, .figure = {}, .ground = {}, .mask = Mask(width, height)};
    if (step == 1) {
        result.figure = std::move(figure), result.ground = std::move(ground);
    } else {
        result.figure = GrayImage(width, height), result.ground = GrayImage(width, height);
        const float to_cell = 1.0f / static_cast<float>(step);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const float cx = static_cast<float>(x) * to_cell, cy = static_cast<float>(y) * to_cell;
                result.figure(x, y) = sample_bilinear(figure, cx, cy);
                result.ground(x, y) = sample_bilinear(ground, cx, cy);
            }
    }
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) result.mask(x, y) = result.figure(x, y) > result.ground(x, y);
    return result;
}

}  // namespace ism
