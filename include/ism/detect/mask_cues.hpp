// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ism/core/geometry.hpp"
#include "ism/core/region_mask.hpp"
#include "ism/depth/region_outline.hpp"
#include "ism/depth/shape_histogram.hpp"
#include "ism/detect/detection.hpp"
#include "ism/detect/scene.hpp"
#include "ism/model/mask_judge.hpp"

namespace ism {

/// @brief The colours of a region: hue and value where saturation is above a fifth, else value alone.
[[nodiscard]] inline std::array<float, color_histogram_bins> color_histogram(ImageView<const Rgb> color,
                                                                             const RegionMask& region) {
    std::array<float, color_histogram_bins> histogram{};
    float pixels = 0;
    for (int j = 0; j < region.mask.height(); ++j)
        for (int i = 0; i < region.mask.width(); ++i) {
            if (region.mask(i, j) == 0) continue;
            const Rgb c = color(region.x + i, region.y + j);
            const int most = std::max({c.r, c.g, c.b}), least = std::min({c.r, c.g, c.b}),
                      range = most - least;
            std::size_t bin = 36 + std::size_t(most) * 6 / 256;
            if (5 * range > most) {
                float hue = 0;  // in sixths of the circle
                if (most == c.r)
                    hue = float(c.g - c.b) / float(range) + (c.g < c.b ? 6.0f : 0.0f);
                else if (most == c.g)
                    hue = float(c.b - c.r) / float(range) + 2;
                else
                    hue = float(c.r - c.g) / float(range) + 4;
                bin = std::min<std::size_t>(11, std::size_t(2 * hue)) * 3 + std::size_t(most) * 3 / 256;
            }
            histogram[bin] += 1, pixels += 1;
        }
    for (float& bin : histogram) bin = pixels > 0 ? std::sqrt(bin / pixels) : 0;
    return histogram;
}

/// @brief What a region of a scene with a surface looks like.
[[nodiscard]] inline MaskLook describe_mask(const Scene& scene, ImageView<const Rgb> color,
                                            const RegionMask& region, double shape_bin_m) {
    return {.color = color_histogram(color, region),
            .shape = shape_histogram(*scene.surface, region, shape_bin_m)};
}

/// @brief What the votes say of a region for one class: the hypothesis of which the most weight lies in it.
/// Numbers are per feature of the region that can vote, so that they are those of the same thing further
/// away, where it has fewer features; a region of very few has smaller ones.
struct RegionVotes {
    double weight = 0;           ///< of the votes in the region, the most of a hypothesis
    double fitting = 0;          ///< the most of weight · IoU of the boxes of hypothesis and region
    double features = 0;         ///< that cast that weight, 0 … 1
    std::size_t hypothesis = 0;  ///< whose votes they are; only with a weight
};

/// @brief The votes of the hypotheses in a region, of each class.
[[nodiscard]] inline std::vector<RegionVotes> region_votes(const Scene& scene,
                                                           std::span<const Detection> hypotheses,
                                                           const RegionMask& region) {
    std::vector<RegionVotes> of_class(scene.model.shapes.class_names.size());
    const auto lies_in_region = [&](const Feature& f) {
        return contains(region, int(std::lround(f.x)), int(std::lround(f.y)));
    };
    double each = 4;  // so that one vote of one feature is no certainty
    for (std::size_t f = 0; f < scene.features.size(); ++f)
        if (scene.frames[f] && lies_in_region(scene.features[f])) each += 1;
    for (std::size_t h = 0; h < hypotheses.size(); ++h) {
        const Detection& hypothesis = hypotheses[h];
        double weight = 0, features = 0;
        for (const Support& s : hypothesis.support)
            if (lies_in_region(scene.features[s.feature])) weight += s.weight / each, features += 1 / each;
        if (!(weight > 0)) continue;
        RegionVotes& votes = of_class[hypothesis.class_index];
        votes.fitting = std::max(votes.fitting, weight * iou(hypothesis.box, box_of(region)));
        if (weight > votes.weight) votes.weight = weight, votes.features = features, votes.hypothesis = h;
    }
    return of_class;
}

/// @brief How unlike a region is to the nearest examples of a class.
struct LookDistance {
    double sq_color = far, sq_shape = far;      ///< of the nearest by each alone
    double sq_both = far, sq_three_both = far;  ///< by both, of the nearest one and the mean of three
    std::optional<std::uint32_t> color_example = {}, shape_example = {};  ///< the nearest by each alone
    static constexpr double far = 4;
};

/// @brief The distances to the nearest examples of each class, and last to those of background.
/// @param without_first, without_end  examples that are not looked at, in training those of the same image
[[nodiscard]] inline std::vector<LookDistance> look_distances(const MaskLook& look,
                                                              std::span<const MaskExample> examples,
                                                              std::size_t classes,
                                                              std::size_t without_first = 0,
                                                              std::size_t without_end = 0) {
    std::vector<LookDistance> nearest(classes + 1);
    std::vector<std::array<double, 3>> three(classes + 1,
                                             {LookDistance::far, LookDistance::far, LookDistance::far});
    const auto sq_distance = [](const auto& a, const auto& b) {
        float sum = 0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
        return double(sum);
    };
    for (std::size_t e = 0; e < examples.size(); ++e) {
        if (e >= without_first && e < without_end) continue;
        const MaskExample& example = examples[e];
        const std::size_t c = std::min<std::size_t>(example.class_index, classes);
        const double color = sq_distance(look.color, example.look.color);
        const double shape = sq_distance(look.shape, example.look.shape), both = color + shape;
        LookDistance& own = nearest[c];
        if (color < own.sq_color) own.sq_color = color, own.color_example = std::uint32_t(e);
        if (shape < own.sq_shape) own.sq_shape = shape, own.shape_example = std::uint32_t(e);
        auto& [first, second, third] = three[c];
        if (both < first)
            third = second, second = first, first = both;
        else if (both < second)
            third = second, second = both;
        else
            third = std::min(third, both);
    }
    for (std::size_t c = 0; c <= classes; ++c) {
        nearest[c].sq_both = three[c][0];
        nearest[c].sq_three_both = (three[c][0] + three[c][1] + three[c][2]) / 3;
    }
    return nearest;
}

/// @brief What speaks for a class in a region, as numbers: its votes (five), then how near it looks to
/// examples of the class, how much nearer than to those of other classes and to those of background, by
/// colour, shape, and both together.
[[nodiscard]] inline MaskCues mask_cues(std::span<const RegionVotes> votes,
                                        std::span<const LookDistance> looks, const RegionOutline& outline,
                                        std::size_t class_index) {
    const std::size_t classes = votes.size();
    double rival = 0, all = 0;
    for (std::size_t c = 0; c < classes; ++c) {
        all += votes[c].fitting;
        if (c != class_index) rival = std::max(rival, votes[c].fitting);
    }
    const RegionVotes& own = votes[class_index];
    MaskCues cues{};
    std::size_t at = 0;
    const auto add = [&](double value) { cues[at++] = static_cast<float>(value); };
    add(std::log1p(80 * own.fitting));
    add(std::log1p(50 * own.weight));
    add(own.features);
    add(std::log1p(80 * rival));
    add(own.fitting / (all + 0.002));  // vote_cue_count so far
    for (const auto distance : {&LookDistance::sq_color, &LookDistance::sq_shape, &LookDistance::sq_both,
                                &LookDistance::sq_three_both}) {
        double other = LookDistance::far;
        for (std::size_t c = 0; c < classes; ++c)
            if (c != class_index) other = std::min(other, looks[c].*distance);
        const double near = std::sqrt(looks[class_index].*distance);
        add(near);
        add(std::sqrt(other) - near);
        add(std::sqrt(looks[classes].*distance) - near);
    }
    add(outline.continued);
    add(outline.hidden);
    add(std::log1p(100 * outline.broken));
    return cues;
}

}  // namespace ism
