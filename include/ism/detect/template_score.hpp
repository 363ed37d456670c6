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
#include "ism/core/shared.hpp"
#include "ism/core/thread_pool.hpp"
#include "ism/detect/asked_proposals.hpp"
#include "ism/detect/box_cue_reader.hpp"
#include "ism/detect/detect_options.hpp"
#include "ism/detect/detection.hpp"
#include "ism/detect/hypotheses.hpp"
#include "ism/detect/move_to.hpp"
#include "ism/detect/proposals.hpp"
#include "ism/detect/rivals.hpp"
#include "ism/detect/scene.hpp"
#include "ism/detect/verify.hpp"
#include "ism/detect/voted_boxes.hpp"
#include "ism/hog/box_template.hpp"
#include "ism/hog/describe_cells.hpp"
#include "ism/hog/hog_pyramid.hpp"
#include "ism/hog/propose_boxes.hpp"
#include "ism/hog/search_box.hpp"
#include "ism/model/box_classifier.hpp"
#include "ism/model/box_cues.hpp"
#include "ism/model/calibration.hpp"
#include "ism/model/model.hpp"
#include "ism/vote/cast.hpp"
#include "ism/vote/vote_space.hpp"

namespace ism {

/// @brief Lets the template of each class judge and place each hypothesis, whatever class its votes speak
/// for, where the model has templates: votes propose, templates decide. The score is the exponential of the
/// template's margin with what the other cues are worth, see CueWeights; the support are the votes of the
/// class that agree with the box that was found.
struct TemplateScore {
    std::size_t max_classes = asked_classes;  ///< asked about a hypothesis, of most vote weight there
    RivalOptions rivals = {};  ///< see yield_to_rivals(); where nothing is calibrated parts are left out
    bool explain = false;      ///< also tell which cells of a template speak for and against

    [[nodiscard]] std::vector<Detection> rescore(std::vector<Detection> hypotheses, const Scene& scene) const;
};

/// @brief Validates options.
/// @throws Error for one out of range.
inline void check(const TemplateScore& options) {
    expect(options.max_classes > 0, "TemplateScore::max_classes", "1 or more", 0);
    check(options.rivals);
}

namespace detail {

/// The boxes of hypotheses, as far as they are asked about.
[[nodiscard]] inline std::vector<ProposedBox> proposed_boxes(std::span<const Detection> hypotheses) {
    std::vector<ProposedBox> proposals;
    for (const Detection& hypothesis : hypotheses.first(std::min(hypotheses.size(), most_proposals)))
        proposals.push_back({hypothesis.class_index, hypothesis.box});
    return proposals;
}

/// What a model has to say of boxes, as far as it counts.
[[nodiscard]] inline BoxJudges judges_that_count(const Model& model) {
    const CueWeights& weights = model.cue_weights;
    BoxJudges judges{.sizes = model.typical_sizes};
    if (weights.words > 0 && !model.box_classifier.empty()) judges.words = &model.box_classifier;
    if (weights.patches > 0 && !model.patch_classifier.empty()) judges.patches = &model.patch_classifier;
    if (weights.contrast + weights.colors > 0)
        judges.figures = model.figures, judges.colors = model.figure_colors;
    return judges;
}

/// A box that the template of a class found.
struct FoundBox {
    std::uint32_t class_index = 0;
    SearchedBox found;
    CellShares cells;  ///< why; empty where nobody asked
};

/// The boxes that templates find in a scene, class after class.
/// @param asked  by class, see asked_proposals()
[[nodiscard]] inline std::vector<FoundBox> find_boxes(std::span<const BoxTemplate> templates,
                                                      const std::vector<std::vector<ProposedBox>>& asked,
                                                      const HogPyramid& pyramid, bool explain,
                                                      ThreadPool& pool) {
    std::vector<FoundBox> boxes;
    CellScratch scratch;
    for (std::uint32_t c = 0; c < templates.size(); ++c) {
        const TemplateScorer scorer(templates[c]);
        for (const SearchedBox& found :
             propose_boxes(scorer, c, pyramid, asked[c], boxes_to_search(asked[c], c), pool)) {
            boxes.push_back({c, found, {}});
            if (explain) boxes.back().cells = scorer.explain(pyramid, found.box, found.mirrored, scratch);
        }
    }
    return boxes;
}

/// The votes of a class that agree with a box, each as much as it does.
[[nodiscard]] inline std::vector<Support> agreeing_support(std::uint32_t class_index, const Box& box,
                                                           std::span<const Vote<Jism::dimension>> votes,
                                                           const VotedBoxes& voted) {
    std::vector<Support> support;
    voted.each_agreeing(class_index, box, [&](std::uint32_t vote, float weight, double agreement) {
        const auto& v = votes[vote];
        support.push_back({v.feature, v.word, v.occurrence, float(weight * agreement)});
    });
    return support;
}

/// What was found, with all that speaks for it.
[[nodiscard]] inline Detection judged_detection(FoundBox found, const BoxCues& cues,
                                                std::vector<Support> support, const Scene& scene) {
    const Calibration& calibration = scene.model.template_calibration;
    const BoxReasons reasons = scene.model.cue_weights.reasons(cues);
    Detection detection;
    detection.class_index = found.class_index;
    detection.cells = std::move(found.cells);
    detection.score = std::exp(reasons.sum());
    detection.probability = calibration.probability(found.class_index, detection.score);
    if (!calibration.empty()) {
        const Calibration::Curve& curve = calibration.curves[found.class_index];
        detection.box_reasons = reasons.in_odds(curve.slope, curve.offset);
    }
    if (!support.empty()) {
        Detection voted = describe_hypothesis(detection.score, std::move(support), scene);
        detection.angle = voted.angle, detection.depth_m = voted.depth_m;
        detection.support = std::move(voted.support);
    }
    move_to(detection, found.found.box, scene.frame.camera);
    return detection;
}

}  // namespace detail

inline std::vector<Detection> TemplateScore::rescore(std::vector<Detection> hypotheses,
                                                     const Scene& scene) const {
    const Model& model = scene.model;
    if (model.templates.empty() || hypotheses.empty()) return hypotheses;
    const std::vector<ProposedBox> proposals = detail::proposed_boxes(hypotheses);
    const FrameColors colors(scene.frame);
    FrameMemory own;
    FrameMemory& memory = scene.memory ? *scene.memory : own;
    if (!memory.pyramid) memory.pyramid = Shared<HogPyramid>::make();
    HogPyramid& pyramid = *memory.pyramid;
    pyramid.assign(colors.image(), finest_level(proposals), scene.pool);

    const DetectOptions options = proposal_options<Jism>();
    const auto votes = cast_votes<Jism>(scene, options.matching, vote_limits(scene, options));
    const auto asked = asked_proposals(proposals, votes, max_classes, model.shapes);
    std::vector<detail::FoundBox> boxes =
        detail::find_boxes(model.templates, asked, pyramid, explain, scene.pool);

    const BoxJudges judges = detail::judges_that_count(model);
    const VotedBoxes voted(votes, scene.features, model.shapes);
    const WordMap words = judges.words ? WordMap(scene.features, scene.matches, model.words()) : WordMap();
    const BoxCueReader reader(judges, {pyramid, colors.image(), voted, words});
    std::vector<CellScratch> scratches(scene.pool.size());
    std::vector<Detection> found(boxes.size());
    scene.pool.for_each(found.size(), [&](std::size_t i, unsigned worker) {
        detail::FoundBox& box = boxes[i];
        const BoxCues cues = reader.cues(box.class_index, box.found, scratches[worker]);
        auto support = detail::agreeing_support(box.class_index, box.found.box, votes, voted);
        found[i] = detail::judged_detection(std::move(box), cues, std::move(support), scene);
    });
    if (model.template_calibration.tells_apart()) {
        yield_to_rivals(found, model.template_calibration, rivals);
        return found;
    }
    // No probability tells a whole from its parts: what lies within a stronger box is left out.
    std::vector<Detection> kept;
    for (const Verified& verified :
         NonMaximumSuppression{.max_inside = 0.5, .across_classes = false}.verify(found))
        kept.push_back(std::move(found[verified.index]));
    return kept;
}

}  // namespace ism
