// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "ism/core/color_bins.hpp"
#include "ism/core/frame.hpp"
#include "ism/core/frame_colors.hpp"
#include "ism/core/shared.hpp"
#include "ism/detect/asked_proposals.hpp"
#include "ism/detect/box_colors.hpp"
#include "ism/detect/detect_options.hpp"
#include "ism/detect/detection.hpp"
#include "ism/detect/hypotheses.hpp"
#include "ism/detect/move_to.hpp"
#include "ism/detect/proposals.hpp"
#include "ism/detect/rivals.hpp"
#include "ism/detect/scene.hpp"
#include "ism/detect/verify.hpp"
#include "ism/detect/voted_boxes.hpp"
#include "ism/hog/fisher_vector.hpp"
#include "ism/hog/propose_boxes.hpp"
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

inline std::vector<Detection> TemplateScore::rescore(std::vector<Detection> hypotheses,
                                                     const Scene& scene) const {
    const Model& model = scene.model;
    if (model.templates.empty() || hypotheses.empty()) return hypotheses;
    std::vector<ProposedBox> proposals;
    for (const Detection& hypothesis : hypotheses)
        if (proposals.size() < most_proposals) proposals.push_back({hypothesis.class_index, hypothesis.box});
    const FrameColors colors(scene.frame);
    const RgbImage& color = colors.image();
    FrameMemory own;
    FrameMemory& memory = scene.memory ? *scene.memory : own;
    if (!memory.pyramid) memory.pyramid = Shared<HogPyramid>::make();
    HogPyramid& pyramid = *memory.pyramid;
    pyramid.assign(color, finest_level(proposals), scene.pool);
    const CueWeights& weights = model.cue_weights;
    const bool with_patches = weights.patches > 0 && !model.patch_classifier.empty(),
               with_words = weights.words > 0 && !model.box_classifier.empty(),
               with_colors = weights.contrast + weights.colors > 0 && !model.figures.empty();
    const WordMap words = with_words ? WordMap(scene.features, scene.matches, model.words()) : WordMap();
    const DetectOptions options = proposal_options<Jism>();
    const auto votes = cast_votes<Jism>(scene, options.matching, vote_limits(scene, options));
    const VotedBoxes voted(votes, scene.features, model.shapes);
    const auto asked = asked_proposals(proposals, votes, max_classes, model.shapes);
    std::vector<Detection> found;
    std::vector<double> margins;
    CellScratch scratch;
    for (std::uint32_t c = 0; c < model.templates.size(); ++c) {
        const TemplateScorer scorer(model.templates[c]);
        const std::size_t searched = boxes_to_search(asked[c], c);
        for (const SearchedBox& box : propose_boxes(scorer, c, pyramid, asked[c], searched, scene.pool)) {
            Detection detection;
            detection.class_index = c, detection.box = box.box;
            if (explain) detection.cells = scorer.explain(pyramid, box.box, box.mirrored, scratch);
            found.push_back(std::move(detection));
            margins.push_back(box.score);
        }
    }
    const PatchMixture& mixture = model.patch_classifier.mixture;
    const std::optional<FisherEncoder> encoder =
        with_patches ? std::optional<FisherEncoder>(mixture) : std::nullopt;
    const LabTable to_lab;
    std::vector<CellScratch> scratches(scene.pool.size());
    scene.pool.for_each(found.size(), [&](std::size_t i, unsigned worker) {
        Detection& detection = found[i];
        const std::uint32_t c = detection.class_index;
        BoxCues cues{.margin = margins[i],
                     .vote_weight = voted.weight(c, detection.box),
                     .vote_share = voted.share(c, detection.box),
                     .log_size = model.log_size_of(c, detection.box, color.width(), color.height())};
        if (encoder)
            cues.patch_margin =
                model.patch_classifier.margin(c, encoder->encode(pyramid, detection.box, scratches[worker]));
        if (with_words) cues.word_logit = model.box_classifier.logit(c, words.histogram(detection.box));
        if (with_colors) {
            const BoxColors colors_in = box_colors(color, detection.box, model.figures[c], to_lab);
            cues.color_overlap = color_overlap(colors_in);
            cues.color_odds = color_odds(colors_in, model.figure_colors_of(c));
        }
        const BoxReasons reasons = weights.reasons(cues);
        detection.score = std::exp(reasons.sum());
        detection.probability = model.template_calibration.probability(c, detection.score);
        if (!model.template_calibration.empty()) {
            const Calibration::Curve& curve = model.template_calibration.curves[c];
            detection.box_reasons = reasons.in_odds(curve.slope, curve.offset);
        }
        std::vector<Support> support;
        voted.each_agreeing(c, detection.box, [&](std::uint32_t vote, float weight, double agreement) {
            const auto& v = votes[vote];
            support.push_back({v.feature, v.word, v.occurrence, float(weight * agreement)});
        });
        if (!support.empty()) {
            Detection described = describe_hypothesis(detection.score, std::move(support), scene);
            detection.angle = described.angle, detection.depth_m = described.depth_m;
            detection.support = std::move(described.support);
        }
        move_to(detection, detection.box, scene.frame.camera);
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
