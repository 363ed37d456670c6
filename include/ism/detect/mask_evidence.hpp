// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "ism/core/geometry.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/detection.hpp"
#include "ism/detect/rivals.hpp"
#include "ism/model/model.hpp"
#include "ism/model/typical_mask.hpp"

namespace ism {

/// @brief Measures what was cut out, with specks that its mask leaves out. A large one is looked at in fewer
/// points, so that it is as ragged as a small one.
/// @param box  of the object, pixels of the image
[[nodiscard]] inline MaskMeasures measure_mask(const Segmentation& part, const Box& box) {
    constexpr int longest = 320;  // side, points
    const GrayImage& figure = part.figure;
    const double step = std::max(1.0, std::max(figure.width(), figure.height()) / double(longest));
    const int columns = int(figure.width() / step), rows = int(figure.height() / step);
    const auto pixel = [&](int point) { return int((point + 0.5) * step); };
    const auto covers = [&](int column, int row) {
        return column >= 0 && row >= 0 && column < columns && row < rows &&
               figure(pixel(column), pixel(row)) > 0.5f;
    };
    double area = 0, perimeter = 0, figure_inside = 0, certainty = 0, inside = 0;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const bool covered = covers(column, row);
            if (covered) {
                area += 1;
                for (const auto& [right, down] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
                    perimeter += covers(column + right, row + down) ? 0 : 1;
            }
            const int x = pixel(column), y = pixel(row);
            const double px = part.x + x + 0.5 - box.x, py = part.y + y + 0.5 - box.y;
            if (!(px >= 0 && py >= 0 && px < box.width && py < box.height)) continue;
            inside += 1, figure_inside += covered;
            certainty += std::abs(2 * double(figure(x, y)) - 1);
        }
    return {.extent = figure_inside / std::max(1.0, inside),
            .certainty = certainty / std::max(1.0, inside),
            .raggedness = std::log(std::max(1.0, perimeter * perimeter) / std::max(1.0, area))};
}

/// @brief What a measure of a mask adds to the logarithm of the odds for each squared deviation from its
/// class, and how many of these count at most: chosen on halves of the training images of four sets.
inline constexpr double mask_weight = 0.15, most_sq_deviation = 9;
/// @brief The most that mask_log_odds() gives.
inline constexpr double most_mask_log_odds = double(MaskMeasures{}.values().size()) * mask_weight;

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

/// @brief Lets what was cut out speak for or against objects that templates judged: what they take for one by
/// chance is mostly cut out as no object of the class is. One place shows one object: where it speaks against
/// the most probable class, it speaks as much against the others. Where a class's masks are not known nothing
/// is said.
/// @param detections  of one image, cut out
inline void weigh_masks(std::vector<Detection>& detections, const Model& model, ThreadPool& pool) {
    std::vector<double> odds(detections.size(), 0);  // without masks, in logarithms
    std::vector<std::optional<double>> own(detections.size());
    pool.for_each(detections.size(), [&](std::size_t i, unsigned) {
        const Detection& detection = detections[i];
        const std::uint32_t c = detection.class_index;
        if (detection.box_reasons.empty() || c >= model.typical_masks.size()) return;
        odds[i] = detection.box_reasons.sum() - detection.box_reasons.mask;
        if (const TypicalMask& typical = model.typical_masks[c]; typical.known())
            own[i] = mask_log_odds(measure_mask(detection.segmentation, detection.box), typical);
    });
    for (std::size_t i = 0; i < detections.size(); ++i) {
        Detection& detection = detections[i];
        if (!own[i] || !(model.template_calibration.curves[detection.class_index].slope > 0)) continue;
        const double before = detection.box_reasons.mask;
        const std::optional<double>& rival = own[strongest_rival(detections, odds, i)];
        detection.box_reasons.mask = std::min(*own[i], rival.value_or(most_mask_log_odds));
        change_log_odds(detection, detection.box_reasons.mask - before, model.template_calibration);
    }
}

}  // namespace ism
