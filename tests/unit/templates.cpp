// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "support/catch.hpp"
#include "support/files.hpp"
#include "support/pictures.hpp"

#include "ism/detect/detect.hpp"
#include "ism/detect/template_recognition.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"
#include "ism/model_file/model_file.hpp"
#include "ism/train/describe_object.hpp"
#include "ism/train/learn_exemplars.hpp"
#include "ism/train/learn_templates.hpp"
#include "ism/train/train.hpp"

using ism::test::pattern_picture;

namespace {

using TypedModel = ism::TypedModel<ism::HessianLaplace, ism::RootSift>;
using Recognition = ism::Recognition<ism::Jism, ism::EpanechnikovKernel, ism::TemplateScore,
                                     ism::PatchSegmenter, ism::NonMaximumSuppression>;

/// What it cuts out makes detections more or less probable.
struct JudgingSegmenter {
    double log_odds = 0;
    static constexpr double most_log_odds = 1;
    [[nodiscard]] ism::Segmentation segment(const ism::Detection& hypothesis, const ism::Scene& scene) const {
        return ism::PatchSegmenter{}.segment(hypothesis, scene);
    }
    void judge(std::vector<ism::Detection>& detections, const ism::Scene&) const {
        for (ism::Detection& detection : detections) {
            const double odds = std::exp(log_odds) * detection.probability / (1 - detection.probability);
            detection.probability = odds / (1 + odds), detection.score = odds;
        }
    }
};

const std::vector<std::string> pattern_names{"first pattern", "second pattern"};
const ism::TemplateOptions small{.cells = 36, .mining_rounds = 1};

// Learnt once for all tests.

const ism::TrainingFeatures& pattern_features() {
    static const auto features = [] {
        std::vector<ism::TrainingImage> images;
        for (std::uint64_t i = 0; i < 8; ++i)
            images.push_back(pattern_picture(std::uint32_t(i % 2), 20 + 12 * int(i), 15 + 6 * int(i), i));
        return ism::extract_training_features(pattern_names, ism::training_set(images),
                                              {ism::Extractor<ism::HessianLaplace, ism::RootSift>{}},
                                              {.pixels = true});
    }();
    return features;
}

const ism::Model& model_without_templates() {
    static const ism::Model model =
        ism::learn(pattern_features(), {.box_classifier = {}, .calibrate = false});
    return model;
}

const TypedModel& model_with_templates() {
    static const TypedModel model(
        ism::learn_templates(model_without_templates(), pattern_features(), small, 1));
    return model;
}

}  // namespace

TEST_CASE("templates that were not calibrated leave parts of what they found out") {
    TypedModel model = model_with_templates();  // whose templates now find all boxes alike
    for (ism::BoxTemplate& one : model.templates) std::fill(one.weights.begin(), one.weights.end(), 0.0f);
    model.cue_weights = {};
    const auto test = pattern_picture(0, 71, 53, 90);
    ism::ThreadPool pool(1);
    const ism::Scene scene{.frame = test.frame, .model = model, .pool = pool};
    ism::Detection whole, part;
    whole.box = {20, 10, 80, 80}, part.box = {24, 14, 40, 40};
    const auto nested = [&] {
        const auto found = ism::TemplateScore{}.rescore({whole, part}, scene);
        std::size_t pairs = 0;
        for (const ism::Detection& a : found)
            for (const ism::Detection& b : found)
                pairs += a.class_index == b.class_index && ism::is_part(a.box, b.box);
        return pairs;
    };
    CHECK(nested() > 0);
    model.template_calibration = {};
    CHECK(nested() == 0);
}

TEST_CASE("templates judge and place what votes propose") {
    const TypedModel& model = model_with_templates();
    REQUIRE(model.templates.size() == 2);
    CHECK(model.templates[0].grid.columns == 6);  // the objects are squares
    CHECK(model.templates[0].grid.rows == 6);
    CHECK(model.template_calibration.curves.size() == 2);
    const Recognition recognition = ism::template_recognition();
    for (const std::uint32_t class_index : {0u, 1u}) {
        const auto test = pattern_picture(class_index, 71, 53, 90 + class_index);
        const auto found = ism::detect(model, test.frame, recognition, 1);
        REQUIRE_FALSE(found.objects.empty());
        const ism::Detection& best = found.objects.front();
        CHECK(best.class_index == class_index);
        CHECK(ism::iou(best.box, test.objects[0].box) > 0.75);
        CHECK(best.probability > 0.5);
        CHECK(best.probability <= 1);
        CHECK_FALSE(best.box_reasons.empty());
        CHECK(1 / (1 + std::exp(-best.box_reasons.sum())) == Approx(best.probability));
        CHECK(best.depth_m == Approx(1).margin(0.05));
        CHECK(best.centre == best.box.centre());
        REQUIRE_FALSE(best.support.empty());
        for (const ism::Support& s : best.support)
            CHECK(model.shapes.occurrence(s.occurrence).class_index == class_index);
        CHECK(best.cells.shares.empty());
        auto telling = recognition;
        telling.rescorer.explain = true;
        TypedModel templates_alone = model;
        templates_alone.cue_weights = {};
        const ism::Detection told = ism::detect(templates_alone, test.frame, telling, 1).objects.front();
        CHECK(told.box == best.box);
        CHECK(told.cells.grid == model.templates[class_index].grid);
        double sum = 0;
        for (const float share : told.cells.shares) sum += double(share);
        CHECK(std::exp(sum) == Approx(told.score).epsilon(1e-4));
        const auto two = ism::detect(model, test.frame, recognition, 2);
        REQUIRE(two.objects.size() == found.objects.size());
        for (std::size_t i = 0; i < two.objects.size(); ++i) {
            CHECK(two.objects[i].score == found.objects[i].score);
            CHECK(two.objects[i].box == found.objects[i].box);
        }
        if (class_index > 0) continue;  // the least probability is one for all classes
        auto probable = recognition;
        probable.options.min_probability = 0.5;
        const auto sure = ism::detect(model, test.frame, probable, 1);
        CHECK(std::size_t(std::count_if(found.objects.begin(), found.objects.end(), [](const auto& object) {
                  return object.probability >= 0.5;
              })) == sure.objects.size());
        probable.options.min_probability = 1;
        const auto none = ism::detect(model, test.frame, probable, 1);
        CHECK(none.objects.empty());
        REQUIRE(none.next_best);  // the best guess is known all the same
        for (const auto& object : found.objects) CHECK(object.probability <= none.next_best->probability);
        CHECK_FALSE(found.next_best);
    }
}

TEST_CASE("what was cut out decides what is told") {
    const TypedModel& model = model_with_templates();
    const auto test = pattern_picture(0, 71, 53, 90);
    const auto found = [&](double log_odds, double min_probability) {
        auto recognition = ism::template_recognition<ism::Jism>(JudgingSegmenter{log_odds});
        recognition.options.min_probability = min_probability;
        return ism::detect(model, test.frame, recognition, 1);
    };
    const ism::Detections all = found(0, 0);
    const double probability = all.objects.at(0).probability, odds = probability / (1 - probability);
    const auto after = [&](double log_odds) { return 1 / (1 + std::exp(-log_odds) / odds); };
    // What is not probable enough before may be so afterwards …
    const ism::Detections more = found(0.9, after(0.8));
    REQUIRE(more.objects.size() >= 1);
    CHECK(more.objects[0].probability == Approx(after(0.9)));
    CHECK(more.objects[0].box == all.objects[0].box);
    CHECK(found(0.7, after(0.8)).objects.empty());
    // … and the other way round; the best guess is told as it is then, with its mask.
    const ism::Detections less = found(-0.5, after(-0.4));
    CHECK(less.objects.empty());
    REQUIRE(less.next_best);
    CHECK(less.next_best->probability == Approx(after(-0.5)));
    CHECK_FALSE(less.next_best->segmentation.mask.empty());
    CHECK(less.stats.segmented >= 1);
    const ism::Detections changed = found(-2, 0);
    CHECK(changed.objects.size() == all.objects.size());
    for (std::size_t i = 1; i < changed.objects.size(); ++i)
        CHECK(changed.objects[i].score <= changed.objects[i - 1].score);
}

TEST_CASE("a detector finds the same whatever frames it saw before") {
    const TypedModel& model = model_with_templates();
    const ism::Frame whole = pattern_picture(0, 20, 30, 95).frame;
    ism::Frame part{.gray = ism::GrayImage(120, 130)};  // the upper left of another
    const ism::Frame other = pattern_picture(1, 15, 25, 96).frame;
    for (int y = 0; y < part.gray.height(); ++y)
        for (int x = 0; x < part.gray.width(); ++x) part.gray(x, y) = other.gray(x, y);
    ism::FrameDetector used(model, 2);
    const Recognition recognition = ism::template_recognition();
    for (const ism::Frame* frame : std::initializer_list<const ism::Frame*>{&whole, &part, &whole}) {
        const auto found = used.detect(*frame, recognition), first = ism::detect(model, *frame, recognition);
        REQUIRE_FALSE(found.objects.empty());
        REQUIRE(found.objects.size() == first.objects.size());
        for (std::size_t i = 0; i < found.objects.size(); ++i) {
            CHECK(found.objects[i].box == first.objects[i].box);
            CHECK(found.objects[i].score == first.objects[i].score);
        }
    }
}

TEST_CASE("of many classes those with most vote weight at a place are asked") {
    ism::ShapeModel shapes{.class_names = {"a", "b", "c", "d"}, .objects = {}};
    std::vector<ism::Occurrence> word(4);
    for (std::uint32_t c = 0; c < 4; ++c) word[c].class_index = c;
    shapes.occurrences.push_back(word);
    std::vector<ism::Vote<3>> votes;
    const auto vote = [&](float x, float weight, std::uint32_t c) {
        votes.push_back({.at = {x, 50, 1}, .weight = weight, .occurrence = c});
    };
    vote(50, 1, 0), vote(55, 3, 1), vote(45, 2, 1), vote(45, 2, 2), vote(200, 9, 3), vote(201, 1, 2);
    const std::vector<ism::ProposedBox> proposals{{0, {30, 30, 40, 40}}, {3, {180, 30, 40, 40}}};
    const auto classes_of = [&](std::size_t max_classes, std::size_t proposal) {
        std::vector<std::uint32_t> classes;
        const auto asked = ism::asked_proposals(proposals, votes, max_classes, shapes);
        REQUIRE(asked.size() == 4);
        for (std::uint32_t c = 0; c < 4; ++c)
            for (const ism::ProposedBox& box : asked[c])
                if (box.box == proposals[proposal].box) classes.push_back(c);
        return classes;
    };
    using Classes = std::vector<std::uint32_t>;
    CHECK(classes_of(4, 0) == Classes{0, 1, 2, 3});
    CHECK(classes_of(2, 0) == Classes{0, 1});
    CHECK(classes_of(3, 0) == Classes{0, 1, 2});
    CHECK(classes_of(2, 1) == Classes{2, 3});
    CHECK(classes_of(1, 0) == Classes{0});
}

TEST_CASE("a picture that proposes more of a class is searched at more places for it") {
    std::vector<ism::ProposedBox> proposals(300, {1, {0, 0, 10, 10}});
    for (std::size_t i = 0; i < 40; ++i) proposals[i].class_index = 0;
    CHECK(ism::boxes_to_search(proposals, 0) == ism::searched_boxes);
    CHECK(ism::boxes_to_search(proposals, 1) == 26);
    CHECK(ism::boxes_to_search({}, 1) == ism::searched_boxes);
}

TEST_CASE("cues join templates at the weights that tell right from wrong best") {
    // boxes whose odds of being right are exp(4 · margin of all cues), of two classes that differ in how
    // often they are: the weights are found again
    const auto learnt = [](const ism::CueWeights& weights, int boxes = 1000) {
        ism::Random random(1);
        std::vector<ism::detail::JudgedBox> judged;
        for (int i = 0; i < boxes; ++i) {
            ism::detail::JudgedBox box{.class_index = std::uint32_t(i % 2),
                                       .cues = {.margin = random.uniform(-2, 1),
                                                .word_logit = random.uniform(-4, 2),
                                                .patch_margin = random.uniform(-2, 1),
                                                .vote_weight = std::exp(random.uniform(-3, 3)),
                                                .color_overlap = random.uniform(),
                                                .color_odds = random.uniform(-2, 2),
                                                .log_size = random.uniform(-4, 0)}};
            const double margin = weights.margin(box.cues) + double(box.class_index);
            box.right = random.uniform() < 1 / (1 + std::exp(-4 * margin));
            judged.push_back(box);
        }
        return ism::detail::fit_cue_weights(judged, 2);
    };
    const ism::CueWeights known{.votes = 0.3, .share = 0.25, .contrast = 1.5, .colors = 0.5, .size = 0.2};
    const auto with = [&](double patches, double words) {
        ism::CueWeights weights = known;
        weights.patches = patches, weights.words = words;
        return weights;
    };
    const ism::CueWeights found = learnt(with(0.6, 0.05), 8000);
    CHECK(found.patches == Approx(0.6).margin(0.16));
    CHECK(found.words == Approx(0.05).margin(0.026));
    CHECK(learnt(with(3, 0)).patches == Approx(1.2));
    CHECK(learnt(with(0, 0.5)).words == Approx(0.1));
    CHECK(learnt(with(-1, -0.5)) == known);
}

TEST_CASE("where no box tells right from wrong, cues and curves are typical ones") {
    using ism::detail::JudgedBox;
    const std::vector<JudgedBox> none_right(5);
    for (const std::vector<JudgedBox>& judged : {std::vector<JudgedBox>(), none_right}) {
        const ism::CueWeights weights = ism::detail::fit_cue_weights(judged, 2);
        CHECK(weights.patches == 1);
        CHECK(weights.words == 0);
        CHECK(weights.votes > 0);
        const ism::Calibration curves = ism::detail::calibrated(judged, weights, 2);
        CHECK(curves.curves == std::vector(2, ism::typical_template_curve));
        CHECK(curves.tells_apart());
    }
    std::vector<JudgedBox> both = none_right;
    both[0].right = true;
    CHECK_FALSE(ism::detail::calibrated(both, {}, 1).curves[0] == ism::typical_template_curve);
}

TEST_CASE("colours are learnt of classes whose objects have masks, and kept when exemplars are") {
    ism::Model model = model_without_templates();
    ism::TrainingFeatures features = pattern_features();
    for (ism::TrainingView& view : features.views)
        for (ism::ObjectLabel& label : view.labels)
            if (label.class_index == 1) {  // as if it had been labelled by its box
                label.masked = false;
                const ism::Mask box = ism::object_mask({.box = label.box}, view.width, view.height);
                model.shapes.objects[view.first_object].mask = ism::describe_object(label, box, {}).mask;
            }
    const ism::Model lending = ism::learn_exemplars(model, features);
    REQUIRE(lending.figure_colors.size() == 2);
    model = ism::learn_templates(lending, features, small, 1);
    REQUIRE(model.figure_colors.size() == 2);
    CHECK(model.figure_colors_of(0).size() == ism::figure_color_bins);
    CHECK(model.figure_colors_of(1).empty());
    CHECK(model.figure_colors_of(2).empty());
    CHECK(model.figure_colors == lending.figure_colors);
    // So is how large they are.
    REQUIRE(model.typical_sizes.size() == 2);
    for (std::uint32_t c = 0; c < 2; ++c) {
        std::vector<double> areas, parts;
        for (const ism::TrainingView& view : features.views)
            for (const ism::ObjectLabel& label : view.labels)
                if (label.class_index == c) {
                    areas.push_back(label.box.area());
                    parts.push_back(label.box.area() / (view.width * view.height));
                }
        std::sort(areas.begin(), areas.end()), std::sort(parts.begin(), parts.end());
        CHECK(std::exp(model.typical_sizes[c].log_px) == Approx(areas[areas.size() / 2]));
        CHECK(std::exp(model.typical_sizes[c].log_part) == Approx(parts[parts.size() / 2]));
    }
    // What masks are like, and where objects lie by them, is known of classes that lend theirs.
    REQUIRE(model.typical_masks.size() == 2);
    CHECK(model.typical_masks[0].known());
    CHECK_FALSE(model.typical_masks[1].known());
    REQUIRE(model.placings.size() == 2);
    CHECK(model.placings[0] != ism::Placing{});
    CHECK(model.placings[1] == ism::Placing{});
    const ism::Model two = ism::learn_templates(lending, features, small, 2);
    CHECK(two.typical_masks == model.typical_masks);
    CHECK(two.placings == model.placings);
    CHECK(model_with_templates().placings.empty());
    CHECK(model_with_templates().typical_masks.empty());
}

TEST_CASE("what few masks are like is known less well") {
    CHECK_FALSE(ism::detail::typical_mask({}).known());
    const std::vector<ism::MaskMeasures> one{{.extent = 0.5, .certainty = 0.9, .raggedness = 4}};
    const ism::TypicalMask of_one = ism::detail::typical_mask(one);
    CHECK(of_one.mean == one[0]);
    CHECK(of_one.deviation.extent == Approx(0.06 * std::sqrt(5.0 / 6)));
    CHECK(of_one.deviation.certainty == Approx(0.03 * std::sqrt(5.0 / 6)));
    CHECK(of_one.deviation.raggedness == Approx(0.4 * std::sqrt(5.0 / 6)));
    std::vector<ism::MaskMeasures> many;
    for (int i = 0; i < 1000; ++i)
        many.push_back(
            {.extent = i % 2 == 0 ? 0.4 : 0.6, .certainty = 0.8, .raggedness = i % 2 == 0 ? 3.0 : 5.0});
    const ism::TypicalMask of_many = ism::detail::typical_mask(many);
    CHECK(of_many.mean.extent == Approx(0.5));
    CHECK(of_many.deviation.extent == Approx(0.1).epsilon(0.01));
    CHECK(of_many.deviation.raggedness == Approx(1).epsilon(0.01));
}

TEST_CASE("the same templates for any number of threads") {
    const ism::Model two = ism::learn_templates(model_without_templates(), pattern_features(), small, 2);
    CHECK(two.templates == model_with_templates().templates);
    CHECK(two.patch_classifier == model_with_templates().patch_classifier);
    CHECK(two.template_calibration.curves == model_with_templates().template_calibration.curves);
}

TEST_CASE("without templates hypotheses keep the score of their votes") {
    ism::Model model = model_with_templates();
    model.templates.clear();
    const auto test = pattern_picture(0, 71, 53, 90);
    const TypedModel plain(model);
    const auto found = ism::detect(plain, test.frame, Recognition{}, 1);
    ism::Recognition<ism::Jism, ism::EpanechnikovKernel, ism::NoRescorer, ism::PatchSegmenter,
                     ism::NonMaximumSuppression>
        votes;
    const auto expected = ism::detect(plain, test.frame, votes, 1);
    REQUIRE(found.objects.size() == expected.objects.size());
    for (std::size_t i = 0; i < found.objects.size(); ++i)
        CHECK(found.objects[i].score == expected.objects[i].score);
    for (const auto& object : expected.objects) CHECK(std::isnan(object.probability));
    votes.options.min_probability = 0.5;
    CHECK_THROWS_WITH(ism::detect(plain, test.frame, votes, 1),
                      Catch::Contains("DetectOptions::min_probability: expected 0 where votes alone judge"));
}

TEST_CASE("templates are kept in the model file, pixels with the training features") {
    const ism::test::TemporaryFolder folder;
    const ism::TrainingFeatures& features = pattern_features();
    ism::save_model(folder / "m", model_with_templates(), &features);
    CHECK(ism::load_model(folder / "m").templates == model_with_templates().templates);
    const auto read = ism::load_training_features(folder / "m");
    REQUIRE(read.views.size() == features.views.size());
    for (std::size_t v = 0; v < read.views.size(); ++v)
        CHECK(read.views[v].pixels == features.views[v].pixels);
}

TEST_CASE("what templates cannot be learnt from is refused by name") {
    ism::TrainingFeatures features = pattern_features();
    const ism::Model& words = model_without_templates();
    CHECK_THROWS_WITH(ism::learn_templates(words, features, {.cells = 3}),
                      Catch::Contains("TemplateOptions::cells"));
    CHECK_THROWS_WITH(ism::learn_templates(words, features, {.cost = 0}),
                      Catch::Contains("TemplateOptions::cost"));
    for (ism::TrainingView& view : features.views) view.pixels = {};
    CHECK_THROWS_WITH(ism::learn_templates(words, features),
                      "templates: training images with pixels: expected 1 or more, got 0");
    features = pattern_features();
    features.objects.pop_back();
    CHECK_THROWS_WITH(ism::learn_templates(words, features),
                      Catch::StartsWith("templates: objects of the model"));
    const auto test = pattern_picture(0, 71, 53, 90);
    CHECK_THROWS_WITH(ism::detect(model_with_templates(), test.frame,
                                  Recognition{.rescorer = {.rivals = {.other_classes = -1}}}, 1),
                      Catch::Contains("RivalOptions::other_classes: expected 0 ... 1, got -1"));
}
