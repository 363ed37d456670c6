// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "spaces.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "extractors.hpp"

#include "ism/detect/detect_turned.hpp"
#include "ism/detect/exemplar_segmenter.hpp"
#include "ism/detect/metric_recognition.hpp"
#include "ism/detect/recognition.hpp"
#include "ism/detect/template_score.hpp"
#include "ism/model/calibration.hpp"

namespace program {

namespace {

/// A rescorer chosen at run time.
struct ChosenRescorer {
    enum class Kind { none, boxes, templates } kind = Kind::none;
    bool explain = false;
    [[nodiscard]] std::vector<ism::Detection> rescore(std::vector<ism::Detection> hypotheses,
                                                      const ism::Scene& scene) const {
        if (kind == Kind::boxes) return ism::BoxClassifierScore{}.rescore(std::move(hypotheses), scene);
        if (kind == Kind::templates)
            return ism::TemplateScore{.explain = explain}.rescore(std::move(hypotheses), scene);
        return hypotheses;
    }
};

/// A segmenter chosen at run time.
struct ChosenSegmenter {
    bool exemplars = false;
    [[nodiscard]] ism::Segmentation segment(const ism::Detection& hypothesis, const ism::Scene& scene) const {
        return exemplars ? ism::ExemplarSegmenter{}.segment(hypothesis, scene)
                         : ism::PatchSegmenter{}.segment(hypothesis, scene);
    }
    void judge(std::vector<ism::Detection>& detections, const ism::Scene& scene) const {
        if (exemplars) ism::ExemplarSegmenter{}.judge(detections, scene);
    }
    static constexpr double most_log_odds = ism::ExemplarSegmenter::most_log_odds;
};

/// A verifier chosen at run time.
struct ChosenVerifier {
    bool suppression = false;
    double max_inside = 0.5;  ///< 1 for templates, which tell a whole from its parts themselves
    [[nodiscard]] bool needs_masks() const { return !suppression; }
    [[nodiscard]] std::vector<ism::Verified> verify(const std::vector<ism::Detection>& hypotheses,
                                                    const ism::Scene& scene) const {
        return suppression
                   ? ism::NonMaximumSuppression{.max_inside = max_inside, .across_classes = false}.verify(
                         hypotheses, scene)
                   : ism::Mdl{}.verify(hypotheses, scene);
    }
};

/// Whether templates judge; words do otherwise.
bool with_templates(const SearchOptions& search, const ism::Model& model) {
    return search.rescorer == "template" || (search.rescorer == "auto" && !model.templates.empty());
}

/// The least probability of what is told.
double min_probability(const SearchOptions& search, const ism::Model& model) {
    return search.min_score.value_or(with_templates(search, model) ? default_min_score : 0);
}

template <ism::VoteSpaceType Space>
ism::Detections find_in(ism::Scene scene, const SearchOptions& search) {
    ism::Recognition<Space, ism::EpanechnikovKernel, ChosenRescorer, ChosenSegmenter, ChosenVerifier>
        recognition;
    // Templates judge what votes propose, also weakly, and place boxes that are apart; words judge what votes
    // are sure of.
    const bool templates = with_templates(search, scene.model);
    ism::expect(!templates || !scene.model.templates.empty(), "--rescore template", "a model with templates",
                "one without");
    ism::expect(search.segmenter != "exemplars" || !scene.model.exemplars.empty(), "--segment exemplars",
                "a model with exemplars", "one without");
    recognition.segmenter.exemplars = search.segmenter != "patches";
    using Kind = ChosenRescorer::Kind;
    recognition.rescorer.kind = templates                   ? Kind::templates
                                : search.rescorer == "none" ? Kind::none
                                                            : Kind::boxes;
    recognition.rescorer.explain = search.explain;
    recognition.verifier.suppression = search.verifier == "nms" || (search.verifier == "auto" && templates);
    if (templates) {
        recognition.options = ism::proposal_options<Space>();
        recognition.bandwidth = ism::proposal_bandwidth<Space>();
        recognition.verifier.max_inside = 1;
    }
    recognition.options.min_probability = min_probability(search, scene.model);
    double& least = recognition.options.min_relative_score;
    if (search.keep) least = templates ? std::min(least, *search.keep) : *search.keep;
    return ism::recognise(std::move(scene), recognition);
}

/// The spaces in the order of space_names.
constexpr std::array finders = {find_in<ism::Ism>, find_in<ism::Jism>, find_in<ism::Ji3sm1>,
                                find_in<ism::Ji3sm2>, find_in<ism::Ji3sm3>};
constexpr std::array depth_needed = {ism::Ism::needs_depth, ism::Jism::needs_depth, ism::Ji3sm1::needs_depth,
                                     ism::Ji3sm2::needs_depth, ism::Ji3sm3::needs_depth};
static_assert(finders.size() == space_names.size() && depth_needed.size() == space_names.size());

/// Regions judged by votes in metres, colour and shape.
ism::Detections find_in_metres(ism::Scene scene, const SearchOptions& search) {
    ism::expect(search.rescorer == "none" || !scene.model.mask_judge.empty(), "--space metric",
                "a model learnt from images with depth and camera", "one without");
    ism::expect(search.rescorer == "auto" || search.rescorer == "none", "--rescore in the space metric",
                "auto or none", search.rescorer);
    ism::expect(search.verifier == "auto", "--verify in the space metric", "auto", search.verifier);
    ism::expect(search.segmenter == "auto", "--segment in the space metric", "auto", search.segmenter);
    if (search.rescorer == "none") {  // votes alone
        ism::Recognition<ism::Metric, ism::EpanechnikovKernel, ism::NoRescorer, ism::PatchSegmenter,
                         ism::NonMaximumSuppression>
            votes{.options = ism::metric_proposal_options()};
        return ism::recognise(std::move(scene), votes);
    }
    auto recognition = ism::metric_recognition();
    recognition.options.min_probability = search.min_score.value_or(default_min_score);
    recognition.verifier.second_choices = recognition.options.min_probability == 0;
    double& least = recognition.options.min_relative_score;
    least = std::min(least, search.keep.value_or(least));
    return ism::recognise(std::move(scene), recognition);
}

std::size_t space_index(std::string_view name) {
    const auto found = std::find(space_names.begin(), space_names.end(), name);
    ism::expect(found != space_names.end(), "vote space", "one of ism, jism, ji3sm1, ji3sm2, ji3sm3, metric",
                name);
    return static_cast<std::size_t>(found - space_names.begin());
}

}  // namespace

Matcher::Matcher(const ism::Model& model, ism::ThreadPool& pool)
    : matcher_(model, extractors_of(model), pool) {}

ism::Scene Matcher::scene(const ism::Frame& frame, std::string_view space) {
    return matcher_.scene(frame, space == metric_space ? ism::match_in<ism::Metric>() : ism::match_within);
}

ism::Detections find_objects(ism::Scene scene, const SearchOptions& search) {
    if (search.space == metric_space) return find_in_metres(std::move(scene), search);
    return finders[space_index(search.space)](std::move(scene), search);
}

ism::Detections Matcher::find(const ism::Frame& frame, const SearchOptions& search) {
    const auto find_in_frame = [&](const ism::Frame& shown) {
        return find_objects(scene(shown, search.space), search);
    };
    const ism::Model& model = matcher_.model();
    ism::Detections found =
        search.turns == 1
            ? find_in_frame(frame)
            : ism::detect_turned(
                  frame, {.turns = search.turns, .min_probability = min_probability(search, model)},
                  find_in_frame,
                  with_templates(search, model) ? model.template_calibration : ism::Calibration{});
    // which is the best is known at last: votes are unsure of what templates and masks are sure of
    double best = 0;
    for (const ism::Detection& object : found.objects) best = std::max(best, object.score);
    std::erase_if(found.objects, [&](const ism::Detection& object) {
        return object.score < search.keep.value_or(0) * best;
    });
    return found;
}

bool learnt_probabilities(const ism::Model& model) {
    if (model.templates.empty()) return model.calibration.tells_apart();
    const auto& curves = model.template_calibration.curves;
    return std::any_of(curves.begin(), curves.end(),
                       [](const auto& curve) { return !(curve == ism::typical_template_curve); });
}

bool needs_depth(std::string_view space) {
    return space == metric_space || (space != auto_space && depth_needed[space_index(space)]);
}

}  // namespace program
