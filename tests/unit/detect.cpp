// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/random.hpp"
#include "ism/detect/segment.hpp"
#include "ism/detect/verify.hpp"

namespace {

/// A picture-sized rectangle as a hypothesis whose mask is its whole box.
ism::Detection block(int x, int y, int width, int height, double score, float certainty = 1) {
    ism::Detection result;
    result.score = score;
    result.box = {double(x), double(y), double(width), double(height)};
    result.centre = result.box.centre();
    result.segmentation = {.x = x,
                           .y = y,
                           .figure = ism::GrayImage(width, height, certainty),
                           .ground = ism::GrayImage(width, height, 1 - certainty),
                           .mask = ism::Mask(width, height, 1)};
    return result;
}

}  // namespace

TEST_CASE("segmentation lays mask patches over the features that voted") {
    // One training object of 200 × 200 px whose left half is figure.
    ism::Model model;
    ism::ShapeModel& shapes = model.shapes;
    shapes.class_names = {"half"};
    shapes.objects = {
        {.class_index = 0, .width = 200, .height = 200, .mask = ism::Mask(100, 100), .image = ""}};
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 50; ++x) shapes.objects[0].mask(x, y) = 255;
    // A feature in its very centre, found half as large at (80, 60): the object is 100 px there.
    shapes.occurrences.push_back(std::vector<ism::Occurrence>{{.x = 0, .y = 0, .scale = 8, .weight = 1}});
    ism::Detection hypothesis;
    hypothesis.support = {{.feature = 0, .word = 0, .occurrence = 0, .weight = 0.3f}};
    hypothesis.box = ism::box_around({80, 60}, 100, 100);
    const ism::Frame frame{.gray = ism::GrayImage(200, 200)};
    ism::ThreadPool pool(1);
    ism::Scene scene{.frame = frame, .model = model, .pool = pool};
    scene.features = {{.x = 80, .y = 60, .scale = 4}};
    const ism::PatchSegmenter segmenter{.patch_radius = 5};  // patch: ± 20 px
    const auto part = segmenter.segment(hypothesis, scene);

    const auto figure = [&](int x, int y) { return part.figure(x - part.x, y - part.y); };
    const auto ground = [&](int x, int y) { return part.ground(x - part.x, y - part.y); };
    CHECK(figure(70, 60) == Approx(1));
    CHECK(ground(70, 60) == Approx(0).margin(1e-6));
    CHECK(figure(90, 60) == Approx(0).margin(1e-6));
    CHECK(ground(90, 60) == Approx(1));
    CHECK(figure(50, 60) == 0);  // beyond the patch nothing is known
    CHECK(ground(50, 60) == 0);
    const ism::Mask whole = ism::whole_mask(part, 200, 200);
    const ism::Box found = ism::mask_box(whole);
    CHECK(found.x == Approx(60).margin(1));
    CHECK(found.x + found.width == Approx(80).margin(1));
    CHECK(found.height == Approx(40).margin(1));
    CHECK(ism::mask_area(whole) == Approx(20 * 40).epsilon(0.1));

    // The same feature, turned by a quarter: the left half is above now.
    scene.features[0].angle = std::numbers::pi_v<float> / 2;
    const auto turned = segmenter.segment(hypothesis, scene);
    CHECK(turned.figure(80 - turned.x, 50 - turned.y) == Approx(1));
    CHECK(turned.ground(80 - turned.x, 70 - turned.y) == Approx(1));
}

TEST_CASE("figure and ground are weighted means of the patches") {
    ism::Model model;
    ism::ShapeModel& shapes = model.shapes;
    shapes.class_names = {"a"};
    shapes.objects = {
        {.class_index = 0, .width = 200, .height = 200, .mask = ism::Mask(4, 4, 255), .image = ""},
        {.class_index = 0, .width = 200, .height = 200, .mask = ism::Mask(4, 4, 0), .image = ""}};
    shapes.occurrences.push_back(std::vector<ism::Occurrence>{{.scale = 5, .object = 0, .feature = 0},
                                                              {.scale = 5, .object = 1, .feature = 1}});
    // The first occurrence is reached through two words: their weights add up to 3 of 4.
    ism::Detection hypothesis;
    hypothesis.support = {{0, 0, 0, 1.0f}, {0, 0, 1, 1.0f}, {0, 1, 0, 2.0f}};
    hypothesis.box = ism::box_around({100, 100}, 100, 100);
    const ism::Frame frame{.gray = ism::GrayImage(200, 200)};
    ism::ThreadPool pool(1);
    ism::Scene scene{.frame = frame, .model = model, .pool = pool};
    scene.features = {{.x = 100, .y = 100, .scale = 5}};
    const auto part = ism::PatchSegmenter{}.segment(hypothesis, scene);
    CHECK(part.figure(100 - part.x, 100 - part.y) == Approx(0.75));
    CHECK(part.ground(100 - part.x, 100 - part.y) == Approx(0.25));
}

TEST_CASE("non-maximum suppression keeps the strongest of those that overlap") {
    std::vector<ism::Detection> hypotheses{block(0, 0, 20, 20, 1), block(2, 2, 20, 20, 3),
                                           block(50, 0, 20, 20, 2)};
    const auto kept = ism::NonMaximumSuppression{.max_iou = 0.5}.verify(hypotheses);
    REQUIRE(kept.size() == 2);
    CHECK(kept[0].index == 1);
    CHECK(kept[1].index == 2);
    CHECK(kept[1].score == 2);
    hypotheses[0].class_index = 1;
    CHECK(ism::NonMaximumSuppression{.max_iou = 0.5}.verify(hypotheses).size() == 2);
    CHECK(ism::NonMaximumSuppression{.max_iou = 0.5, .across_classes = false}.verify(hypotheses).size() == 3);

    const std::vector<ism::Detection> whole_and_part{block(0, 0, 40, 40, 3), block(5, 5, 10, 10, 2)};
    CHECK(ism::NonMaximumSuppression{}.verify(whole_and_part).size() == 2);
    CHECK(ism::NonMaximumSuppression{.max_inside = 0.5}.verify(whole_and_part).size() == 1);
}

TEST_CASE("MDL savings follow the formula") {
    const ism::Mdl mdl{.k1_over_k0 = 0.1, .k2_over_k0 = 0.9};
    const std::vector<ism::Detection> two{block(0, 0, 10, 10, 2, 0.8f), block(5, 0, 10, 20, 1, 0.6f)};
    const auto savings = mdl.savings(two);
    CHECK(savings.own[0] == Approx(-0.1 + 0.1 + 0.9 * 0.8));
    CHECK(savings.own[1] == Approx(-0.1 + 0.1 + 0.9 * 0.6));
    // 50 pixels are claimed by both; the weaker, of 200, pays
    CHECK(savings.cost[1] == Approx(50.0 / 200 * (0.1 + 0.9 * 0.6)));
    CHECK(savings.cost[1] == savings.cost[2]);
}

TEST_CASE("greedy MDL comes near the best of all subsets") {
    ism::Random random(4);
    const ism::Mdl mdl;
    double share = 0;
    constexpr int trials = 60;
    for (int trial = 0; trial < trials; ++trial) {
        std::vector<ism::Detection> hypotheses;
        for (std::size_t i = 0; i < 3 + random.index(6); ++i)
            hypotheses.push_back(block(int(random.index(60)), int(random.index(20)),
                                       10 + int(random.index(20)), 10 + int(random.index(10)),
                                       random.uniform(0.2, 1), float(random.uniform(0.55, 1))));
        const auto savings = mdl.savings(hypotheses);
        double best = 0;
        for (std::size_t set = 0; set < (std::size_t{1} << hypotheses.size()); ++set) {
            std::vector<std::size_t> chosen;
            for (std::size_t i = 0; i < hypotheses.size(); ++i)
                if ((set >> i) & 1) chosen.push_back(i);
            best = std::max(best, savings.of(chosen));
        }
        std::vector<std::size_t> greedy;
        for (const auto& verified : mdl.verify(hypotheses)) {
            greedy.push_back(verified.index);
            CHECK(verified.score > 0);
            CHECK(verified.score <= hypotheses[verified.index].score + 1e-12);
        }
        CHECK(savings.of(greedy) <= best + 1e-9);
        CHECK(savings.of(greedy) >= 0.5 * best);
        share += best > 0 ? savings.of(greedy) / best : 1;
    }
    CHECK(share / trials >= 0.9);
}

TEST_CASE("MDL drops a hypothesis inside a stronger one and keeps neighbours") {
    const std::vector<ism::Detection> three{block(0, 0, 40, 20, 2), block(10, 2, 16, 16, 1),
                                            block(42, 0, 40, 20, 1.5)};
    const auto kept = ism::Mdl{}.verify(three);
    REQUIRE(kept.size() == 2);
    CHECK(kept[0].index == 0);
    CHECK(kept[1].index == 2);
}
