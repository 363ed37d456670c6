// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/thread_pool.hpp"
#include "ism/detect/hypotheses.hpp"
#include "ism/evaluate/voting_confidence.hpp"
#include "ism/train/training_surface.hpp"
#include "ism/vote/metric.hpp"

namespace {

constexpr ism::Camera camera{500, 500, 100, 100};

/// One class, one word, one object of .2 m, seen .8 m away: 125 px; its feature lies .05 m before its centre.
ism::Model one_word() {
    ism::Model model;
    model.shapes.class_names = {"toy"};
    model.shapes.objects = {{.width = 200, .height = 200, .size_px = 125, .image = "", .size_m = 0.2f}};
    model.shapes.occurrences.push_back(
        std::vector<ism::Occurrence>{{.x = 40, .y = 0, .scale = 8, .depth_m = -0.05f}});
    return model;
}

/// What one feature votes through that word, by weight; 0 without a vote.
template <class Space>
double weight_of(const ism::Feature& feature, const ism::ShapeModel& shapes, double size_deviation = 0.25) {
    const std::vector<ism::Feature> features{feature};
    const std::vector<ism::Match> matches{{0, 0, 1}};
    const auto votes =
        ism::cast_votes<Space>(features, matches, shapes, &camera, {.size_deviation = size_deviation});
    return votes.empty() ? 0 : votes[0].weight;
}

}  // namespace

TEST_CASE("With relative depth a feature votes for the depth of the object's centre") {
    const ism::Model model = one_word();
    const ism::Feature feature{.x = 100, .y = 100, .scale = 4, .depth_m = 0.95f};
    const ism::Occurrence& seen = model.shapes.occurrence(0);
    const ism::VoteSource source{feature, seen, model.shapes.objects[0], &camera,
                                 ism::placement(feature, seen)};
    CHECK(ism::Depth::vote(source) == Approx(1.0));
    CHECK(ism::ScaledDepth::vote(source) == Approx(0.5));
    ism::Occurrence flat = seen;
    flat.depth_m = ism::no_depth;
    const ism::VoteSource unknown{feature, flat, model.shapes.objects[0], &camera,
                                  ism::placement(feature, flat)};
    CHECK(ism::Depth::vote(unknown) == Approx(0.95));
}

TEST_CASE("In a space with depth votes for objects of another size in metres weigh less") {
    ism::Model model = one_word();
    // Half the reference size at 1 m: 100 px · 1 m / 500 px = .2 m, as learnt; twice as far .4 m.
    const ism::Feature right{.x = 100, .y = 100, .scale = 4, .depth_m = 0.95f};
    const ism::Feature far{.x = 100, .y = 100, .scale = 4, .depth_m = 1.95f};
    const ism::Feature near{.x = 100, .y = 100, .scale = 4, .depth_m = 0.45f};
    CHECK(weight_of<ism::Ji3sm1>(right, model.shapes, 0.01) == Approx(1));
    const double likelihood = std::exp(-std::log(2) * std::log(2) / 0.32);
    CHECK(weight_of<ism::Ji3sm3>(far, model.shapes, 0.4) == Approx(likelihood));
    CHECK(weight_of<ism::Ji3sm2>(near, model.shapes, 0.4) == Approx(likelihood));
    CHECK(weight_of<ism::Ji3sm1>(far, model.shapes, 0.2) == 0);
    CHECK(weight_of<ism::Jism>(far, model.shapes) == 1);
    model.shapes.objects[0].size_m = 0;  // not known
    CHECK(weight_of<ism::Ji3sm3>(far, model.shapes) == 1);
}

TEST_CASE("What is too light once its size is known, or behind the camera, is no vote; limits are checked") {
    const ism::Model model = one_word();
    const std::vector<ism::Match> matches{{0, 0, 1}};
    const auto votes = [&](const ism::Feature& feature, const ism::VoteLimits& limits,
                           const ism::ShapeModel& shapes) {
        return ism::cast_votes<ism::Ji3sm1>(std::vector{feature}, matches, shapes, nullptr, limits).size() +
               10 * ism::cast_votes<ism::Ji3sm1>(std::vector{feature}, matches, shapes, &camera, limits)
                        .size();
    };
    const ism::Feature far{.x = 100, .y = 100, .scale = 4, .depth_m = 1.95f};
    CHECK(votes(far, {.size_deviation = 0.4}, model.shapes) == 11);
    CHECK(votes(far, {.min_weight = 0.5f, .size_deviation = 0.4}, model.shapes) == 1);  // .22 with a camera

    ism::ShapeModel behind = model.shapes;
    behind.occurrences = {};
    behind.occurrences.push_back(
        std::vector<ism::Occurrence>{{.x = 40, .y = 0, .scale = 8, .depth_m = 2.5f}});
    CHECK(votes(far, {}, behind) == 0);

    const double nan = std::nan("");
    CHECK_THROWS_WITH(votes(far, {.size_deviation = 0}, model.shapes),
                      "VoteLimits::size_deviation: expected above 0, got 0");
    CHECK_THROWS_AS(votes(far, {.size_deviation = nan}, model.shapes), ism::Error);
    CHECK_THROWS_AS(votes(far, {.max_size_ratio = 0.9}, model.shapes), ism::Error);
    CHECK_THROWS_AS(votes(far, {.min_weight = -1}, model.shapes), ism::Error);
    CHECK_THROWS_AS(votes(far, {.width = nan}, model.shapes), ism::Error);
    CHECK_THROWS_AS(votes(far, {.min_scale = 2, .max_scale = 1}, model.shapes), ism::Error);
}

TEST_CASE("A hypothesis with depth has the size of its training objects at its distance") {
    const ism::Model model = one_word();
    const ism::Frame frame{.gray = ism::GrayImage(200, 200), .camera = camera};
    ism::ThreadPool pool(1);
    ism::Scene scene{.frame = frame, .model = model, .pool = pool};
    scene.features = {{.x = 120, .y = 100, .scale = 6, .depth_m = 0.95f}};  // its scale says 150 px
    const auto found = ism::describe_hypothesis_at_depth(1, {{.weight = 1}}, scene);
    CHECK(found.depth_m == Approx(1));
    CHECK(found.scale == Approx(0.5));
    CHECK(found.box.width == Approx(100));
    CHECK(found.centre.x == Approx(100));  // 40 · .5 px left of the feature
    CHECK(found.position_m->z == Approx(1));
    CHECK(found.position_m->x == Approx(0).margin(1e-6));
    CHECK(ism::describe_hypothesis(1, {{.weight = 1}}, scene).scale == Approx(0.75));
}

TEST_CASE("Votes for objects at other depths do not support each other") {
    const ism::Model model = one_word();
    const ism::Frame frame{.gray = ism::GrayImage(400, 400), .camera = camera};
    ism::ThreadPool pool(1);
    ism::Scene scene{.frame = frame, .model = model, .pool = pool};
    // s·d is .5 m for an object at 1 m and for one as large at 1.25 m: three features and one agree on
    // (100, 100), one of each on (300, 100).
    const ism::Feature near{.x = 120, .y = 100, .scale = 4, .depth_m = 0.95f};
    const ism::Feature far{.x = 116, .y = 100, .scale = 3.2f, .depth_m = 1.2f};
    scene.features = {near, near, near, far, near, far};
    scene.features[4].x += 200, scene.features[5].x += 200;
    for (std::uint32_t f = 0; f < 6; ++f) scene.matches.push_back({f, 0, 1});
    const auto found = [&]<class Space>(Space, double t_ratio) {
        const auto votes = ism::cast_votes<Space>(scene, ism::MatchMode::all, {});
        return ism::find_hypotheses<ism::FlatKernel>(scene, votes, ism::default_bandwidth<Space>(),
                                                     {.min_relative_score = t_ratio},
                                                     ism::describe_in<Space>());
    };
    const auto flat = found(ism::Jism{}, 0.3), deep = found(ism::Ji3sm3{}, 0.3);
    REQUIRE(flat.size() == 2);
    CHECK(flat[0].score == Approx(4));
    REQUIRE(deep.size() == 2);
    CHECK(deep[0].score == Approx(3));
    CHECK(deep[0].support.size() == 3);
    CHECK(deep[0].depth_m == Approx(1));
    CHECK(deep[1].score == Approx(1));
    CHECK(found(ism::Jism{}, 0.4).size() == 2);
    CHECK(found(ism::Ji3sm3{}, 0.4).size() == 1);
}

TEST_CASE("Voting confidence is the share of an object's votes in the window") {
    using Vote = ism::Vote<1>;
    const std::vector<Vote> votes{
        {.at = {1.0f}, .weight = 3}, {.at = {2.0f}, .weight = 1}, {.at = {9.0f}, .weight = 4}};
    const std::span<const Vote> all = votes;
    CHECK(ism::share_in_window<1>(all, {1.0}, {1.0}) == 0.5);
    CHECK(ism::share_in_window<1>(all, {1.0}, {0.9}) == 0.375);
    CHECK(ism::share_in_window<1>(all, {5.0}, {1.0}) == 0);
    CHECK(std::isnan(ism::share_in_window<1>(all.first(0), {5.0}, {1.0})));
}

TEST_CASE("The votes of an object's own features for its class count, around its true place") {
    ism::Model model = one_word();
    model.shapes.class_names.push_back("other");
    model.shapes.objects.push_back({.class_index = 1, .width = 200, .height = 200});
    model.shapes.occurrences = {{{.scale = 8, .weight = 0.5f},
                                 {.x = 150, .scale = 8, .weight = 0.25f},
                                 {.scale = 8, .weight = 0.25f, .class_index = 1, .object = 1}},
                                {0, 3}};
    const ism::Frame frame{.gray = ism::GrayImage(200, 200)};
    ism::ThreadPool pool(1);
    ism::Scene scene{.frame = frame, .model = model, .pool = pool};
    // One feature in the middle of the object, one beside it; both vote for it and for a place 150 px left.
    scene.features = {{.x = 100, .y = 100, .scale = 8}, {.x = 180, .y = 100, .scale = 8}};
    scene.matches = {{0, 0, 1}, {1, 0, 1}};
    const ism::TrueObject object{.box = {0, 0, 200, 200}, .mask = {90, 90, ism::Mask(20, 20, 1)}};
    const auto votes = ism::cast_votes<ism::Ism>(scene.features, scene.matches, model.shapes);
    REQUIRE(votes.size() == 6);
    const auto confidence = ism::voting_confidence<ism::Ism>(scene, object, votes);
    CHECK(confidence.at_truth == Approx(2.0 / 3));
    CHECK(confidence.at_hypothesis == Approx(2.0 / 3));
    CHECK(confidence.found);
    // A narrow window away from the truth holds none of them.
    ism::TrueObject elsewhere = object;
    elsewhere.box = {50, 0, 200, 200};
    const auto none = ism::voting_confidence<ism::Ism>(scene, elsewhere, votes, {{10, 10, 0.4}, {}});
    CHECK(none.at_truth == 0);
    // An object without features of its own has no confidence.
    elsewhere.mask = {0, 0, ism::Mask(5, 5, 1)};
    CHECK(std::isnan(ism::voting_confidence<ism::Ism>(scene, elsewhere, votes).at_truth));
}

TEST_CASE("A true place is where a feature in the middle of the object votes") {
    const ism::TrueObject object{
        .box = {50, 60, 100, 100}, .depth_m = 1.2, .centre_m = ism::Point3{0.1, 0.2, 1.2}};
    CHECK(ism::true_place<ism::Ji3sm1>(object, &camera).at == std::array<double, 4>{99.5, 109.5, 0.5, 1.2f});
    CHECK(ism::true_place<ism::Ji3sm3>(object, &camera).at[2] == Approx(0.6));
    CHECK(ism::true_place<ism::Metric>(object, &camera).at[1] == Approx(0.2));
    CHECK(ism::true_place<ism::Metric>(object, &camera).scale == 0.5);
}

TEST_CASE("A training object lies where its label says, else at the median depth of its mask") {
    ism::ThreadPool pool(1);
    const ism::DepthMap depth(200, 200, 1.0f);
    const ism::Surface surface = ism::surface_of(depth, camera, pool);
    const ism::RegionMask mask{90, 90, ism::Mask(21, 21, 1)};
    const ism::Box box{90, 90, 20, 20};
    const ism::TrainingObject seen = ism::with_points({}, box, mask, {}, surface);
    CHECK(seen.centre_m.z == Approx(1));
    CHECK(seen.size_m == Approx(0.04));
    const ism::TrainingObject told = ism::with_points({}, box, mask, ism::Point3{0, 0, 1.1}, surface);
    CHECK(told.centre_m.z == Approx(1.1));
    CHECK(told.size_m == Approx(0.044));
    CHECK(told.points_m.front().z == Approx(-0.1));
}

TEST_CASE("The mirror image of a labelled position is where the mirrored object is seen") {
    ism::TrainingImage image{
        .frame = {.gray = ism::GrayImage(60, 40), .camera = ism::Camera{50, 50, 20, 20}}};
    const ism::Point3 at{0.1, 0.2, 1.0};
    image.objects = {{.box = {20, 25, 10, 10}, .position_m = at}};
    const ism::Point2 before = ism::project(*image.frame.camera, at);
    const ism::TrainingImage other = ism::mirrored(image);
    const ism::Point2 after = ism::project(*other.frame.camera, *other.objects[0].position_m);
    CHECK(after.x == Approx(59 - before.x));
    CHECK(after.y == Approx(before.y));
}
