// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ism/core/frame.hpp"
#include "ism/core/frame_colors.hpp"
#include "ism/detect/asked_proposals.hpp"
#include "ism/detect/detect_options.hpp"
#include "ism/detect/detection.hpp"
#include "ism/detect/hypotheses.hpp"
#include "ism/detect/proposals.hpp"
#include "ism/detect/scene.hpp"
#include "ism/hog/propose_boxes.hpp"
#include "ism/vote/cast.hpp"
#include "ism/vote/vote_space.hpp"

namespace ism {

/// @brief Lets the template of each class judge and place each hypothesis, whatever class its votes speak
/// for, where the model has templates: votes propose, templates decide. The score is the exponential of the
/// template's margin plus Model::word_weight times the logit of the words in the box; the support are the
/// votes of the class that agree with the box that was found.
struct TemplateScore {
    std::size_t max_proposals = 60;          ///< hypotheses that are asked, the strongest
    std::size_t max_boxes = searched_boxes;  ///< of a class that are placed by searching
    std::size_t max_classes = 8;  ///< that are asked about a hypothesis, those of most vote weight there
    double min_agreement = 0.5;   ///< IoU of the box that a vote stands for with that of the detection
    bool explain = false;         ///< also tell which cells of a template speak for and against

    [[nodiscard]] std::vector<Detection> rescore(std::vector<Detection> hypotheses, const Scene& scene) const;
};

/// @brief Validates options.
/// @throws Error for one out of range.
inline void check(const TemplateScore& options) {
    expect(options.max_proposals > 0, "TemplateScore::max_proposals", "1 or more", 0);
    expect(options.max_boxes > 0, "TemplateScore::max_boxes", "1 or more", 0);
    expect(options.max_classes > 0, "TemplateScore::max_classes", "1 or more", 0);
    expect(options.min_agreement >= 0 && options.min_agreement <= 1, "TemplateScore::min_agreement",
           "0 ... 1", options.min_agreement);
}

/// @brief The votes of a class that stand for about this box.
/// @param votes  of all classes
[[nodiscard]] inline std::vector<Support> support_of_box(std::span<const Vote<Jism::dimension>> votes,
                                                         std::uint32_t class_index, const Box& box,
                                                         double min_agreement, const Scene& scene) {
    const ShapeModel& shapes = scene.model.shapes;
    const Point2 centre = box.centre();
    std::vector<Support> support;
    for (const auto& vote : votes) {
        const Occurrence& o = shapes.occurrence(vote.occurrence);
        if (o.class_index != class_index) continue;
        const Placement placed = placement(scene.features[vote.feature], o);
        if (std::abs(placed.centre.x - centre.x) > box.width / 2 ||
            std::abs(placed.centre.y - centre.y) > box.height / 2)
            continue;
        const TrainingObject& object = shapes.objects[o.object];
        const double agreement = iou(placed_box(placed, object.width, object.height), box);
        if (agreement >= min_agreement)
            support.push_back({vote.feature, vote.word, vote.occurrence, float(vote.weight * agreement)});
    }
    return support;
}

inline std::vector<Detection> TemplateScore::rescore(std::vector<Detection> hypotheses,
                                                     const Scene& scene) const {
    const Model& model = scene.model;
    if (model.templates.empty() || hypotheses.empty()) return hypotheses;
    std::vector<ProposedBox> proposals;
    for (const Detection& hypothesis : hypotheses)
        if (proposals.size() < max_proposals) proposals.push_back({hypothesis.class_index, hypothesis.box});
    const RgbImage gray_as_color = scene.frame.color.empty() ? colors_of(scene.frame) : RgbImage();
    const RgbImage& color = scene.frame.color.empty() ? gray_as_color : scene.frame.color;
    const HogPyramid pyramid(color, finest_level(proposals), scene.pool);
    const bool with_words = model.word_weight > 0 && !model.box_classifier.empty();
    const WordMap words = with_words ? WordMap(scene.features, scene.matches, model.words()) : WordMap();
    const DetectOptions options = proposal_options();
    const auto votes = cast_votes<Jism>(scene, options.matching, vote_limits(scene, options));
    const auto asked = asked_proposals(proposals, votes, max_classes, model.shapes);
    std::vector<Detection> found;
    CellScratch scratch;
    for (std::uint32_t c = 0; c < model.templates.size(); ++c) {
        const TemplateScorer scorer(model.templates[c]);
        for (const SearchedBox& box : propose_boxes(scorer, c, pyramid, asked[c], max_boxes, scene.pool)) {
            Detection detection;
            double margin = box.score;
            if (with_words)
                margin += model.word_weight * model.box_classifier.logit(c, words.histogram(box.box));
            detection.class_index = c, detection.score = std::exp(margin), detection.box = box.box;
            detection.probability = model.template_calibration.probability(c, detection.score);
            if (explain) detection.cells = scorer.explain(pyramid, box.box, box.mirrored, scratch);
            found.push_back(std::move(detection));
        }
    }
    scene.pool.for_each(found.size(), [&](std::size_t i, unsigned) {
        Detection& detection = found[i];
        auto support = support_of_box(votes, detection.class_index, detection.box, min_agreement, scene);
        if (!support.empty()) {
            const Detection described = describe_hypothesis(detection.score, std::move(support), scene);
            detection.angle = described.angle, detection.depth_m = described.depth_m;
            detection.support = described.support;
        }
        detection.centre = detection.box.centre();
        detection.scale = std::sqrt(detection.box.area()) / reference_size_px;
        if (scene.frame.camera && is_depth(detection.depth_m))
            detection.position_m = back_project(*scene.frame.camera, detection.centre, detection.depth_m);
    });
    return found;
}

}  // namespace ism
