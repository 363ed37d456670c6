// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
//
// From training features to detections in metres, on made scenes.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/metric_scene.hpp"

#include "ism/detect/metric_recognition.hpp"
#include "ism/train/learn_mask_judge.hpp"
#include "ism/train/learn_metric.hpp"

namespace {

using metric_scene::Thing;
using metric_scene::View;

const ism::TrainingFeatures& all_lessons() {
    static const auto lessons = metric_scene::lessons(metric_scene::training_views());
    return lessons;
}

const ism::Model& learnt() {
    static const ism::Model model = ism::learn_mask_judge(ism::learn_metric(all_lessons()), all_lessons());
    return model;
}

/// Votes alone.
std::vector<ism::Detection> voted(const View& view, const ism::Model& model, unsigned threads = 1) {
    ism::ThreadPool pool(threads);
    const ism::Recognition<ism::Metric, ism::EpanechnikovKernel, ism::NoRescorer, ism::KeepSegmentation,
                           ism::NonMaximumSuppression>
        votes{.options = ism::metric_proposal_options()};
    return ism::recognise(metric_scene::scene_of(view, model, pool), votes).objects;
}

double error_m(const ism::Detection& found, ism::Vec3f truth) {
    return found.position_m ? length(to_vec3f(*found.position_m) - truth) : 1;
}

/// In the image; the sides were never seen in training.
ism::Box box_of_front(const Thing& thing) {
    const ism::Vec3f half = metric_scene::half_sides[thing.class_index];
    std::vector<ism::Vec3f> corners;
    for (const float x : {-half.x, half.x})
        for (const float y : {-half.y, half.y}) corners.push_back({x, y, 0});
    return posed_box({thing.front_m, thing.rotation}, corners, metric_scene::camera);
}

const ism::Rotation quarter = ism::rotation_around({0, 0, 1}, std::numbers::pi / 2);
const ism::Rotation tilted = ism::rotation_around({0.6f, 1, 0}, 0.35) * quarter;

}  // namespace

TEST_CASE("an object is found where it lies in space, turned and tilted, with its box") {
    const ism::Model& model = learnt();
    for (const Thing& thing : {Thing{0, {0, 0, 0.8f}}, Thing{0, {0.1f, -0.05f, 0.7f}, quarter},
                               Thing{1, {-0.1f, 0.06f, 0.9f}, tilted}}) {
        const View view = metric_scene::seen({thing, {1 - thing.class_index, {0.25f, 0.15f, 1.1f}}}, 3);
        const auto found = voted(view, model);
        REQUIRE_FALSE(found.empty());
        const auto of_class = std::find_if(found.begin(), found.end(), [&](const ism::Detection& d) {
            return d.class_index == thing.class_index;
        });
        REQUIRE(of_class != found.end());
        const ism::Detection& best = *of_class;
        CAPTURE(thing.class_index, error_m(best, thing.front_m), best.score);
        CHECK(error_m(best, thing.front_m) < 0.004);
        CHECK(best.depth_m == best.position_m->z);
        CHECK(ism::iou(best.box, box_of_front(thing)) > 0.9);
        CHECK(best.support.size() > 20);
        CHECK(best.position_error_m < 0.004);
        const auto wanted_m = std::sqrt(4 * metric_scene::half_sides[thing.class_index].x *
                                        metric_scene::half_sides[thing.class_index].y);
        CHECK(best.size_m > wanted_m);  // boxes of training images may be turned
        CHECK(best.size_m < 1.5 * wanted_m);
        // The training object is turned by 0 or 0.5 radians itself.
        REQUIRE(best.rotation);
        const auto& heaviest = best.support.front();
        const std::uint32_t object = model.shapes.occurrence(heaviest.occurrence).object;
        const ism::Rotation of_training = ism::rotation_around({0, 0, 1}, object % 2 == 0 ? 0 : 0.5);
        const ism::Rotation turned = *best.rotation * of_training * inverse(thing.rotation);
        CHECK(std::abs(turned.w) > 0.999f);
    }
}

TEST_CASE("a position may be off by as much as votes scatter, however many they are") {
    // The places of features, moved at random, scatter their votes.
    const Thing thing{0, {0.05f, 0.02f, 0.8f}};
    const auto moved_by = [&](double pixels, int each) {
        View view = metric_scene::seen({thing}, 5, each);
        ism::Random random(9);
        for (ism::Feature& f : view.found.features)
            f.x += float(pixels * random.normal()), f.y += float(pixels * random.normal());
        return voted(view, learnt()).at(0);
    };
    const ism::Detection few = moved_by(1, 6), many = moved_by(1, 30), far = moved_by(3, 30);
    CHECK(few.support.size() >= 5);
    CHECK(few.position_error_m > 0.0005);
    CHECK(many.position_error_m > few.position_error_m);  // six scatter less around their own mean
    CHECK(many.position_error_m < 3 * few.position_error_m);
    CHECK(far.position_error_m > 1.5 * many.position_error_m);
    CHECK(error_m(many, thing.front_m) < many.position_error_m);
}

TEST_CASE("votes, colours and shapes judge regions: mask, class, position and reasons") {
    const ism::Model& model = learnt();
    const std::vector<Thing> things{{0, {-0.15f, 0.05f, 0.8f}, quarter}, {1, {0.15f, -0.04f, 0.9f}}};
    const View view = metric_scene::seen(things, 21);
    std::vector<ism::Detections> results;
    for (const unsigned threads : {1u, 2u}) {
        ism::ThreadPool pool(threads);
        auto recognition = ism::metric_recognition();
        recognition.options.min_probability = 0.5;
        results.push_back(ism::recognise(metric_scene::scene_of(view, model, pool), recognition));
    }
    const auto& found = results[0].objects;
    REQUIRE(found.size() == 2);
    for (const ism::Detection& d : found) {
        REQUIRE(d.class_index < 2);
        const std::size_t t = d.class_index;
        CHECK(iou({d.segmentation.x, d.segmentation.y, d.segmentation.mask}, view.masks[t]) > 0.9);
        CHECK(ism::iou(d.box, box_of(view.masks[t])) > 0.9);
        CHECK(error_m(d, things[t].front_m) < 0.005);
        CHECK(d.probability == Approx(d.score / (1 + d.score)));
        REQUIRE(d.reasons);
        CHECK(model.shapes.objects.at(*d.reasons->color_object).class_index == d.class_index);
        CHECK(model.shapes.objects.at(*d.reasons->shape_object).class_index == d.class_index);
        CHECK(d.reasons->votes > 0);
    }
    CHECK(found[0].class_index != found[1].class_index);
    const auto& again = results[1].objects;
    REQUIRE(again.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(again[i].score == found[i].score);
        CHECK(again[i].position_m == found[i].position_m);
        CHECK(again[i].segmentation.mask == found[i].segmentation.mask);
    }
}

TEST_CASE("training in metres gives the same model for one and two threads") {
    const ism::Model one =
        ism::learn_mask_judge(ism::learn_metric(all_lessons(), {}, 1), all_lessons(), {}, 1);
    const ism::Model& two = learnt();  // all threads
    CHECK(one.channels[0].codebook.means() == two.channels[0].codebook.means());
    CHECK(one.mask_judge.weights == two.mask_judge.weights);
    CHECK(one.mask_judge.bias == two.mask_judge.bias);
    CHECK(one.mask_judge.examples == two.mask_judge.examples);
    for (std::size_t i = 0; i < one.shapes.objects.size(); ++i)
        CHECK(one.shapes.objects[i].points_m == two.shapes.objects[i].points_m);
    CHECK(one.words() == all_lessons().views.size() * 45);
    CHECK(one.shapes.frames.size() == all_lessons().views.size() * 30);  // the wall's have none
    for (const ism::OccurrenceFrame& frame : one.shapes.frames) CHECK(frame.scale_m > 0.003f);
}

TEST_CASE("what a model in metres cannot be learnt from is refused by name") {
    ism::TrainingFeatures lessons = all_lessons();
    lessons.settings.resize(2);
    CHECK_THROWS_WITH(ism::learn_metric(lessons),
                      Catch::Contains("metric model: channels: expected 1, got 2"));
    lessons = all_lessons();
    for (auto& view : lessons.views) view.depth.reset();
    CHECK_THROWS_WITH(ism::learn_metric(lessons),
                      Catch::Contains("training from depth: images with depth and camera"));
    CHECK_THROWS_WITH(ism::learn_mask_judge(learnt(), lessons),
                      Catch::Contains("training from depth: images with depth and camera"));
    lessons.views.clear();
    CHECK_THROWS_AS(ism::learn_metric(lessons), ism::Error);
    lessons = all_lessons();
    lessons.views[2].pixels = {};
    CHECK_THROWS_WITH(ism::learn_mask_judge(learnt(), lessons),
                      Catch::Contains("colours of training images"));
    ism::TrainingFeatures alone = all_lessons();  // one image: no other to compare its regions with
    const std::uint32_t objects = alone.views.front().end_object;
    alone.views.resize(1), alone.objects.resize(objects), alone.class_names.resize(1);
    CHECK_THROWS_WITH(ism::learn_mask_judge(learnt(), alone),
                      Catch::StartsWith("judge of masks: objects of the model"));
    CHECK_THROWS_WITH(ism::learn_mask_judge(ism::learn_metric(alone), alone),
                      Catch::StartsWith("judge of masks: regions to compare with those of other images"));
}

TEST_CASE("a model without local frames or without a judge is refused by name") {
    const View view = metric_scene::seen({{0, {0, 0, 0.8f}}}, 4);
    ism::ThreadPool pool(1);
    const ism::Model votes_alone = ism::learn_metric(all_lessons());
    CHECK_THROWS_WITH(
        ism::recognise(metric_scene::scene_of(view, votes_alone, pool), ism::metric_recognition()),
        Catch::Contains("learn_mask_judge"));
    ism::Model flat = learnt();
    flat.shapes.frames.clear();
    CHECK_THROWS_WITH(ism::recognise(metric_scene::scene_of(view, flat, pool), ism::metric_recognition()),
                      Catch::Contains("learn_metric"));
    View blind = view;
    blind.frame.camera.reset();
    CHECK_THROWS_WITH(
        ism::recognise(metric_scene::scene_of(blind, learnt(), pool), ism::metric_recognition()),
        Catch::Contains("camera: expected one"));
    blind.frame.depth_m = {};
    CHECK_THROWS_WITH(
        ism::recognise(metric_scene::scene_of(blind, learnt(), pool), ism::metric_recognition()),
        Catch::Contains("depth image: expected one"));
    ism::Recognition<ism::Jism, ism::EpanechnikovKernel, ism::MaskJudgeScore, ism::KeepSegmentation,
                     ism::MaskSuppression>
        flat_space;
    CHECK_THROWS_WITH(ism::recognise(metric_scene::scene_of(view, learnt(), pool), flat_space),
                      Catch::Contains("a space with poses"));
}

TEST_CASE("images without depth, without objects, and objects without readings are no trouble") {
    std::vector<View> views = metric_scene::training_views();
    views.push_back(metric_scene::seen({}, 55));  // background
    views.push_back(metric_scene::seen({{0, {0.1f, 0, 0.8f}}, {1, {-0.2f, 0, 0.8f}}}, 56));
    for (int y = 0; y < metric_scene::height; ++y)
        for (int x = 0; x < metric_scene::width; ++x)
            if (contains(views.back().masks[0], x, y)) views.back().frame.depth_m(x, y) = ism::no_depth;
    ism::TrainingFeatures lessons = metric_scene::lessons(views);
    lessons.views[0].depth.reset();  // an image of colours alone
    const ism::Model model = ism::learn_mask_judge(ism::learn_metric(lessons), lessons);
    CHECK(model.shapes.objects.size() == 6);
    CHECK(model.shapes.objects[0].points_m.empty());
    CHECK(model.shapes.objects[4].points_m.empty());
    CHECK(model.shapes.objects[4].size_m == 0);
    CHECK(model.shapes.objects[5].points_m.size() == ism::max_object_points);
    CHECK(std::isfinite(model.mask_judge.bias));
    for (std::size_t k = 0; k < ism::mask_cue_count; ++k) {
        CHECK(std::isfinite(model.mask_judge.weights[k]));
        CHECK(std::isfinite(model.mask_judge.mean[k]));
        CHECK(model.mask_judge.deviation[k] > 0);
    }
    const Thing thing{1, {0.05f, 0.02f, 0.9f}, quarter};
    const auto found = voted(metric_scene::seen({thing}, 57), model);
    REQUIRE_FALSE(found.empty());
    CHECK(found[0].class_index == 1);
    CHECK(error_m(found[0], thing.front_m) < 0.004);
}

TEST_CASE("all objects of a class may be in one image, or in images of colours alone") {
    // Red twice in one image, beside blue: nothing but itself to compare the judge's examples of red with.
    const View both = metric_scene::seen(
        {{0, {-0.2f, -0.1f, 0.9f}}, {0, {0.15f, 0.1f, 0.9f}}, {1, {0.15f, -0.12f, 0.9f}}}, 61);
    ism::TrainingFeatures lessons =
        metric_scene::lessons({both, metric_scene::seen({{1, {0, 0, 0.8f}}}, 62)});
    const auto is_sound = [](const ism::Model& model) {
        for (const float weight : model.mask_judge.weights) CHECK(std::isfinite(weight));
        CHECK(std::isfinite(model.mask_judge.bias));
        const View view = metric_scene::seen({{1, {0.05f, 0.02f, 0.85f}}}, 63);
        ism::ThreadPool pool(1);
        auto recognition = ism::metric_recognition();
        recognition.verifier.second_choices = true;
        const auto found = ism::recognise(metric_scene::scene_of(view, model, pool), recognition).objects;
        for (const ism::Detection& d : found) CHECK(std::isfinite(d.score));
        return found;
    };
    const auto found = is_sound(ism::learn_mask_judge(ism::learn_metric(lessons), lessons));
    REQUIRE_FALSE(found.empty());
    CHECK(found[0].class_index == 1);
    lessons.views[0].depth.reset();  // no red with depth
    (void)is_sound(ism::learn_mask_judge(ism::learn_metric(lessons), lessons));
    lessons.views[1].labels.clear();  // nor blue: all is background
    lessons.views[1].depth->masks.clear();
    lessons.views[1].end_object = lessons.views[1].first_object;
    CHECK(ism::learn_metric(lessons).shapes.frames.empty());
    (void)is_sound(ism::learn_mask_judge(ism::learn_metric(lessons), lessons));
}
