// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "support/catch.hpp"
#include "support/metric_scene.hpp"

#include "ism/detect/mask_candidates.hpp"
#include "ism/detect/surface_scene.hpp"
#include "ism/train/learn_metric.hpp"

namespace {

using ism::Point2;
using metric_scene::Thing;
using metric_scene::View;

std::vector<Point2> hull_of(std::vector<Point2> points) {
    return ism::detail::convex_hull(std::move(points));
}

/// Row after row, '#' where a pixel is visited.
std::string filled(const std::vector<Point2>& hull, int width, int height) {
    std::string picture(std::size_t(width) * std::size_t(height), '.');
    ism::detail::each_row_in(hull, width, height, [&](int y, int x0, int x1) {
        for (int x = x0; x <= x1; ++x) {
            char& pixel = picture.at(std::size_t(y * width + x));
            pixel = pixel == '.' ? '#' : '!';  // visited twice
        }
    });
    return picture;
}

/// A hypothesis on the true votes of a view's first `features`, strongest first.
ism::Detection true_votes(const ism::Scene& scene, std::size_t features) {
    ism::Detection hypothesis;
    for (const ism::Match& match : scene.matches)
        if (match.nearest && match.feature < features && !scene.model.shapes.occurrences[match.word].empty())
            hypothesis.support.push_back(
                {match.feature, match.word, scene.model.shapes.occurrences.first(match.word), match.weight});
    return hypothesis;
}

}  // namespace

TEST_CASE("the hull of points is the corners of the polygon around them") {
    CHECK(hull_of({{0, 0}, {4, 0}, {4, 3}, {0, 3}, {2, 1}, {4, 1}, {2, 0}, {0, 0}}) ==
          std::vector<Point2>{{0, 0}, {4, 0}, {4, 3}, {0, 3}});
    CHECK(hull_of({{3, 3}, {0, 0}, {1, 1}, {2, 2}}) == std::vector<Point2>{{0, 0}, {3, 3}});
    CHECK(hull_of({}).empty());
    CHECK(hull_of({{2, 5}}) == std::vector<Point2>{{2, 5}});
    CHECK(filled(hull_of({{1, 1}, {1, 1}, {1, 1}}), 3, 3) == "....#....");
}

TEST_CASE("a polygon is filled where it holds the centres of pixels, each once") {
    CHECK(filled({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, 4, 3) ==
          "###."
          "###."
          "....");
    CHECK(filled({{0.5, 0.5}, {2.5, 0.5}, {1.5, 2.5}}, 4, 4) ==
          "...."
          ".##."
          "...."
          "....");
    CHECK(filled({{-5, -5}, {9, -5}, {9, 9}, {-5, 9}}, 2, 2) == "####");
    CHECK(filled({{1, 0}, {5, 0}, {5, 5}}, 3, 3) ==
          ".##"
          "..#"
          "...");
    // Lines and single points hold those that they meet.
    CHECK(filled({{0, 1}, {2, 1}}, 3, 3) == "...###...");
    CHECK(filled({{0, 0}, {2, 2}}, 3, 3) == "#...#...#");
    CHECK(filled({{1, 2}}, 3, 3) == ".......#.");
    CHECK(filled({{1.5, 2}}, 3, 3) == ".........");
    // Nothing within.
    CHECK(filled({}, 2, 2) == "....");
    for (const auto& [x, y] : {std::pair(-9.0, 0.0), {9.0, 0.0}, {0.0, -9.0}, {0.0, 9.0}})
        CHECK(filled({{x, y}, {x + 2, y}, {x + 2, y + 2}, {x, y + 2}}, 2, 2) == "....");
    CHECK(filled({{1e12, -1e12}, {2e12, 1e12}, {1e12, 1e12}}, 2, 2) == "....");
}

TEST_CASE("the mask of votes covers the object that they are of") {
    const ism::TrainingFeatures lessons = metric_scene::lessons(metric_scene::training_views());
    const ism::Model model = ism::learn_metric(lessons);
    ism::ThreadPool pool(1);
    const View view = metric_scene::seen(
        {{0, {-0.08f, 0.05f, 0.8f}, ism::rotation_around({0, 0, 1}, 1)}, {1, {0.2f, 0, 0.9f}}}, 31);
    ism::Scene scene = metric_scene::scene_of(view, model, pool);
    add_surface(scene);
    const ism::Detection hypothesis = true_votes(scene, 30);
    REQUIRE(hypothesis.support.size() == 30);
    const ism::MaskCandidateOptions options;
    const auto found = depth_segments(*scene.surface, options.segments, pool);
    const ism::RegionMask mask = vote_mask(hypothesis, found.fine, scene);
    CHECK(iou(mask, view.masks[0]) > 0.8);
    CHECK(region_of(full_mask(mask, metric_scene::width, metric_scene::height)) == mask);  // tight

    CHECK(vote_mask({}, found.fine, scene) == ism::RegionMask{});
    ism::Model pointless = model;
    for (ism::TrainingObject& object : pointless.shapes.objects) object.points_m.resize(2);
    ism::Scene without = metric_scene::scene_of(view, pointless, pool);
    add_surface(without);
    CHECK(vote_mask(hypothesis, found.fine, without) == ism::RegionMask{});

    SECTION("candidates are segments, and masks of votes that are not like one of them") {
        const std::vector<ism::Detection> same(3, hypothesis);
        const auto candidates = mask_candidates(scene, same, options);
        CHECK(candidates.size() == found.segments.size());  // the block is a segment already
        auto no_segments = options;
        no_segments.segments.levels.clear();
        CHECK(mask_candidates(scene, same, no_segments) == std::vector<ism::RegionMask>{mask});
        no_segments.max_vote_masks = 0;
        CHECK(mask_candidates(scene, same, no_segments).empty());
        no_segments.max_vote_masks = 60;
        no_segments.segments.min_share = 0.5;
        CHECK(mask_candidates(scene, same, no_segments).empty());
        for (std::size_t i = 0; i < candidates.size(); ++i)
            for (std::size_t k = 0; k < i; ++k)
                CHECK(iou(candidates[i], candidates[k]) <= options.segments.max_iou);
    }
}
