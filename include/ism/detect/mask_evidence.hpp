// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "ism/core/geometry.hpp"
#include "ism/detect/detection.hpp"
#include "ism/model/model.hpp"
#include "ism/model/typical_mask.hpp"

namespace ism {

/// @brief Measures what was cut out. A large one is looked at in fewer points, so that it is as ragged as a
/// small one.
/// @param box  of the object, pixels of the image
[[nodiscard]] inline MaskMeasures measure_mask(const Segmentation& part, const Box& box) {
    constexpr int longest = 320;  // side, points
    const Mask& mask = part.mask;
    const double step = std::max(1.0, std::max(mask.width(), mask.height()) / double(longest));
    const int columns = int(mask.width() / step), rows = int(mask.height() / step);
    const auto pixel = [&](int point) { return int((point + 0.5) * step); };
    const auto covers = [&](int column, int row) {
        return column >= 0 && row >= 0 && column < columns && row < rows &&
               mask(pixel(column), pixel(row)) != 0;
    };
    double area = 0, perimeter = 0, covered = 0, certainty = 0, inside = 0;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const bool figure = covers(column, row);
            if (figure) {
                area += 1;
                for (const auto& [right, down] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
                    perimeter += covers(column + right, row + down) ? 0 : 1;
            }
            const int x = pixel(column), y = pixel(row);
            const double px = part.x + x + 0.5 - box.x, py = part.y + y + 0.5 - box.y;
            if (!(px >= 0 && py >= 0 && px < box.width && py < box.height)) continue;
            inside += 1, covered += figure;
            certainty += std::abs(2 * double(part.figure(x, y)) - 1);
        }
    return {.extent = covered / std::max(1.0, inside),
            .certainty = certainty / std::max(1.0, inside),
            .raggedness = std::log(std::max(1.0, perimeter * perimeter) / std::max(1.0, area))};
}

/// @brief What a measure of a mask adds to the logarithm of the odds for each squared deviation from its
/// class, and how many of these count at most: chosen on halves of the training images of four sets.
inline constexpr double mask_weight = 0.15, most_sq_deviation = 9;
/// @brief The most that mask_log_odds() gives.
inline constexpr double most_mask_log_odds = 3 * mask_weight;

/// @brief What a mask adds to the logarithm of the odds that it shows an object of a class: nothing where it
/// is as unlike the mean as objects of the class are, more where it is more like it, less where it is less
/// so.
/// @param typical  known()
[[nodiscard]] inline double mask_log_odds(const MaskMeasures& mask, const TypicalMask& typical) {
    const auto values = mask.values(), means = typical.mean.values(), deviations = typical.deviation.values();
    double sum = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        const double off = (values[k] - means[k]) / deviations[k];
        sum += mask_weight * (1 - std::min(most_sq_deviation, off * off));
    }
    return sum;
}

/// @brief Lets what was cut out speak for or against an object that templates judged: what they take for one
/// by chance is mostly cut out as no object of the class is. Where the class's masks are not known nothing
/// changes.
inline void weigh_mask(Detection& detection, const Model& model) {
    const std::uint32_t c = detection.class_index;
    if (detection.box_reasons.empty() || c >= model.typical_masks.size()) return;
    const TypicalMask& typical = model.typical_masks[c];
    const double slope = model.template_calibration.curves[c].slope;
    if (!typical.known() || !(slope > 0)) return;
    const double before = detection.box_reasons.mask,
                 now = mask_log_odds(measure_mask(detection.segmentation, detection.box), typical);
    detection.box_reasons.mask = now;
    detection.score *= std::exp((now - before) / slope);
    detection.probability = model.template_calibration.probability(c, detection.score);
}

}  // namespace ism
