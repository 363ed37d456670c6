// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
//
// One suite of properties for every vote space with every descriptor, on small drawn pictures (synthetic).
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "support/catch.hpp"
#include "support/pictures.hpp"

#include "ism/core/random.hpp"
#include "ism/detect/detect.hpp"
#include "ism/feature/dense_grid.hpp"
#include "ism/feature/gray_patch.hpp"
#include "ism/feature/hessian_laplace.hpp"
#include "ism/feature/sift.hpp"
#include "ism/train/append_training_features.hpp"
#include "ism/train/train.hpp"

using ism::test::pattern_picture;

namespace {

const std::vector<std::string> pipeline_names{"first", "second"};

std::vector<ism::TrainingImage> training_set() {
    std::vector<ism::TrainingImage> images;
    for (std::uint64_t i = 0; i < 6; ++i)
        images.push_back(pattern_picture(std::uint32_t(i % 2), 40 + 7 * int(i), 30 + 3 * int(i), i));
    return images;
}

template <class Desc>
ism::TypedModel<ism::HessianLaplace, Desc> train(unsigned threads) {
    const auto images = training_set();
    return ism::train<ism::HessianLaplace, Desc>(pipeline_names, images, {.threads = threads});
}

/// Trained once for all tests.
template <class Desc>
const ism::TypedModel<ism::HessianLaplace, Desc>& trained() {
    static const auto model = train<Desc>(1);
    return model;
}

bool same(const ism::Detections& a, const ism::Detections& b) {
    const auto same_place = [](const ism::Feature& f, const ism::Feature& g) {
        return f.x == g.x && f.y == g.y && f.scale == g.scale && f.strength == g.strength;
    };
    if (a.objects.size() != b.objects.size() ||
        !std::equal(a.features.begin(), a.features.end(), b.features.begin(), b.features.end(), same_place))
        return false;
    for (std::size_t i = 0; i < a.objects.size(); ++i) {
        const auto &p = a.objects[i], &q = b.objects[i];
        if (p.score != q.score || !(p.box == q.box) || p.class_index != q.class_index ||
            p.support.size() != q.support.size() || !(p.segmentation.mask == q.segmentation.mask) ||
            !(p.segmentation.figure == q.segmentation.figure))
            return false;
    }
    return true;
}

}  // namespace

TEMPLATE_PRODUCT_TEST_CASE("every vote space and every descriptor find the object", "", std::tuple,
                           ((ism::Ism, ism::RootSift), (ism::Jism, ism::RootSift),
                            (ism::Ji3sm1, ism::RootSift), (ism::Ji3sm2, ism::RootSift),
                            (ism::Ji3sm3, ism::RootSift), (ism::Jism, ism::Sift), (ism::Ji3sm3, ism::Sift),
                            (ism::Jism, ism::GrayPatch), (ism::Ji3sm3, ism::GrayPatch))) {
    using Space = std::tuple_element_t<0, TestType>;
    using Desc = std::tuple_element_t<1, TestType>;
    const auto& model = trained<Desc>();
    for (const std::uint32_t class_index : {0u, 1u}) {
        const auto test = pattern_picture(class_index, 70, 50, 77 + class_index);
        const auto found = ism::detect<Space>(model, test.frame, {}, 2);
        REQUIRE_FALSE(found.objects.empty());
        const ism::Detection& best = found.objects.front();
        CHECK(best.class_index == class_index);
        CHECK(ism::iou(best.box, test.objects[0].box) > 0.7);
        CHECK(ism::mask_iou(ism::whole_mask(best.segmentation, 200, 160), test.objects[0].mask) > 0.6);
        CHECK(best.depth_m == Approx(1).margin(0.05));
        REQUIRE(best.position_m);
        CHECK(best.position_m->x == Approx((109.5 - 99.5) / 200).margin(0.02));
        CHECK(best.position_m->y == Approx((89.5 - 79.5) / 200).margin(0.02));
        CHECK(best.score > 0);
        REQUIRE_FALSE(best.support.empty());
        for (const ism::Support& s : best.support) {
            CHECK(s.feature < found.features.size());
            CHECK(model.shapes.occurrence(s.occurrence).class_index == best.class_index);
            CHECK(s.occurrence >= model.shapes.occurrences.first(s.word));
            CHECK(s.occurrence <
                  model.shapes.occurrences.first(s.word) + model.shapes.occurrences[s.word].size());
            CHECK((!Space::needs_depth || ism::is_depth(found.features[s.feature].depth_m)));
        }
        CHECK(best.probability > 0.5);
        CHECK(same(found, ism::detect<Space>(model, test.frame, {}, 1)));
    }
}

TEST_CASE("training gives the same model for one and two threads") {
    const auto &one = trained<ism::RootSift>(), two = train<ism::RootSift>(2);
    CHECK(one.channels[0].codebook.means() == two.channels[0].codebook.means());
    REQUIRE(one.shapes.occurrences.values().size() == two.shapes.occurrences.values().size());
    for (std::size_t i = 0; i < one.shapes.occurrences.values().size(); ++i)
        CHECK(one.shapes.occurrence(i).weight == two.shapes.occurrence(i).weight);
    CHECK(one.box_classifier.weights == two.box_classifier.weights);
    CHECK(one.calibration.curves == two.calibration.curves);
}

TEST_CASE("the occurrences of a word weigh 1 together") {
    const auto& model = trained<ism::Sift>();
    for (std::size_t w = 0; w < model.words(); ++w) {
        double sum = 0;
        for (const auto& o : model.shapes.occurrences[w]) sum += o.weight;
        CHECK(sum == Approx(1).margin(1e-4));
    }
}

TEST_CASE("other kernels and plain suppression find the object too") {
    const auto& model = trained<ism::RootSift>();
    const auto test = pattern_picture(1, 30, 60, 5);
    ism::Recognition<ism::Jism, ism::FlatKernel, ism::NoRescorer, ism::PatchSegmenter,
                     ism::NonMaximumSuppression>
        recognition;
    const auto flat = ism::detect(model, test.frame, recognition);
    const auto gauss = ism::detect<ism::Jism, ism::GaussianKernel>(model, test.frame);
    REQUIRE_FALSE((flat.objects.empty() || gauss.objects.empty()));
    CHECK(ism::iou(flat.objects[0].box, test.objects[0].box) > 0.7);
    CHECK(ism::iou(gauss.objects[0].box, test.objects[0].box) > 0.7);
}

TEST_CASE("the judge sees all candidates before the best of them are cut out") {
    auto model = trained<ism::RootSift>();
    model.box_classifier = {};
    for (const float bias : {-20.0f, 20.0f}) model.box_classifier.push_back({}, bias);
    const auto scene = pattern_picture(0, 70, 50, 9);
    const auto one_candidate =
        ism::detect<ism::Jism>(model, scene.frame, {.min_relative_score = 0, .max_candidates = 1});
    REQUIRE(one_candidate.objects.size() == 1);
    CHECK(one_candidate.objects[0].class_index == 0);
    const auto one_cut_out =
        ism::detect<ism::Jism>(model, scene.frame, {.min_relative_score = 0, .max_hypotheses = 1});
    REQUIRE(one_cut_out.objects.size() == 1);
    CHECK(one_cut_out.objects[0].class_index == 1);
}

TEST_CASE("results tell how much there was to do at each station") {
    const auto& model = trained<ism::RootSift>();
    const auto found = ism::detect<ism::Jism>(model, pattern_picture(0, 70, 50, 9).frame);
    const ism::DetectionStats& stats = found.stats;
    CHECK(stats.features == found.features.size());
    CHECK(stats.matches > 0);
    CHECK(stats.votes > 0);
    CHECK(stats.hypotheses >= stats.segmented);
    CHECK(stats.candidates == stats.hypotheses);
    CHECK(stats.segmented >= found.objects.size());
    for (const double ms : {stats.extract_ms, stats.match_ms, stats.vote_ms, stats.segment_ms}) CHECK(ms > 0);
}

TEST_CASE("where masks are not needed to verify, only what stays is cut out") {
    struct MasksFirst {
        [[nodiscard]] std::vector<ism::Verified> verify(const std::vector<ism::Detection>& hypotheses,
                                                        const ism::Scene&) const {
            for (const ism::Detection& hypothesis : hypotheses)
                CHECK_FALSE(hypothesis.segmentation.mask.empty());
            return ism::NonMaximumSuppression{}.verify(hypotheses);
        }
    };
    const auto& model = trained<ism::RootSift>();
    const auto scene = pattern_picture(0, 70, 50, 9);
    const ism::DetectOptions all{.min_relative_score = 0};
    const auto late =
        ism::detect(model, scene.frame,
                    ism::Recognition<ism::Jism, ism::EpanechnikovKernel, ism::NoRescorer, ism::PatchSegmenter,
                                     ism::NonMaximumSuppression>{.options = all});
    const auto early = ism::detect(model, scene.frame,
                                   ism::Recognition<ism::Jism, ism::EpanechnikovKernel, ism::NoRescorer,
                                                    ism::PatchSegmenter, MasksFirst>{.options = all});
    CHECK(late.stats.segmented == late.objects.size());
    CHECK(early.stats.segmented > late.stats.segmented);
    REQUIRE(late.objects.size() == early.objects.size());
    for (std::size_t i = 0; i < late.objects.size(); ++i) {
        CHECK(late.objects[i].box == early.objects[i].box);
        CHECK(late.objects[i].segmentation.mask == early.objects[i].segmentation.mask);
    }
}

TEST_CASE("frame after frame of other sizes a detector finds what a new one finds") {
    const auto& model = trained<ism::RootSift>();
    ism::FrameDetector detector(model, 2);
    const auto small = ism::Frame{.gray = ism::GrayImage(64, 48, 0.5f)};
    const auto first = pattern_picture(0, 70, 50, 9), second = pattern_picture(1, 30, 40, 10, false);
    for (const ism::Frame* frame : {&first.frame, &small, &second.frame, &first.frame})
        CHECK(same(detector.detect<ism::Jism>(*frame), ism::detect<ism::Jism>(model, *frame)));
    // What a space needs is asked before anything is done, and an error leaves the detector as it was.
    CHECK_THROWS_WITH(detector.detect<ism::Ji3sm3>(second.frame),
                      Catch::Contains("depth image: expected one"));
    CHECK(same(detector.detect<ism::Ji3sm3>(first.frame), ism::detect<ism::Ji3sm3>(model, first.frame)));
}

TEST_CASE("words of two channels of other lengths vote together") {
    const auto images = training_set();
    const std::vector<ism::AnyExtractor> extractors{ism::Extractor<ism::HessianLaplace, ism::RootSift>{},
                                                    ism::Extractor<ism::DenseGrid, ism::GrayPatch>{}};
    const auto features =
        ism::extract_training_features(pipeline_names, ism::training_set(images), extractors);
    REQUIRE(features.samples.size() == 2);
    CHECK(features.samples[0].descriptors.dimension() == 128);
    CHECK(features.samples[1].descriptors.dimension() == 625);
    const auto twice = ism::append(features, features);
    for (std::uint32_t c = 0, number = 0; c < 2; ++c)
        for (const ism::Occurrence& o : twice.samples[c].occurrences) CHECK(o.feature == number++);
    const ism::Model model = ism::learn(features);
    REQUIRE(model.channels.size() == 2);
    REQUIRE(model.words() == model.channels[0].codebook.size() + model.channels[1].codebook.size());
    const auto test = pattern_picture(1, 70, 50, 78);
    const std::vector<ism::AnyExtractor> of_model{
        {ism::Extractor<ism::HessianLaplace, ism::RootSift>{}, model.channels[0].features},
        {ism::Extractor<ism::DenseGrid, ism::GrayPatch>{}, model.channels[1].features}};
    ism::FrameDetector detector(model, of_model, 2);
    const auto found = detector.detect<ism::Jism>(test.frame);
    REQUIRE_FALSE(found.objects.empty());
    CHECK(found.objects[0].class_index == 1);
    CHECK(ism::iou(found.objects[0].box, test.objects[0].box) > 0.7);
    std::array<std::size_t, 2> votes{};
    for (const ism::Support& s : found.objects[0].support) ++votes[s.word < model.first_word(1) ? 0 : 1];
    CHECK(votes[0] > 0);
    CHECK(votes[1] > 0);
    // Extractors that are not the model's are refused.
    CHECK_THROWS_WITH(ism::FrameDetector(model, {extractors[0]}),
                      Catch::Contains("one a channel: expected 2, got 1"));
    CHECK_THROWS_WITH(ism::FrameDetector(model, {extractors[1], extractors[0]}),
                      Catch::Contains("features of the model: expected hessian-laplace, root-sift"));
    CHECK_THROWS_WITH(ism::FrameDetector(model, extractors),  // training enlarges small objects
                      Catch::Contains("options of features: expected those of the model"));
    ism::TrainingFeatures others = features;
    others.settings[1].options.scale_space.levels_per_octave += 1;
    CHECK_THROWS_WITH(ism::append(features, others),
                      Catch::Contains("the same options of detector and descriptor"));
    CHECK_THROWS_WITH((ism::TypedModel<ism::HessianLaplace, ism::RootSift>(model)),
                      Catch::Contains("channels of words: expected 1, got 2"));
}

TEST_CASE("options of detection and of its policies are refused by name") {
    const auto& model = trained<ism::RootSift>();
    const auto frame = pattern_picture(0, 50, 50, 3).frame;
    const auto refuses = [&](const char* what, const auto& change) {
        ism::Recognition<> recognition;
        change(recognition);
        CHECK_THROWS_WITH(ism::detect(model, frame, recognition), Catch::Contains(what));
    };
    for (const double bad : {-0.1, 1.5, std::nan("")}) {
        refuses("DetectOptions::min_relative_score", [&](auto& r) { r.options.min_relative_score = bad; });
        refuses("DetectOptions::min_relative_votes", [&](auto& r) { r.options.min_relative_votes = bad; });
    }
    for (const double bad : {-1.0, 1e10, std::nan("")}) {
        refuses("DetectOptions::min_size_px", [&](auto& r) { r.options.min_size_px = bad; });
        refuses("DetectOptions::max_size_px", [&](auto& r) { r.options.max_size_px = bad; });
    }
    refuses("DetectOptions::max_size_px",
            [](auto& r) { r.options.min_size_px = 9, r.options.max_size_px = 8; });
    refuses("DetectOptions::min_vote_weight", [](auto& r) { r.options.min_vote_weight = NAN; });
    refuses("bandwidth", [](auto& r) { r.bandwidth.at_scale_1[0] = 0; });
    for (const double bad : {0.0, 1e9, std::nan("")})
        refuses("PatchSegmenter::patch_radius", [&](auto& r) { r.segmenter.patch_radius = bad; });
    for (const double bad : {-1.0, 1e9, std::nan("")})
        refuses("PatchSegmenter::margin", [&](auto& r) { r.segmenter.margin = bad; });
    for (const int bad : {0, -3, std::numeric_limits<int>::max()})
        refuses("PatchSegmenter::max_cells", [&](auto& r) { r.segmenter.max_cells = bad; });
    for (const double bad : {-1.0, std::nan("")}) {
        refuses("Mdl::k1_over_k0", [&](auto& r) { r.verifier.k1_over_k0 = bad; });
        refuses("Mdl::k2_over_k0", [&](auto& r) { r.verifier.k2_over_k0 = bad; });
    }
}

TEST_CASE("an empty scene gives an empty result, not an error") {
    const auto& model = trained<ism::RootSift>();
    const ism::Frame blank{.gray = ism::GrayImage(120, 90, 0.3f)};
    CHECK(ism::detect<ism::Jism>(model, blank).objects.empty());
}

TEST_CASE("wrong frames are refused by name") {
    const auto& model = trained<ism::RootSift>();
    const auto good = pattern_picture(0, 50, 50, 3).frame;
    const auto refuses = [&](ism::Frame frame, const char* what) {
        CHECK_THROWS_WITH(ism::detect<ism::Ji3sm3>(model, frame), Catch::Contains(what));
    };
    refuses({.gray = ism::GrayImage()}, "image size");
    refuses({.gray = ism::GrayImage(15, 200)}, "image size: expected at least 16x16, got 15x200");
    CHECK_THROWS_WITH(ism::detect<ism::Jism>(model, {.gray = ism::GrayImage(64, 64, NAN)}),
                      Catch::Contains("image brightness"));
    refuses({.gray = good.gray}, "depth image: expected one");
    refuses({.gray = good.gray, .depth_m = ism::DepthMap(10, 10, 1.0f)},
            "depth image size: expected 200x160");
    refuses({.gray = good.gray, .depth_m = ism::DepthMap(200, 160, 0.0f)},
            "depth image: expected at least one");
    refuses({.gray = good.gray, .depth_m = good.depth_m, .camera = ism::Camera{0, 1, 0, 0}},
            "camera focal lengths");
    CHECK_THROWS_WITH(ism::detect<ism::Jism>(model, good, {.min_relative_score = 1.5}),
                      Catch::Contains("T_ratio"));
    const ism::TypedModel<ism::HessianLaplace, ism::RootSift> untrained;
    CHECK_THROWS_WITH(ism::detect<ism::Jism>(untrained, good),
                      Catch::Contains("model: channels of words: expected 1, got 0"));
}

TEST_CASE("what users build of detection is refused where it makes no sense") {
    const auto model = trained<ism::RootSift>();
    const auto test = pattern_picture(1, 70, 50, 78);
    struct MaskAlone {
        [[nodiscard]] ism::Segmentation segment(const ism::Detection&, const ism::Scene&) const {
            ism::Segmentation part;
            part.mask = ism::Mask(4, 4, 1);
            return part;
        }
    };
    CHECK_THROWS_WITH(
        ism::detect(
            model, test.frame,
            ism::Recognition<ism::Jism, ism::EpanechnikovKernel, ism::NoRescorer, MaskAlone, ism::Mdl>{}),
        Catch::Contains("maps of figure and ground: expected 4x4, got 0x0"));
    struct MaskAndBox {  // as from a classifier of pixels that tells no maps
        ism::Box box{20, 20, 40, 40};
        [[nodiscard]] ism::Segmentation segment(const ism::Detection&, const ism::Scene&) const {
            return {.figure = ism::GrayImage(40, 40, 0.0f),
                    .ground = ism::GrayImage(40, 40, 0.0f),
                    .mask = ism::Mask(40, 40, 1),
                    .box = box};
        }
    };
    ism::Recognition<ism::Jism, ism::EpanechnikovKernel, ism::NoRescorer, MaskAndBox, ism::Mdl> cut;
    CHECK_FALSE(ism::detect(model, test.frame, cut).objects.empty());
    cut.segmenter.box.width = -1;
    CHECK_THROWS_WITH(ism::detect(model, test.frame, cut),
                      Catch::Contains("segmentation: box: expected finite numbers, with sides above 0"));
    struct Other {
        double factor = 1;
        std::uint32_t more_classes = 0;
        [[nodiscard]] std::vector<ism::Detection> rescore(std::vector<ism::Detection> hypotheses,
                                                          const ism::Scene&) const {
            for (ism::Detection& one : hypotheses) one.score *= factor, one.class_index += more_classes;
            return hypotheses;
        }
    };
    ism::Recognition<ism::Jism, ism::EpanechnikovKernel, Other> rescored;
    CHECK_FALSE(ism::detect(model, test.frame, rescored).objects.empty());
    for (const double factor : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
        rescored.rescorer.factor = factor;
        CHECK_THROWS_WITH(ism::detect(model, test.frame, rescored),
                          Catch::Contains("rescorer: score: expected a number of 0 or more"));
    }
    rescored.rescorer = {.more_classes = 70};
    CHECK_THROWS_WITH(ism::detect(model, test.frame, rescored),
                      Catch::Contains("rescorer: class: expected below"));
    struct First {
        std::size_t times = 1;
        [[nodiscard]] bool needs_masks() const { return false; }
        [[nodiscard]] std::vector<ism::Verified> verify(const std::vector<ism::Detection>& hypotheses,
                                                        const ism::Scene&) const {
            return std::vector<ism::Verified>(times, {0, hypotheses.front().score});
        }
    };
    ism::Recognition<ism::Jism, ism::EpanechnikovKernel, ism::NoRescorer, ism::PatchSegmenter, First> first;
    CHECK(ism::detect(model, test.frame, first).objects.size() == 1);
    first.verifier.times = 2;
    CHECK_THROWS_WITH(ism::detect(model, test.frame, first),
                      Catch::Contains("verifier: index of a hypothesis: expected one below"));
    CHECK_THROWS_WITH(ism::detect<ism::Jism>(model, test.frame, {.max_size_px = 1}),
                      Catch::Contains("DetectOptions::max_size_px: expected 0 or at least"));
    CHECK_THROWS_WITH(ism::detect<ism::Jism>(model, test.frame, {.max_candidates = 0}),
                      Catch::Contains("DetectOptions::max_candidates: expected 1 or more, got 0"));
    ism::Frame frame = test.frame;
    const ism::Frame taken = std::move(frame);
    CHECK(frame.gray.width() == 0);  // NOLINT(bugprone-use-after-move)
    CHECK_THROWS_AS(ism::detect<ism::Jism>(model, frame), ism::Error);
    CHECK_FALSE(ism::detect<ism::Jism>(model, taken).objects.empty());
    const ism::TypedModel<ism::HessianLaplace, ism::RootSift> empty;
    CHECK_THROWS_AS(ism::FrameDetector(empty), ism::Error);
}

TEST_CASE("wrong training images are refused by name") {
    auto images = training_set();
    const auto train = [&](const ism::TrainOptions& options = {.box_classifier = {}, .calibrate = false}) {
        return ism::train<ism::HessianLaplace, ism::RootSift>(pipeline_names, images, options);
    };
    CHECK_THROWS_WITH(train({.codebook = {.min_similarity = 2}}), Catch::Contains("similarity"));
    CHECK_THROWS_WITH(train({.codebook = {.min_cluster_size = 0}}), Catch::Contains("min_cluster_size"));
    CHECK_THROWS_WITH(train({.codebook = {.min_cluster_size = 100000}}),
                      Catch::Contains("at least 100000 features"));
    CHECK_THROWS_WITH(train({.selection = {.min_information_gain = 1}}), Catch::Contains("information gain"));
    const std::vector<std::string> twice{"first", "first"};
    CHECK_THROWS_WITH((ism::train<ism::HessianLaplace, ism::RootSift>(twice, images)),
                      Catch::Contains("names of classes: expected each once, got first"));
    images[2].objects[0].position_m = ism::Point3{NAN, 0, 1};
    CHECK_THROWS_WITH(train(), Catch::Contains("picture 2: position of an object"));
    images[2].objects[0].position_m.reset();
    images[2].objects[0].mask = ism::Mask(5, 5, 1);
    CHECK_THROWS_WITH(train(), Catch::Contains("picture 2: mask size: expected 200x160, got 5x5"));
    images[2].objects[0].mask = ism::Mask(200, 160);
    images[2].objects[0].mask(3, 3) = 1;
    CHECK_THROWS_WITH(train(), Catch::Contains("picture 2: mask: expected at least 2 figure pixels, got 1"));
    images[2].objects[0].mask = {};  // the box is the mask
    images[3].objects.clear();       // background
    CHECK_NOTHROW(train());
    images[2].objects[0].class_index = 7;
    CHECK_THROWS_WITH(train(), Catch::Contains("picture 2: class of an object"));
    images[2].objects.clear();
    for (auto& image : images) std::erase_if(image.objects, [](const auto& o) { return o.class_index == 1; });
    CHECK_THROWS_WITH(train(), Catch::Contains("objects of class second"));
    images = training_set();
    for (std::size_t i : {0u, 2u, 4u}) images[i].frame.gray = ism::GrayImage(200, 160, 0.5f);
    CHECK_THROWS_WITH(train(), Catch::Contains("features on objects of class first"));
}

TEST_CASE("small training objects are enlarged, as the data asks") {
    CHECK(trained<ism::RootSift>().extractor().options.upsampling == Approx(150.0 / 80));
}
