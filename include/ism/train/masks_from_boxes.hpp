// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/box_region.hpp"
#include "ism/core/error.hpp"
#include "ism/core/geometry.hpp"
#include "ism/core/image.hpp"
#include "ism/core/progress.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/detection.hpp"
#include "ism/detect/exemplar_segmenter.hpp"
#include "ism/model/describe_exemplar.hpp"
#include "ism/model/figure_reach.hpp"
#include "ism/model/mask_exemplar.hpp"
#include "ism/model/model.hpp"
#include "ism/model/training_object.hpp"
#include "ism/train/describe_object.hpp"
#include "ism/train/training_features.hpp"

namespace ism {

namespace detail {

/// A training object that lends its mask, or whose mask is looked for.
struct BoxedObject {
    const TrainingView* view = nullptr;
    std::uint32_t object = 0;  // of the model
    std::uint32_t class_index = 0;
    Box box = {};
    bool labelled = false;  // has a mask in its label
    bool lends = false;     // its mask to others of its class
    std::vector<std::uint8_t> cells = {};
};

/// Whether an image shows enough of what is around a box to tell the object from it; a crop does not.
[[nodiscard]] inline bool shows_ground(const Box& box, int width, int height) {
    const BoxRegion region(box, ExemplarSegmenter{}.margin, width, height);
    return region.width * region.height >= 1.2 * box.area();
}

/// The objects of classes that lack masks and can find some.
[[nodiscard]] inline std::vector<BoxedObject> boxed_objects(std::span<const TrainingObject> objects,
                                                            const TrainingFeatures& features) {
    constexpr std::size_t max_lenders = 100;  // of a class
    const std::size_t classes = features.class_names.size();
    std::vector<BoxedObject> boxed;
    std::vector<std::size_t> count(classes, 0), able(classes, 0), lacking(classes, 0), seen(classes, 0);
    for (const TrainingView& view : features.views)
        for (std::uint32_t i = view.first_object; i < view.end_object && !view.pixels.empty(); ++i) {
            const ObjectLabel& label = view.labels[i - view.first_object];
            const bool labelled = has_mask(objects[i], label, view.width, view.height),
                       lends = labelled || shows_ground(label.box, view.width, view.height);
            boxed.push_back({&view, i, label.class_index, label.box, labelled, lends});
            ++count[label.class_index], able[label.class_index] += lends;
            lacking[label.class_index] += !labelled;
        }
    std::erase_if(boxed, [&](const BoxedObject& own) {
        const std::uint32_t c = own.class_index;
        return lacking[c] == 0 || 2 * able[c] < count[c];
    });
    for (BoxedObject& own : boxed) {
        const std::size_t step = (able[own.class_index] + max_lenders - 1) / max_lenders;
        own.lends = own.lends && seen[own.class_index]++ % step == 0;
    }
    return boxed;
}

/// What is to be expected of a box: its middle shows the object, its corners do not.
inline void expect_ellipse(Mask& mask) {
    for (int y = 0; y < mask.height(); ++y)
        for (int x = 0; x < mask.width(); ++x) {
            const double u = 2 * (x + 0.5) / mask.width() - 1, v = 2 * (y + 0.5) / mask.height() - 1;
            mask(x, y) = std::uint8_t(255 * (0.8 - 0.7 * std::min(1.0, u * u + v * v)));
        }
}

/// An object as others cut it out that lend it their masks: share of figure in the cells of its mask.
[[nodiscard]] inline Mask lent_mask(const BoxedObject& own, std::span<const BoxedObject* const> lenders,
                                    std::span<const TrainingObject> objects) {
    Model model;
    for (const BoxedObject* lender : lenders) {
        model.exemplars.push_back({std::uint32_t(model.shapes.objects.size()), lender->cells});
        model.shapes.objects.push_back(objects[lender->object]);
    }
    std::vector<std::uint32_t> all(lenders.size());
    std::iota(all.begin(), all.end(), 0u);
    const ExemplarSegmenter segmenter{.exemplars = {.size_step = 0, .place_step = 0}};  // the box is right
    const Segmentation part = segmenter.cut_out(all, {}, own.box, own.view->pixels, model);
    Mask mask(objects[own.object].mask.width(), objects[own.object].mask.height());
    for (int y = 0; y < mask.height(); ++y)
        for (int x = 0; x < mask.width(); ++x) {
            const double cx = own.box.x + (x + 0.5) / mask.width() * own.box.width,
                         cy = own.box.y + (y + 0.5) / mask.height() * own.box.height;
            const int px = int(std::floor(cx)) - part.x, py = int(std::floor(cy)) - part.y;
            if (part.figure.contains(px, py)) mask(x, y) = std::uint8_t(255 * part.figure(px, py));
        }
    return mask;
}

}  // namespace detail

/// @brief Gives masks to those training objects of a model that were labelled by boxes alone, for what learns
/// from masks or lends them (learn_templates(), learn_exemplars()). Colours within and around each box tell
/// figure from ground, as in GrabCut (Rother, Kolmogorov and Blake 2004), and objects of a class that look
/// alike lend each other what they have found (Kuettel, Guillaumin and Ferrari 2012). Labelled masks stay,
/// and are lent. Crops, which show no ground, only borrow; a class of which more than half are crops keeps
/// its boxes.
/// @param features  that the model was learnt from, with pixels (TrainingFeatureOptions::pixels)
/// @throws Error where the model is of other objects.
[[nodiscard]] inline Model masks_from_boxes(Model model, const TrainingFeatures& features,
                                            unsigned threads = 0, const Progress& progress = {}) {
    detail::expect_same_objects(model, features, "masks");
    std::vector<TrainingObject>& objects = model.shapes.objects;
    auto boxed = detail::boxed_objects(objects, features);
    parallel_for(boxed.size(), threads, [&](std::size_t i) {
        detail::BoxedObject& own = boxed[i];
        own.cells = describe_exemplar(own.view->pixels, own.box);
        if (!own.labelled) detail::expect_ellipse(objects[own.object].mask);
    });
    // First by colours alone, from an ellipse; then by what the others have found, and those that do not lend
    // at the end.
    constexpr int rounds = 4;
    for (int round = 0; round < rounds; ++round) {
        std::vector<Mask> masks(boxed.size());
        ProgressCounter counter(progress, "cutting out boxes", boxed.size());
        parallel_for(boxed.size(), threads, [&](std::size_t i) {
            const detail::BoxedObject& own = boxed[i];
            if (!own.labelled && (own.lends || round + 1 == rounds)) {
                std::vector<const detail::BoxedObject*> lenders;
                for (const detail::BoxedObject& other : boxed)
                    if (round > 0 && other.lends && other.class_index == own.class_index && &other != &own)
                        lenders.push_back(&other);
                if (lenders.empty()) lenders.push_back(&own);
                masks[i] = detail::lent_mask(own, lenders, objects);
            }
            counter.step();
        });
        for (std::size_t i = 0; i < boxed.size(); ++i)
            if (!masks[i].empty()) objects[boxed[i].object].mask = std::move(masks[i]);
    }
    for (const detail::BoxedObject& own : boxed) {
        TrainingObject& object = objects[own.object];
        object.reach = figure_reach(object.mask, object.width, object.height);
    }
    return model;
}

}  // namespace ism
