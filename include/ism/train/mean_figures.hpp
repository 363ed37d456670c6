// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ism/model/box_cues.hpp"
#include "ism/model/shape_model.hpp"
#include "ism/model/training_object.hpp"

namespace ism {

/// @brief The mean mask of the training objects of each class, looking to both sides. Where masks fill their
/// boxes, mostly for want of better labels, figure and ground are not told apart: then it is 0 everywhere.
[[nodiscard]] inline std::vector<ClassFigure> mean_figures(const ShapeModel& shapes) {
    const std::size_t classes = shapes.class_names.size();
    std::vector<ClassFigure> figures(classes, ClassFigure(figure_numbers, 0));
    std::vector<float> objects(classes, 0), filled(classes, 0);
    for (const TrainingObject& object : shapes.objects) {
        const std::size_t c = object.class_index;
        float sum = 0;
        for (const std::uint8_t share : object.mask.pixels()) sum += float(share) / 255;
        objects[c] += 1, filled[c] += sum / float(std::max<std::size_t>(1, object.mask.pixels().size()));
        for (int y = 0; y < figure_samples; ++y)
            for (int x = 0; x < figure_samples; ++x) {
                const auto at = [](int i) { return (float(i) + 0.5f) / figure_samples - 0.5f; };
                const float share = figure_share(object, at(x) * object.width, at(y) * object.height);
                figures[c][std::size_t(y * figure_samples + x)] += share;
                figures[c][std::size_t(y * figure_samples + figure_samples - 1 - x)] += share;
            }
    }
    for (std::size_t c = 0; c < classes; ++c)
        for (float& number : figures[c])
            number = filled[c] >= 0.97f * objects[c] ? 0 : std::min(1.0f, number / (2 * objects[c]));
    return figures;
}

}  // namespace ism
