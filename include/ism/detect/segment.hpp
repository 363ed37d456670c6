// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/order.hpp"
#include "ism/detect/detection.hpp"
#include "ism/detect/scene.hpp"
#include "ism/vote/placement.hpp"

namespace ism {

/// @brief Cuts hypotheses out. To model it, write a small struct with its options as members and
/// `Segmentation segment(const Detection& hypothesis, const Scene&) const`, which is called from several
/// threads at once. Options are validated by `void check(const S&)` where there is one. What was cut out may
/// change how probable the detections of an image are: by `void judge(std::vector<Detection>&, const Scene&)
/// const` and `static constexpr double most_log_odds`, the most that it adds to the logarithm of the odds.
template <class S>
concept Segmenter = std::copyable<S> &&
    requires(const S& segmenter, const Detection& hypothesis, const Scene& scene) {
    { segmenter.segment(hypothesis, scene) } -> std::same_as<Segmentation>;
};

/// @brief Cuts an object out top-down, by its votes: each lays the mask patch of its occurrence over its
/// feature, placed as the vote says; figure and ground at a pixel are the sums of weight · mask and
/// weight · (1 − mask), and the mask is where figure outweighs ground (Leibe et al. 2008, section 5).
struct PatchSegmenter {
    double patch_radius = 6;  ///< half a side of a mask patch, in units of the feature's scale
    double margin = 0.1;      ///< how far beyond the box to look, in parts of its sides
    int max_cells = 64;       ///< the maps are computed on at most so many points a side, then interpolated

    [[nodiscard]] Segmentation segment(const Detection& hypothesis, const Scene& scene) const;
};

/// @brief Validates options.
/// @throws Error for one out of range.
inline void check(const PatchSegmenter& options) {
    expect(options.patch_radius > 0 && options.patch_radius <= 1000, "PatchSegmenter::patch_radius",
           "above 0, at most 1000", options.patch_radius);
    expect(options.margin >= 0 && options.margin <= 10, "PatchSegmenter::margin", "0 ... 10", options.margin);
    expect(options.max_cells >= 1 && options.max_cells <= 65536, "PatchSegmenter::max_cells", "1 ... 65536",
           options.max_cells);
}

namespace detail {

/// Several words may vote through the same training feature: one patch with their weights together, which
/// add up to 1 over all patches.
[[nodiscard]] inline std::vector<Support> joined_patches(const std::vector<Support>& support,
                                                         const ShapeModel& shapes) {
    std::vector<Support> patches(support.begin(), support.end());
    const auto key = [&](const Support& s) {
        return joined(s.feature, shapes.occurrence(s.occurrence).feature);
    };
    sort_by(patches, key);
    std::size_t count = 0;
    double total = 0;
    for (const Support& patch : patches) {
        total += patch.weight;
        if (count > 0 && key(patches[count - 1]) == key(patch))
            patches[count - 1].weight += patch.weight;
        else
            patches[count++] = patch;
    }
    keep_first(patches, count);
    for (Support& patch : patches) patch.weight = static_cast<float>(patch.weight / total);
    return patches;
}

}  // namespace detail

namespace detail {

/// Figure and ground of a part of an image, in cells of `step` pixels.
struct VotedMaps {
    int left = 0, top = 0, step = 1;  ///< pixels
    GrayImage figure, ground;

    /// Adds what a patch of this radius says by the mask of the training object that it was seen on.
    void add(float weight, const Feature& f, double radius_px, const Placement& placed,
             const TrainingObject& object) {
        const auto cell = [&](double px, int cells) {
            return static_cast<int>(std::clamp(std::ceil(px / step), 0.0, static_cast<double>(cells)));
        };
        const int x0 = cell(f.x - radius_px - left, figure.width()),
                  x1 = cell(f.x + radius_px - left, figure.width());
        const int y0 = cell(f.y - radius_px - top, figure.height()),
                  y1 = cell(f.y + radius_px - top, figure.height());
        // On the object a step to the right is (dx.x, dx.y), whatever it is turned by.
        const Point2 origin = to_object(placed, {double(left), double(top)});
        const Point2 right = to_object(placed, {double(left + step), double(top)});
        const Point2 down = to_object(placed, {double(left), double(top + step)});
        const Point2 dx{right.x - origin.x, right.y - origin.y}, dy{down.x - origin.x, down.y - origin.y};
        for (int y = y0; y < y1; ++y)
            for (int x = x0; x < x1; ++x) {
                const float share = figure_share(object, static_cast<float>(origin.x + x * dx.x + y * dy.x),
                                                 static_cast<float>(origin.y + x * dx.y + y * dy.y));
                figure(x, y) += weight * share;
                ground(x, y) += weight * (1 - share);
            }
    }
};

/// Cells of `step` pixels in the image's resolution.
[[nodiscard]] inline GrayImage interpolated(const GrayImage& cells, int step, int width, int height) {
    GrayImage image(width, height);
    const float to_cell = 1.0f / static_cast<float>(step);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image(x, y) =
                sample_bilinear(cells, static_cast<float>(x) * to_cell, static_cast<float>(y) * to_cell);
    return image;
}

}  // namespace detail

inline Segmentation PatchSegmenter::segment(const Detection& hypothesis, const Scene& scene) const {
    const Box& box = hypothesis.box;
    const int image_width = scene.frame.gray.width(), image_height = scene.frame.gray.height();
    const double mx = margin * box.width, my = margin * box.height;
    const auto inside = [](double px, int end) {
        return static_cast<int>(std::clamp(px, 0.0, static_cast<double>(end)));
    };
    const int left = inside(std::floor(box.x - mx), image_width - 1);
    const int top = inside(std::floor(box.y - my), image_height - 1);
    const int width = std::max(1, inside(std::ceil(box.x + box.width + mx), image_width) - left);
    const int height = std::max(1, inside(std::ceil(box.y + box.height + my), image_height) - top);
    const int step = std::max(1, (std::max(width, height) + max_cells - 1) / max_cells);
    const GrayImage none((width + step - 1) / step, (height + step - 1) / step);
    detail::VotedMaps maps{left, top, step, none, none};
    const ShapeModel& shapes = scene.model.shapes;
    for (const Support& patch : detail::joined_patches(hypothesis.support, shapes)) {
        const Feature& f = scene.features[patch.feature];
        const Occurrence& o = shapes.occurrence(patch.occurrence);
        maps.add(patch.weight, f, patch_radius * f.scale, placement(f, o), shapes.objects[o.object]);
    }
    Segmentation result{.x = left,
                        .y = top,
                        .figure = detail::interpolated(maps.figure, step, width, height),
                        .ground = detail::interpolated(maps.ground, step, width, height),
                        .mask = Mask(width, height)};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) result.mask(x, y) = result.figure(x, y) > result.ground(x, y);
    return result;
}

}  // namespace ism
