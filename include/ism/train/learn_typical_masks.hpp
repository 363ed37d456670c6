// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/core/frame.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/detection.hpp"
#include "ism/detect/exemplar_segmenter.hpp"
#include "ism/detect/mask_evidence.hpp"
#include "ism/detect/scene.hpp"
#include "ism/model/figure_colors.hpp"
#include "ism/model/model.hpp"
#include "ism/model/training_object.hpp"
#include "ism/model/typical_mask.hpp"
#include "ism/train/learn_figure_colors.hpp"
#include "ism/train/training_features.hpp"

/// What masks of a class are like, by cutting training objects out.
namespace ism::detail {

/// Mean and deviation of masks of a class. Of few masks the deviation is drawn towards that of other things.
[[nodiscard]] inline TypicalMask typical_mask(std::span<const MaskMeasures> masks) {
    constexpr std::array usual = {0.06, 0.03, 0.4};  // deviations, of classes of four data sets
    constexpr double worth = 5;                      // so many masks
    if (masks.empty()) return {};
    std::array<double, usual.size()> mean{}, deviation{};
    const double count = double(masks.size());
    for (const MaskMeasures& mask : masks)
        for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += mask.values()[k] / count;
    for (std::size_t k = 0; k < mean.size(); ++k) {
        double sum = worth * usual[k] * usual[k];
        for (const MaskMeasures& mask : masks) {
            const double off = mask.values()[k] - mean[k];
            sum += off * off;
        }
        deviation[k] = std::sqrt(sum / (worth + count));
    }
    return {.mean = {mean[0], mean[1], mean[2]}, .deviation = {deviation[0], deviation[1], deviation[2]}};
}

/// A training object that lends its mask, seen in one of a few parts of the training images.
struct MaskLender {
    std::uint32_t exemplar = 0;
    const TrainingView* view = nullptr;
    Box box = {};
    std::size_t part = 0;
};
inline constexpr std::size_t lender_parts = 6;

/// The lenders of each class; its images belong to each part in turn.
[[nodiscard]] inline std::vector<std::vector<MaskLender>> mask_lenders(const Model& model,
                                                                       const TrainingFeatures& features) {
    std::vector<const TrainingView*> view_of(model.shapes.objects.size());
    for (const TrainingView& view : features.views)
        for (std::uint32_t o = view.first_object; o < view.end_object; ++o) view_of[o] = &view;
    std::vector<std::vector<MaskLender>> of_class(features.class_names.size());
    for (std::uint32_t e = 0; e < model.exemplars.size(); ++e) {
        const std::uint32_t object = model.exemplars[e].object;
        const TrainingView& view = *view_of[object];
        std::vector<MaskLender>& lenders = of_class[model.shapes.objects[object].class_index];
        const bool same_view = !lenders.empty() && lenders.back().view == &view;
        const std::size_t part = lenders.empty() ? 0 : lenders.back().part + (same_view ? 0 : 1);
        lenders.push_back({e, &view, view.labels[object - view.first_object].box, part % lender_parts});
    }
    return of_class;
}

/// What masks of a class are like in one part of the images, cut out by exemplars and colours of the others.
[[nodiscard]] inline std::vector<MaskMeasures> masks_of_part(const Model& model,
                                                             std::span<const MaskLender> lenders,
                                                             std::size_t part) {
    constexpr std::size_t most = 60;  // masks of a class are enough
    std::vector<std::uint32_t> exemplars;
    std::vector<ColoredObject> colored;
    for (const MaskLender& lender : lenders)
        if (lender.part != part) {
            const TrainingObject& object = model.shapes.objects[model.exemplars[lender.exemplar].object];
            exemplars.push_back(lender.exemplar);
            colored.push_back({lender.view->pixels, lender.box, &object.mask});
        }
    std::vector<MaskMeasures> masks;
    if (exemplars.empty()) return masks;
    const FigureColors colors = learn_figure_colors(colored);
    const std::size_t step = (lenders.size() + most - 1) / most;
    for (std::size_t i = 0; i < lenders.size(); i += step) {
        const MaskLender& lender = lenders[i];
        if (lender.part != part) continue;
        const auto& pixels = lender.view->pixels;
        const Frame frame{.gray = to_gray(pixels), .color = pixels};
        ThreadPool pool(1);
        const Segmentation cut_out = ExemplarSegmenter{}.segment_by(
            exemplars, colors, lender.box, Scene{.frame = frame, .model = model, .pool = pool});
        masks.push_back(measure_mask(cut_out, cut_out.box.value_or(lender.box)));
    }
    return masks;
}

/// The typical mask of each class.
/// @param model  with exemplars, of these features
[[nodiscard]] inline std::vector<TypicalMask> learn_typical_masks(const Model& model,
                                                                  const TrainingFeatures& features,
                                                                  unsigned threads) {
    const auto lenders = mask_lenders(model, features);
    std::vector<std::vector<MaskMeasures>> masks(lenders.size() * lender_parts);
    parallel_for(masks.size(), threads, [&](std::size_t i) {
        masks[i] = masks_of_part(model, lenders[i / lender_parts], i % lender_parts);
    });
    std::vector<TypicalMask> typical;
    for (std::size_t c = 0; c < lenders.size(); ++c) {
        std::vector<MaskMeasures> of_class;
        for (std::size_t part = 0; part < lender_parts; ++part)
            append(of_class, masks[c * lender_parts + part]);
        typical.push_back(typical_mask(of_class));
    }
    return typical;
}

}  // namespace ism::detail
