// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "support/catch.hpp"
#include "support/depth_scene.hpp"

#include "ism/depth/convex_segments.hpp"

namespace {

using depth_scene::Ball;
using depth_scene::Plane;
using depth_scene::Table;

ism::DepthSegments segments_of(const depth_scene::Picture& picture, const ism::SegmentOptions& options = {},
                               unsigned threads = 1) {
    ism::ThreadPool pool(threads);
    return depth_segments(surface_of(picture.depth_m, depth_scene::camera, pool), options, pool);
}

double best_iou(const std::vector<ism::RegionMask>& segments, const ism::RegionMask& truth) {
    double best = 0;
    for (const ism::RegionMask& segment : segments) best = std::max(best, iou(segment, truth));
    return best;
}

/// Two blocks on a table that meet at an angle, a ball before them.
depth_scene::Picture corner_scene() {
    const Table table;
    return depth_scene::noisy(depth_scene::render(
        {table.plane(), table.block(-0.1f, 0.05f, {0.2f, 0.08f, 0.15f}, 0.6),
         table.block(0.1f, 0.05f, {0.2f, 0.08f, 0.09f}, -0.6), Ball{table.at(0.05f, -0.2f, 0.06f), 0.06f}}));
}

}  // namespace

TEST_CASE("supervoxels cover the surface and tell their pixels") {
    const auto picture = corner_scene();
    ism::ThreadPool pool(1);
    const ism::Surface surface = surface_of(picture.depth_m, depth_scene::camera, pool);
    const ism::Supervoxels supervoxels = supervoxels_of(surface, {}, pool);
    REQUIRE(supervoxels.all.size() > 200);
    const std::size_t count = supervoxels.all.size();
    std::vector<int> pixels(count);
    std::vector<std::array<int, 4>> of_shape(count);
    int unlabelled = 0, points = 0;
    for (int y = 0; y < surface.height(); ++y)
        for (int x = 0; x < surface.width(); ++x) {
            const auto label = std::size_t(supervoxels.labels(x, y));
            points += surface.has_point(x, y);
            if (label == 0) {
                unlabelled += surface.has_point(x, y);
                continue;
            }
            REQUIRE(surface.has_point(x, y));
            REQUIRE(intersection(supervoxels.all.at(label - 1).box, {double(x), double(y), 1, 1}).area() ==
                    1);
            ++pixels[label - 1];
            for (std::size_t shape = 0; shape < 4; ++shape)
                of_shape[label - 1][shape] += contains(picture.regions[shape], x, y);
        }
    CHECK(unlabelled < points / 100);
    int mixed = 0;
    for (std::size_t i = 0; i < count; ++i)
        mixed += pixels[i] - *std::max_element(of_shape[i].begin(), of_shape[i].end());
    CHECK(mixed < points / 100);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        CHECK(supervoxels.all[i].pixels == pixels[i]);
        CHECK(length(supervoxels.all[i].normal) == Approx(1).margin(1e-4));
    }
}

TEST_CASE("borders of supervoxels are counted to the last row and column") {
    ism::Surface surface{.camera = depth_scene::camera,
                         .points_m = ism::Image<ism::Vec3f>(6, 4, {0, 0, 1}),
                         .normals = ism::Image<ism::Vec3f>(6, 4, {0, 0, -1})};
    ism::Supervoxels pieces{.labels = ism::Image<std::int32_t>(6, 4), .all = std::vector<ism::Supervoxel>(2)};
    const auto border_px = [&](const auto& label, int least) {
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 6; ++x) pieces.labels(x, y) = label(x, y);
        const auto edges = ism::detail::supervoxel_edges(surface, pieces, least);
        REQUIRE(edges.size() <= 1);
        return edges.empty() ? 0 : int(edges[0].border_px);
    };
    const auto sides = [](int x, int) { return x < 3 ? 1 : 2; };
    const auto halves = [](int, int y) { return y < 2 ? 1 : 2; };
    CHECK(border_px(sides, 1) == 4);
    CHECK(border_px(sides, 4) == 4);
    CHECK(border_px(sides, 5) == 0);
    CHECK(border_px(halves, 6) == 6);
    CHECK(border_px(halves, 7) == 0);
    surface.points_m(3, 0).z = 2;  // a step in depth is no border
    CHECK(border_px(sides, 1) == 3);
}

TEST_CASE("pieces meet convexly, concavely or in one plane") {
    const float s = std::sqrt(0.5f);
    const auto meet = [](ism::Vec3f a, ism::Vec3f b) {  // pieces to the left and right, seen from z = 0
        return ism::detail::is_convex({.point_m = {-1, 0, 5}, .normal = a, .box = {}},
                                      {.point_m = {1, 0, 5}, .normal = b, .box = {}}, 0.1f, 0.95f);
    };
    CHECK(meet({-s, 0, -s}, {s, 0, -s}));        // a ridge towards the camera
    CHECK_FALSE(meet({s, 0, -s}, {-s, 0, -s}));  // a valley
    CHECK(meet({0, 0, -1}, {0, 0, -1}));
    CHECK(meet({0.15f, 0, -0.9887f}, {-0.15f, 0, -0.9887f}));  // a valley, but about parallel
    CHECK_FALSE(meet({0.3f, 0, -0.954f}, {-0.3f, 0, -0.954f}));
}

TEST_CASE("objects on a table are segments, cut where they meet at a concave edge") {
    const auto picture = corner_scene();
    const auto found = segments_of(picture, {.max_share = 1});
    for (const ism::RegionMask& truth : picture.regions) CHECK(best_iou(found.segments, truth) > 0.85);
    ism::Mask both = full_mask(picture.regions[1], depth_scene::width, depth_scene::height);
    const ism::Mask other = full_mask(picture.regions[2], depth_scene::width, depth_scene::height);
    for (std::size_t i = 0; i < both.pixels().size(); ++i) both.pixels()[i] |= other.pixels()[i];
    for (const ism::RegionMask& s : found.segments) CHECK(area_of(s) == mask_area(s.mask));
    const auto careful = segments_of(picture, {.levels = {{12, 10, true}}}).segments;
    for (std::size_t shape = 1; shape < 4; ++shape) CHECK(best_iou(careful, picture.regions[shape]) > 0.85);
    CHECK(best_iou(careful, ism::region_of(both)) < 0.8);
    CHECK(found.segments.size() < 20);
}

TEST_CASE("a block in a room and a ball against its wall are segments") {
    const Table table;
    const Plane wall{{0, 0, -1}, -1.35f};
    const auto picture =
        noisy(depth_scene::render({table.plane(), wall, table.block(-0.12f, 0, {0.12f, 0.12f, 0.2f}, 0.3),
                                   Ball{{0.25f, -0.2f, 1.27f}, 0.09f}}));
    const auto found = segments_of(picture);
    CHECK(best_iou(found.segments, picture.regions[2]) > 0.85);
    CHECK(best_iou(found.segments, picture.regions[3]) > 0.85);
    for (const ism::RegionMask& s : found.segments) CHECK(double(area_of(s)) <= 640 * 480 * 0.95);
}

TEST_CASE("segments do not depend on the number of threads") {
    const auto picture = corner_scene();
    const auto one = segments_of(picture), three = segments_of(picture, {}, 3);
    CHECK(one.fine.labels == three.fine.labels);
    CHECK(one.segments == three.segments);
}

TEST_CASE("segment options drop small, large and repeated segments") {
    const auto picture = corner_scene();
    const auto all = segments_of(picture, {.min_share = 0, .max_share = 1, .max_iou = 1}).segments;
    const auto some = segments_of(picture, {.min_share = 0.02, .max_share = 0.1, .max_iou = 1}).segments;
    std::vector<ism::RegionMask> expected;
    for (const ism::RegionMask& s : all)
        if (const double share = double(area_of(s)) / (640 * 480); share >= 0.02 && share <= 0.1)
            expected.push_back(s);
    REQUIRE(!expected.empty());
    REQUIRE(expected.size() < all.size());
    CHECK(some == ism::without_duplicates(expected, 1));

    const auto kept = ism::without_duplicates(all, 0.6);
    REQUIRE(kept.size() < all.size());
    for (std::size_t i = 0; i < kept.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) CHECK(iou(kept[i], kept[j]) <= 0.6);
    for (const ism::RegionMask& s : all) CHECK((best_iou(kept, s) > 0.6));

    CHECK(segments_of(picture, {.levels = {}}).segments.empty());
    CHECK_THROWS_AS(check(ism::SegmentOptions{.min_border_px = 0}), ism::Error);
    CHECK_THROWS_AS(check(ism::SegmentOptions{.max_iou = 1.5}), ism::Error);
    CHECK_THROWS_AS(check(ism::SegmentOptions{.levels = {{1, 10, false}}}), ism::Error);
    CHECK_THROWS_AS(check(ism::SegmentOptions{.levels = {{12, 91, false}}}), ism::Error);
    CHECK_THROWS_AS(check(ism::SupervoxelOptions{.size_m = 0}), ism::Error);
    CHECK_THROWS_AS(check(ism::SupervoxelOptions{.passes = 0}), ism::Error);
}

TEST_CASE("an image without depth has no segments") {
    ism::ThreadPool pool(1);
    const auto found = depth_segments(surface_of(ism::DepthMap(64, 48), depth_scene::camera, pool), {}, pool);
    CHECK(found.fine.all.empty());
    CHECK(found.segments.empty());
}
