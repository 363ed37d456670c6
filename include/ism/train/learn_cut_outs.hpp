// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ism/core/geometry.hpp"
#include "ism/core/lists.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/detection.hpp"
#include "ism/detect/exemplar_segmenter.hpp"
#include "ism/detect/mask_evidence.hpp"
#include "ism/model/figure_colors.hpp"
#include "ism/model/model.hpp"
#include "ism/model/placing.hpp"
#include "ism/model/typical_mask.hpp"
#include "ism/train/cross_judge.hpp"
#include "ism/train/fit_placing.hpp"
#include "ism/train/training_features.hpp"

/// What is cut out of objects of a class, learnt from objects that were found in training.
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

/// Which fold of the training images each image is in, and what was learnt without each.
struct ImageFolds {
    std::vector<std::size_t> of_image;
    std::vector<std::vector<FigureColors>> colors_without;  // [fold][class]; none where no fold was left out
    [[nodiscard]] std::size_t size() const { return colors_without.size(); }
};

/// The exemplars of each class that images of other folds show: [fold][class].
[[nodiscard]] inline std::vector<std::vector<std::vector<std::uint32_t>>> exemplars_without(
    const Model& model, std::span<const TrainingView* const> views, const ImageFolds& folds) {
    std::vector<std::size_t> fold_of_object(model.shapes.objects.size(), folds.size());
    for (std::size_t i = 0; i < views.size(); ++i)
        for (std::uint32_t o = views[i]->first_object; o < views[i]->end_object; ++o)
            fold_of_object[o] = folds.of_image[i];
    std::vector<std::vector<std::vector<std::uint32_t>>> without(folds.size());
    for (std::size_t f = 0; f < folds.size(); ++f) {
        without[f].resize(model.shapes.class_names.size());
        for (std::uint32_t e = 0; e < model.exemplars.size(); ++e) {
            const std::uint32_t object = model.exemplars[e].object;
            if (fold_of_object[object] != f)
                without[f][model.shapes.objects[object].class_index].push_back(e);
        }
    }
    return without;
}

/// An object as it was found on an image that its judges had not seen, and what was cut out of it.
struct CutOutObject {
    std::size_t image = 0;
    PlacedBox placed = {};
    MaskMeasures mask = {};
};

/// The objects of a class that were found, or an even choice of them.
[[nodiscard]] inline std::vector<CutOutObject> objects_to_cut_out(std::span<const JudgedBox> judged,
                                                                  std::span<const TrainingView* const> views,
                                                                  std::uint32_t class_index) {
    constexpr std::size_t most = 100;  // are enough
    std::vector<CutOutObject> found;
    for (const JudgedBox& box : judged) {
        if (!box.right || box.class_index != class_index) continue;
        CutOutObject object{.image = box.image, .placed = {.judged = box.box, .mask = box.box}};
        for (const ObjectLabel& label : views[box.image]->labels)
            if (label.class_index == class_index &&
                iou(label.box, box.box) > iou(object.placed.label, box.box))
                object.placed.label = label.box;
        found.push_back(object);
    }
    const std::size_t step = std::max<std::size_t>(1, (found.size() + most - 1) / most);
    std::vector<CutOutObject> chosen;
    for (std::size_t i = 0; i < found.size(); i += step) chosen.push_back(found[i]);
    return chosen;
}

/// What is cut out of objects of each class: what masks are like, and where the objects lie.
struct CutOuts {
    std::vector<TypicalMask> typical_masks;
    std::vector<Placing> placings;
};

/// Learns it from boxes as they are found on images that their judges have not seen, by exemplars and colours
/// of the images that these have seen: as boxes will be cut out in images that none has seen.
/// @param model  with exemplars
/// @param views  of the images that were judged
[[nodiscard]] inline CutOuts learn_cut_outs(const Model& model, std::span<const TrainingView* const> views,
                                            std::span<const JudgedBox> judged, const ImageFolds& folds,
                                            unsigned threads) {
    const auto lenders = exemplars_without(model, views, folds);
    const ExemplarSegmenter segmenter;
    CutOuts learnt;
    for (std::uint32_t c = 0; c < model.shapes.class_names.size(); ++c) {
        std::vector<CutOutObject> found = objects_to_cut_out(judged, views, c);
        drop_if(found,
                [&](const CutOutObject& object) { return lenders[folds.of_image[object.image]][c].empty(); });
        Placing placing;
        for (int cut = 0; cut < segmenter.cuts; ++cut) {
            parallel_for(found.size(), threads, [&](std::size_t i) {
                auto& [image, placed, mask] = found[i];
                const std::size_t fold = folds.of_image[image];
                const Box box = cut == 0 ? placed.judged : placing.place(placed.judged, placed.mask);
                const Segmentation part = segmenter.cut_out(lenders[fold][c], folds.colors_without[fold][c],
                                                            box, views[image]->pixels, model);
                placed.mask = cut_out_box(part, placed.judged);
                mask = measure_mask(part, placing.place(placed.judged, placed.mask));
            });
            std::vector<PlacedBox> placed;
            for (const CutOutObject& object : found) placed.push_back(object.placed);
            placing = fit_placing(placed);
        }
        std::vector<MaskMeasures> masks;
        for (const CutOutObject& object : found) masks.push_back(object.mask);
        learnt.typical_masks.push_back(typical_mask(masks));
        learnt.placings.push_back(placing);
    }
    return learnt;
}

}  // namespace ism::detail
