// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "lessons.hpp"

#include <cmath>

#include "learning.hpp"
#include "spaces.hpp"

#include "ism/train/orientation.hpp"

namespace program {

namespace {

/// What training objects tell of how they lie.
std::string text_of(const ism::SharedFeatures& shared) {
    if (!shared.conclusive()) return " (training objects share too few features to tell)";
    return ism::join_text(" (", std::lround(100 * shared.upright_share()), " % of ", shared.count,
                          " features that training objects share have one side up; 17 % by chance)");
}

std::string no_camera_text(std::size_t with_depth) {
    return with_depth == 1
               ? "left out: 1 image has depth, and no camera"
               : ism::join_text("left out: ", with_depth, " images have depth, none has a camera");
}

}  // namespace

std::vector<std::string> leave_out_unused(ism::Dataset& dataset) {
    std::vector<bool> shown(dataset.class_names.size(), false);
    for (const ism::DatasetImage& image : dataset.images)
        for (const ism::DatasetAnnotation& object : image.objects)
            if (!object.crowd) shown[object.class_index] = true;
    std::vector<std::string> used, unused;
    for (std::size_t c = 0; c < shown.size(); ++c)
        (shown[c] ? used : unused).push_back(dataset.class_names[c]);
    if (unused.empty() || used.empty()) return {};
    dataset = ism::select_classes(dataset, used);
    return unused;
}

Orientation choose_orientation(const std::string& how, std::span<const std::string> class_names,
                               const ism::TrainingSet& set, const std::vector<ism::AnyExtractor>& extractors,
                               unsigned threads) {
    ism::expect(how == "auto" || how == "upright" || how == "free", "orientation",
                "'auto', 'upright' or 'free'", ism::lazy_text("'", how, "'"));
    if (how == "upright") return {};
    const ism::SharedFeatures shared = program::shared_features(class_names, set, extractors, threads);
    const bool free = how == "free" || !shared.one_side_up();
    // Templates judge as training objects lie: learnt from upright ones they would refuse turned ones.
    return {.free = free, .templates = !(free && shared.one_side_up()), .why_so = text_of(shared)};
}

std::string add_depth(ism::Model& model, const ism::TrainingSet& set, const DepthImages& images,
                      const ism::TrainOptions& options) {
    if (images.with_depth == 0) return {};
    if (images.usable.empty()) return no_camera_text(images.with_depth);
    const std::vector<std::size_t>& usable = images.usable;
    const ism::TrainingSet part{.size = usable.size(),
                                .labels = [&](std::size_t i) { return set.labels(usable[i]); },
                                .image = [&](std::size_t i) { return set.image(usable[i]); },
                                .category_ids = set.category_ids};
    try {
        model.rgbd = {learn_rgbd(model.shapes.class_names, part, options)};
    } catch (const ism::Error& error) {
        return ism::join_text("left out, the space metric is not there: ", error.what());
    }
    return {};
}

std::string doubt_of_probabilities(const ism::Model& model) {
    if (model.calibration.empty() || learnt_probabilities(model)) return {};
    return "too few objects to learn how sure to be of what is found: probabilities say little, and two or "
           "three more objects of each class make them much better";
}

}  // namespace program
