// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
//
// Identities and positions over frames.
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/detect/track.hpp"

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

ism::Detection seen(std::uint32_t class_index, ism::Point3 at_m, double error_m = 0.01) {
    ism::Detection detection;
    detection.class_index = class_index, detection.probability = 0.8;
    detection.box = {100 * at_m.x, 100 * at_m.y, 20, 20};
    detection.position_m = at_m, detection.position_error_m = error_m;
    return detection;
}

using Frames = std::vector<ism::Detection>;

}  // namespace

TEST_CASE("an object is told once it was found often enough, and forgotten after it was missed too often") {
    ism::Tracker tracker({.birth_hits = 3, .max_misses = 2});
    const Frames one = {seen(0, {0, 0, 1})}, none;
    CHECK(tracker.update(one).empty());
    CHECK(tracker.update(one).empty());
    auto tracks = tracker.update(one);
    REQUIRE(tracks.size() == 1);
    CHECK(tracks[0].id == 1);
    CHECK(tracks[0].hits == 3);
    CHECK(tracks[0].detection == 0);
    CHECK(tracks[0].probability == Approx(0.8));

    tracks = tracker.update(none);  // a missed frame
    REQUIRE(tracks.size() == 1);
    CHECK_FALSE(tracks[0].detection.has_value());
    CHECK(tracks[0].misses == 1);
    tracks = tracker.update(one);
    REQUIRE(tracks.size() == 1);
    CHECK(tracks[0].id == 1);
    CHECK(tracks[0].misses == 0);

    CHECK(tracker.update(none).size() == 1);
    CHECK(tracker.update(none).size() == 1);
    CHECK(tracker.update(none).empty());
    for (int i = 0; i < 2; ++i) CHECK(tracker.update(one).empty());
    CHECK(tracker.update(one).at(0).id == 2);  // no id comes twice
}

TEST_CASE("what is seen once is never told") {
    ism::Tracker tracker({.birth_hits = 2});
    const Frames real = {seen(0, {0, 0, 1})}, with_false = {seen(0, {0, 0, 1}), seen(0, {0.5, 0, 1})};
    for (int i = 0; i < 12; ++i) CHECK(tracker.update(i % 3 == 2 ? with_false : real).size() <= 1);
}

TEST_CASE("objects that cross keep their identities") {
    for (const std::uint32_t other : {0u, 1u}) {  // at a distance, or of different classes at one place
        ism::Tracker tracker({.max_distance_m = 0.1, .birth_hits = 1, .drift_m = 0.05});
        const double behind = other == 0 ? 0.15 : 0;
        for (int i = 0; i <= 20; ++i) {
            const double x = 0.02 * (i - 10);
            Frames frame = {seen(0, {x, 0, 1}), seen(other, {-x, 0, 1 + behind})};
            if (i % 2 == 1) std::swap(frame[0], frame[1]);
            const auto tracks = tracker.update(frame);
            REQUIRE(tracks.size() == 2);
            CHECK(tracks[0].detection == (i % 2 == 1 ? 1 : 0));
            CHECK(tracks[1].detection == (i % 2 == 1 ? 0 : 1));
            CHECK(tracks[0].class_index == 0);
            CHECK(tracks[1].class_index == other);
        }
    }
}

TEST_CASE("the nearest pair comes together first, whatever the order") {
    ism::Tracker tracker({.max_distance_m = 0.1, .birth_hits = 1});
    CHECK(tracker.update(Frames{seen(0, {0, 0, 1}), seen(0, {0.06, 0, 1})}).size() == 2);
    const auto tracks = tracker.update(Frames{seen(0, {0.055, 0, 1})});
    REQUIRE(tracks.size() == 2);
    CHECK_FALSE(tracks[0].detection.has_value());
    CHECK(tracks[1].detection == 0);
}

TEST_CASE("a smoothed position scatters less, and about as much as its standard error says") {
    ism::Tracker tracker({.birth_hits = 1, .drift_m = 0.001});
    ism::Random random(5);
    const ism::Point3 truth{0.1, -0.2, 0.9};
    const double axis_m = 0.01;
    double raw = 0, smoothed = 0, told = 0;
    for (int i = 0; i < 400; ++i) {
        const ism::Point3 p{truth.x + axis_m * random.normal(), truth.y + axis_m * random.normal(),
                            truth.z + axis_m * random.normal()};
        const auto tracks = tracker.update(Frames{seen(2, p, std::sqrt(3.0) * axis_m)});
        REQUIRE(tracks.size() == 1);
        REQUIRE(tracks[0].id == 1);
        if (i < 50) continue;
        const ism::Point3& q = *tracks[0].position_m;
        const auto off = [&](const ism::Point3& a) {
            return std::pow(a.x - truth.x, 2) + std::pow(a.y - truth.y, 2) + std::pow(a.z - truth.z, 2);
        };
        raw += off(p), smoothed += off(q), told += std::pow(tracks[0].position_error_m, 2);
    }
    CHECK(smoothed < 0.1 * raw);
    CHECK(smoothed < 1.5 * told);
    CHECK(smoothed > 0.3 * told);
}

TEST_CASE("a sure position counts more than an unsure one, and one that tells no error least") {
    const auto moved = [](double error_m) {
        ism::Tracker tracker({.birth_hits = 1});
        (void)tracker.update(Frames{seen(0, {0, 0, 1}, 0.01)});
        return tracker.update(Frames{seen(0, {0.05, 0, 1}, error_m)}).at(0).position_m->x;
    };
    CHECK(moved(0.005) > moved(0.02));
    CHECK(moved(0.02) > moved(unknown));
    CHECK(moved(unknown) > 0);
    CHECK(moved(0) == moved(0.003));  // TrackerOptions::least_error_m
    CHECK(moved(0) < 0.05);
}

TEST_CASE("without positions, and with NaN as one, boxes tell what is the same") {
    for (const bool nan : {false, true}) {
        const auto at = [&](double x) {
            ism::Detection detection = seen(0, {x, 0, 1});
            if (nan)
                detection.position_m->y = unknown;
            else
                detection.position_m.reset();
            return detection;
        };
        ism::Tracker tracker({.min_iou = 0.3, .birth_hits = 1});
        CHECK(tracker.update(Frames{at(0)}).size() == 1);
        auto tracks = tracker.update(Frames{at(0.05)});  // by 5 of 20 px
        REQUIRE(tracks.size() == 1);
        CHECK_FALSE(tracks[0].position_m.has_value());
        tracks = tracker.update(Frames{at(0.25)});  // beside it
        CHECK(tracks.size() == 2);
        tracks = tracker.update(Frames{seen(0, {0.05, 0, 1}), at(0.25)});
        REQUIRE(tracks.size() == 2);
        CHECK(tracks[0].position_m.has_value());
        CHECK(tracks[0].hits == 3);
        tracks = tracker.update(Frames{at(0.05), at(0.25)});  // the position stays
        CHECK(tracks.at(0).position_m == ism::Point3{0.05, 0, 1});
    }
}

TEST_CASE("a position that is not measured any more is forgotten, and the object found by its box") {
    ism::Tracker tracker({.birth_hits = 1, .max_misses = 3});
    for (int i = 0; i < 5; ++i) (void)tracker.update(Frames{seen(0, {0, 0, 1})});
    std::vector<ism::Track> tracks;
    for (int i = 1; i <= 40; ++i) {  // depth is lost, and the object moves on by a twentieth of its box
        ism::Detection moved = seen(0, {0.01 * i, 0, 1});
        moved.position_m.reset();
        tracks = tracker.update(Frames{moved});
        REQUIRE(tracks.size() == 1);
        CHECK(tracks[0].unplaced == std::size_t(i));
        CHECK(tracks[0].position_m.has_value() == (i <= 3));
        if (i > 3) CHECK(tracks[0].position_error_m == 0);
    }
    tracks = tracker.update(Frames{seen(0, {0.41, 0, 1})});  // and is there again
    REQUIRE(tracks.size() == 1);
    CHECK(tracks[0].id == 1);
    CHECK(tracks[0].unplaced == 0);
    CHECK(tracks[0].position_m == ism::Point3{0.41, 0, 1});
}

TEST_CASE("options of the tracker that cannot be are refused") {
    const auto refused = [](const ism::TrackerOptions& options, const std::string& field) {
        CHECK_THROWS_WITH(ism::Tracker(options), Catch::Contains(field));
    };
    refused({.max_distance_m = 0}, "max_distance_m");
    refused({.min_iou = 1}, "min_iou");
    refused({.birth_hits = 0}, "birth_hits");
    refused({.drift_m = unknown}, "drift_m");
    refused({.least_error_m = -1}, "least_error_m");
    refused({.unknown_error_m = 1e9}, "unknown_error_m");
}
