// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/train/training_surface.hpp"
#include "ism/vote/cast.hpp"
#include "ism/vote/metric.hpp"

namespace {

/// Where a camera is seen from another: what is at x in its frame is at shift + rotate(turn, x).
struct Motion {
    ism::Rotation turn;
    ism::Vec3f shift;
    [[nodiscard]] ism::Vec3f operator()(ism::Vec3f x) const { return shift + rotate(turn, x); }
    [[nodiscard]] ism::LocalFrame operator()(const ism::LocalFrame& f) const {
        return {(*this)(f.point_m), turn * f.rotation};
    }
};

const ism::Camera first_camera{500, 510, 320, 240}, other_camera{800, 790, 400, 310};

ism::Feature feature_at(const ism::LocalFrame& frame, const ism::Camera& camera, double size_m) {
    const ism::Point2 at = project(camera, to_point3(frame.point_m));
    return {.x = float(at.x),
            .y = float(at.y),
            .scale = float(size_m * camera.fx / frame.point_m.z),
            .depth_m = frame.point_m.z};
}

/// A frame on an object around (0.1, -0.05, 0.9), and that object.
ism::LocalFrame random_frame(ism::Random& random) {
    const auto near = [&] { return float(random.uniform(-0.1, 0.1)); };
    return {{0.1f + near(), -0.05f + near(), 0.9f + near()},
            ism::rotation_around({near(), near(), near()}, random.uniform(-3, 3))};
}

ism::TrainingObject object_at(ism::Vec3f centre_m) {
    ism::TrainingObject object{.width = 200, .height = 200, .size_m = 0.2f, .centre_m = centre_m};
    for (const float x : {-0.06f, 0.06f})
        for (const float y : {-0.04f, 0.05f})
            for (const float z : {-0.03f, 0.03f}) object.points_m.push_back({x, y, z});
    return object;
}

/// An axis of one's own: how far the object lies from the camera, whatever the direction.
struct Distance {
    static constexpr std::string_view name = "distance", unit = "m";
    static constexpr double bandwidth = 0.05;
    static constexpr ism::BandwidthScaling bandwidth_scaling = ism::BandwidthScaling::none;
    static constexpr bool needs_depth = true, needs_pose = true;
    [[nodiscard]] static double vote(const ism::VoteSource& v) { return length(v.pose.centre_m); }
};

}  // namespace

TEST_CASE("the pose of a rigidly moved object is its motion, whatever the camera") {
    ism::Random random(5);
    const ism::TrainingObject object = object_at({0.1f, -0.05f, 0.9f});
    for (int trial = 0; trial < 50; ++trial) {
        const ism::LocalFrame seen = random_frame(random);
        const ism::Feature there = feature_at(seen, first_camera, 0.008);
        const auto known = occurrence_frame(there, seen, object, first_camera);
        CHECK(known.scale_m == Approx(0.008));
        const ism::Pose same = pose(seen, known);
        CHECK(length(same.centre_m - object.centre_m) < 1e-6f);
        CHECK(std::abs(same.rotation.w) == Approx(1).margin(1e-6));

        const Motion motion{
            ism::rotation_around({float(random.normal()), float(random.normal()), 1}, random.uniform(-3, 3)),
            {0.2f, 0.1f, 2}};
        const ism::Pose moved = pose(motion(seen), known);
        CHECK(length(moved.centre_m - motion(object.centre_m)) < 1e-5f);
        for (const ism::Vec3f& point : object.points_m)
            CHECK(length(moved.centre_m + rotate(moved.rotation, point) - motion(object.centre_m + point)) <
                  1e-5f);

        const ism::Feature again = feature_at(motion(seen), other_camera, 0.008);
        const auto placed = posed(again, motion(seen), known, other_camera, 1.01);
        REQUIRE(placed);
        CHECK(placed->centre_m == moved.centre_m);
        const ism::Placement in_image = placement(*placed, object, other_camera);
        CHECK(in_image.centre == project(other_camera, to_point3(moved.centre_m)));
        CHECK(in_image.scale == Approx(0.2 * other_camera.fx / moved.centre_m.z / 200));
    }
}

TEST_CASE("the box of a pose is that of the projected points") {
    const ism::TrainingObject object = object_at({});
    const ism::Pose straight{{0, 0, 1}, {}};
    // The near side, 0.97 m away, is seen larger.
    const double near = 500 / 0.97, near_y = 510 / 0.97;
    const ism::Box box = posed_box(straight, object.points_m, first_camera);
    CHECK(box.x == Approx(320 - 0.06 * near));
    CHECK(box.y == Approx(240 - 0.04 * near_y));
    CHECK(box.width == Approx(0.12 * near + 1));  // both outermost pixels are part of it
    CHECK(box.height == Approx(0.09 * near_y + 1));

    const ism::Pose turned{{0, 0, 1}, ism::rotation_around({0, 0, 1}, std::acos(0.0))};
    const ism::Box upright = posed_box(turned, object.points_m, first_camera);
    CHECK(upright.width == Approx(0.09 * near + 1).epsilon(1e-5));
    CHECK(upright.height == Approx(0.12 * near_y + 1).epsilon(1e-5));

    // What is behind the camera is not seen.
    const ism::Box half = posed_box({{0, 0, 0.04f}, {}}, object.points_m, first_camera);
    CHECK(half.width == Approx(0.12 * 500 / 0.07 + 1).epsilon(1e-5));
    CHECK(posed_box({{0, 0, -1}, {}}, object.points_m, first_camera) == ism::Box{});
    CHECK(posed_box(straight, {}, first_camera) == ism::Box{});
}

TEST_CASE("a feature of another size, or without a frame, does not place an object") {
    ism::Random random(6);
    const ism::TrainingObject object = object_at({0.1f, -0.05f, 0.9f});
    const ism::LocalFrame seen = random_frame(random);
    const auto known = occurrence_frame(feature_at(seen, first_camera, 0.01), seen, object, first_camera);
    const auto places = [&](double size_m, double max_ratio) {
        return posed(feature_at(seen, first_camera, size_m), seen, known, first_camera, max_ratio)
            .has_value();
    };
    CHECK(places(0.0149, 1.5));
    CHECK_FALSE(places(0.0151, 1.5));
    CHECK(places(0.0067, 1.5));
    CHECK_FALSE(places(0.0066, 1.5));
    CHECK(places(0.0151, 2));
    const ism::Feature there = feature_at(seen, first_camera, 0.01);
    CHECK_FALSE(posed(there, std::nullopt, known, first_camera, 1.5));
    CHECK_FALSE(posed(there, seen, ism::OccurrenceFrame{}, first_camera, 1.5));  // none is known
    auto behind = known;
    behind.offset_m = rotate(inverse(seen.rotation), {0, 0, -2});
    CHECK_FALSE(posed(there, seen, behind, first_camera, 1.5));
    auto nan = there;
    nan.scale = ism::no_depth;
    CHECK_FALSE(posed(nan, seen, known, first_camera, 1.5));
}

TEST_CASE("votes in metres agree on the centre, also in a space with an axis of one's own") {
    static_assert(ism::Metric::needs_pose && ism::Metric::needs_depth && ism::Metric::dimension == 3);
    static_assert(!ism::Jism::needs_pose && !ism::Ji3sm1::needs_pose && ism::Ji3sm1::needs_depth);
    using Own = ism::VoteSpace<ism::MetricX, ism::MetricY, ism::MetricZ, Distance, ism::Class>;
    using Mixed = ism::VoteSpace<ism::X, ism::Y, Distance>;
    static_assert(Own::needs_pose && Own::dimension == 4 && Own::has_label && Mixed::needs_pose);

    ism::Random random(7);
    const Motion motion{ism::rotation_around({1, 2, 3}, 0.4), {0.1f, 0, 0.6f}};
    ism::ShapeModel shapes{.class_names = {"a", "b"}};
    shapes.objects = {object_at({0.1f, -0.05f, 0.9f})};
    shapes.objects[0].class_index = 1;
    std::vector<ism::Feature> features;
    std::vector<std::optional<ism::LocalFrame>> frames;
    std::vector<ism::Match> matches;
    for (std::uint32_t i = 0; i < 9; ++i) {
        const ism::LocalFrame seen = random_frame(random);
        const ism::Occurrence one{.class_index = 1, .feature = i};
        shapes.occurrences.push_back(std::vector{one});
        shapes.frames.push_back(
            occurrence_frame(feature_at(seen, first_camera, 0.01), seen, shapes.objects[0], first_camera));
        frames.emplace_back(motion(seen));
        features.push_back(feature_at(*frames[i], other_camera, 0.01));
        matches.push_back({i, i, 0.5f + float(i)});
    }
    frames[3] = std::nullopt;
    features[4].depth_m = ism::no_depth;
    features[5].scale *= 1.6f;
    const ism::Vec3f truth = motion(shapes.objects[0].centre_m);
    const auto votes = ism::cast_votes<ism::Metric>(features, matches, shapes, &other_camera, {}, frames);
    REQUIRE(votes.size() == 6);
    for (const auto& vote : votes) {
        CHECK(length(ism::Vec3f{vote.at[0], vote.at[1], vote.at[2]} - truth) < 1e-5f);
        CHECK(vote.scale == Approx(0.2 * other_camera.fx / truth.z / 200).epsilon(1e-4));
        CHECK(vote.weight == 0.5f + float(vote.feature));
        CHECK(vote.label == 1);
    }
    CHECK(
        ism::cast_votes<ism::Metric>(features, matches, shapes, &other_camera, {.max_size_ratio = 2}, frames)
            .size() == 7);
    CHECK(ism::cast_votes<ism::Metric>(features, matches, shapes, &other_camera, {.max_scale = 0.1}, frames)
              .empty());
    const auto own = ism::cast_votes<Own>(features, matches, shapes, &other_camera, {}, frames);
    REQUIRE(own.size() == 6);
    for (const auto& vote : own) CHECK(vote.at[3] == Approx(length(truth)).epsilon(1e-5));
    const ism::Point2 centre = project(other_camera, to_point3(truth));
    const auto mixed = ism::cast_votes<Mixed>(features, matches, shapes, &other_camera, {}, frames);
    REQUIRE(mixed.size() == 6);
    CHECK(mixed[0].at[0] == Approx(centre.x).epsilon(1e-4));
    CHECK(mixed[0].at[2] == Approx(length(truth)).epsilon(1e-5));
}

TEST_CASE("a space with poses asks for a camera, local frames and a model that knows them") {
    ism::ShapeModel shapes{.class_names = {"a"}, .objects = {object_at({0, 0, 1})}};
    shapes.occurrences.push_back(std::vector<ism::Occurrence>{{}});
    const std::vector<ism::Feature> features{{.x = 1, .y = 1, .depth_m = 1}};
    const std::vector<ism::Match> matches{{0, 0, 1}};
    const std::vector<std::optional<ism::LocalFrame>> frames(1);
    const auto cast = [&](const ism::Camera* camera, bool with_frames) {
        return ism::cast_votes<ism::Metric>(features, matches, shapes, camera, {},
                                            with_frames ? frames : decltype(frames)());
    };
    CHECK_THROWS_WITH(cast(&first_camera, true), Catch::Contains("learn_metric"));
    shapes.frames.resize(1);
    CHECK_THROWS_WITH(cast(nullptr, true), Catch::Contains("camera"));
    CHECK_THROWS_WITH(cast(&first_camera, false), Catch::Contains("local frames"));
    CHECK(cast(&first_camera, true).empty());
    CHECK(ism::cast_votes<ism::Jism>(features, matches, shapes).size() == 1);
}
