// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ism/core/error.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/model/describe_exemplar.hpp"
#include "ism/train/describe_object.hpp"
#include "ism/train/learn_figure_colors.hpp"
#include "ism/train/training_features.hpp"

namespace ism {

/// @brief Adds to a model the training objects that lend their masks (ExemplarSegmenter) and the colours of
/// their classes, from the same training features, whose pixels were kept (TrainingFeatureOptions::pixels).
/// An object without a mask of its own, labelled or from masks_from_boxes(), is none.
/// @param model         without templates: learn_templates() comes after, to learn what exemplars cut out
/// @param max_of_class  of more objects of a class every second, third … is taken
/// @throws Error where the model has templates or is of other objects, or no image has pixels.
[[nodiscard]] inline Model learn_exemplars(Model model, const TrainingFeatures& features,
                                           std::size_t max_of_class = 300, unsigned threads = 0) {
    detail::expect_same_objects(model, features, "exemplars");
    expect(max_of_class > 0, "exemplars: objects of a class", "1 or more", 0);
    expect(model.templates.empty(), "exemplars: templates of the model", "none before learn_exemplars()",
           model.templates.size());
    struct Candidate {
        std::uint32_t object = 0;
        const TrainingView* view = nullptr;
        ObjectLabel label = {};
    };
    std::vector<std::vector<Candidate>> of_class(features.class_names.size());
    bool pixels = false;
    for (const TrainingView& view : features.views) {
        if (view.pixels.empty()) continue;
        pixels = true;
        for (std::uint32_t object = view.first_object; object < view.end_object; ++object) {
            const ObjectLabel& label = view.labels[object - view.first_object];
            if (has_mask(model.shapes.objects[object], label, view.width, view.height))
                of_class[label.class_index].push_back({object, &view, label});
        }
    }
    expect(pixels, "exemplars: training images with pixels", "1 or more", 0);
    std::vector<Candidate> chosen;
    for (const auto& candidates : of_class) {
        const std::size_t step = (candidates.size() + max_of_class - 1) / max_of_class;
        for (std::size_t i = 0; i < candidates.size(); i += step) chosen.push_back(candidates[i]);
    }
    model.exemplars.resize(chosen.size());
    parallel_for(chosen.size(), threads, [&](std::size_t i) {
        const auto& [object, view, label] = chosen[i];
        model.exemplars[i] = {object, describe_exemplar(view->pixels, label.box)};
    });
    model.figure_colors.clear();
    if (!chosen.empty()) {
        std::vector<std::vector<ColoredObject>> colored(of_class.size());
        for (const auto& [object, view, label] : chosen)
            colored[label.class_index].push_back(
                {view->pixels, label.box, &model.shapes.objects[object].mask});
        model.figure_colors.resize(colored.size());
        parallel_for(colored.size(), threads,
                     [&](std::size_t c) { model.figure_colors[c] = learn_figure_colors(colored[c]); });
    }
    return model;
}

}  // namespace ism
