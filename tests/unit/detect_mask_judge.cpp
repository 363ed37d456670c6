// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "support/catch.hpp"

#include "ism/detect/mask_cues.hpp"
#include "ism/detect/mask_judge_score.hpp"
#include "ism/detect/mask_suppression.hpp"

namespace {

using ism::MaskExample;
using ism::MaskLook;
using ism::Rgb;

using Colors = std::array<float, ism::color_histogram_bins>;

/// The histogram of a row of pixels of these colours.
Colors colors_in(const std::vector<Rgb>& colors) {
    ism::RgbImage picture(int(colors.size()) + 2, 3, Rgb{1, 2, 3});
    for (std::size_t i = 0; i < colors.size(); ++i) picture(int(i) + 1, 1) = colors[i];
    return ism::color_histogram(picture, {1, 1, ism::Mask(int(colors.size()), 1, 1)});
}

/// All in one bin.
Colors all_in(std::size_t bin) {
    Colors histogram{};
    histogram.at(bin) = 1;
    return histogram;
}

MaskLook look_of(std::size_t color_bin, std::size_t shape_bin) {
    MaskLook look{.color = all_in(color_bin)};
    look.shape.at(shape_bin) = 1;
    return look;
}

ism::Detection candidate(double score, ism::Box box, std::uint32_t class_index = 0) {
    ism::Detection d;
    d.class_index = class_index, d.score = score, d.box = box;
    d.segmentation.x = int(box.x), d.segmentation.y = int(box.y);
    d.segmentation.mask = ism::Mask(int(box.width), int(box.height), 1);
    return d;
}

std::vector<std::pair<std::size_t, double>> kept(const ism::MaskSuppression& suppression,
                                                 const std::vector<ism::Detection>& candidates) {
    std::vector<std::pair<std::size_t, double>> result;
    for (const ism::Verified& v : suppression.verify(candidates)) result.emplace_back(v.index, v.score);
    return result;
}

using Kept = std::vector<std::pair<std::size_t, double>>;

}  // namespace

TEST_CASE("colours are counted by hue and value, greys by value") {
    // Twelve hues from red; three values each, the brightest last.
    const std::vector<std::pair<Rgb, std::size_t>> bins{
        {{255, 0, 0}, 0 * 3 + 2},
        {{255, 128, 0}, 1 * 3 + 2},
        {{255, 255, 0}, 2 * 3 + 2},
        {{0, 255, 0}, 4 * 3 + 2},
        {{0, 255, 255}, 6 * 3 + 2},
        {{0, 0, 255}, 8 * 3 + 2},
        {{255, 0, 255}, 10 * 3 + 2},
        {{255, 0, 1}, 11 * 3 + 2},
        {{85, 0, 0}, 0},
        {{86, 0, 0}, 1},
        {{171, 0, 0}, 2},
        {{0, 0, 0}, 36},
        {{42, 42, 42}, 36},
        {{43, 43, 43}, 37},
        {{255, 255, 255}, 41},
        {{100, 100, 80}, 36 + 2},  // a fifth is not above a fifth
        {{100, 100, 79}, 2 * 3 + 1}};
    for (const auto& [color, bin] : bins) {
        CAPTURE(int(color.r), int(color.g), int(color.b), bin);
        CHECK(colors_in({color}) == all_in(bin));
    }
    const Colors mixed = colors_in({{255, 0, 0}, {255, 0, 0}, {255, 0, 0}, {0, 0, 0}});
    CHECK(mixed[2] == std::sqrt(0.75f));
    CHECK(mixed[36] == 0.5f);
    float squares = 0;
    for (const float share : colors_in({{9, 200, 3}, {255, 254, 0}, {20, 20, 20}, {7, 0, 77}, {1, 1, 0}}))
        squares += share * share;
    CHECK(squares == Approx(1));
    CHECK(ism::color_histogram(ism::RgbImage(4, 4), {1, 1, ism::Mask(2, 2, 0)}) == Colors{});
}

TEST_CASE("a look is compared with the nearest examples of each class, but not with those left out") {
    const std::vector<MaskExample> examples{{look_of(0, 0), 0, 0}, {look_of(1, 1), 0, 1},
                                            {look_of(0, 1), 1, 2}, {look_of(2, 2)},
                                            {look_of(2, 0), 0, 3}, {look_of(2, 2), 0, 4}};
    const auto looks = ism::look_distances(look_of(0, 0), examples, 3);
    REQUIRE(looks.size() == 4);
    CHECK(looks[0].sq_color == 0);
    CHECK(looks[0].sq_shape == 0);
    CHECK(looks[0].sq_both == 0);
    CHECK(looks[0].sq_three_both == Approx((0.0 + 2 + 4) / 3));
    CHECK(looks[0].color_example == 0);
    CHECK(looks[1].sq_color == 0);
    CHECK(looks[1].sq_shape == 2);
    CHECK(looks[1].sq_both == 2);
    CHECK(looks[1].sq_three_both == Approx((2 + 4 + 4.0) / 3));  // what is missing is far
    CHECK(looks[1].color_example == 2);
    CHECK(looks[2].sq_color == ism::LookDistance::far);  // no examples
    CHECK(looks[3].sq_both == 4);                        // background
    const auto without = ism::look_distances(look_of(0, 0), examples, 3, 0, 3);
    CHECK(without[0].sq_color == 2);
    CHECK(without[0].sq_shape == 0);
    CHECK(without[0].shape_example == 4);
    CHECK(without[1].sq_color == ism::LookDistance::far);
    CHECK(ism::look_distances(look_of(0, 0), {}, 1)[0].sq_both == ism::LookDistance::far);
}

TEST_CASE("votes in a region count for each of its features that can vote") {
    ism::Model model;
    model.shapes.class_names = {"cup", "box"};
    const ism::Frame frame{.gray = ism::GrayImage(20, 20)};
    ism::ThreadPool pool(1);
    ism::Scene scene{.frame = frame, .model = model, .pool = pool};
    // Two in the region, of which one has no frame; six more in it that vote for nothing; one outside.
    for (const float x : {2.0f, 3.0f, 4.0f, 4.0f, 5.0f, 5.0f, 6.0f, 6.0f, 15.0f})
        scene.features.push_back({.x = x, .y = 5});
    scene.frames.assign(scene.features.size(), ism::LocalFrame{});
    scene.frames[1].reset();
    const ism::RegionMask region{0, 0, ism::Mask(10, 10, 1)};
    ism::Detection cup = candidate(1, {0, 0, 10, 10}), weaker = candidate(1, {5, 0, 10, 10});
    cup.support = {{.feature = 0, .weight = 3}, {.feature = 2, .weight = 2}, {.feature = 8, .weight = 9}};
    weaker.support = {{.feature = 0, .weight = 4}};
    const auto votes = ism::region_votes(scene, std::vector{weaker, cup}, region);
    REQUIRE(votes.size() == 2);
    CHECK(votes[0].weight == Approx(5.0 / (7 + 4)));
    CHECK(votes[0].fitting == Approx(5.0 / (7 + 4)));  // the box is that of the region
    CHECK(votes[0].features == Approx(2.0 / (7 + 4)));
    CHECK(votes[0].hypothesis == 1);
    CHECK(votes[1].weight == 0);
    CHECK(votes[1].fitting == 0);
}

TEST_CASE("the cues of a class are its votes and looks against those of others") {
    const std::vector<ism::RegionVotes> votes{{0.2, 0.15, 0.3, 0}, {0.1, 0.025, 0.2, 1}};
    std::vector<ism::LookDistance> looks(3);
    looks[0] = {.sq_color = 0.25, .sq_shape = 1, .sq_both = 1.44, .sq_three_both = 2.25};
    looks[1] = {.sq_color = 1, .sq_shape = 0.64, .sq_both = 1.69, .sq_three_both = 1.96};
    looks[2] = {.sq_color = 0.81, .sq_shape = 2.25, .sq_both = 3.61, .sq_three_both = 4};
    const ism::RegionOutline outline{0.5, 0.25, 0.01};
    const std::vector<double> first{std::log(13.0),
                                    std::log(11.0),
                                    0.3,
                                    std::log(3.0),
                                    0.15 / 0.177,
                                    0.5,
                                    0.5,
                                    0.4,  //
                                    1,
                                    -0.2,
                                    0.5,  //
                                    1.2,
                                    0.1,
                                    0.7,  //
                                    1.5,
                                    -0.1,
                                    0.5,  //
                                    0.5,
                                    0.25,
                                    std::log(2.0)};
    const ism::MaskCues cues = ism::mask_cues(votes, looks, outline, 0);
    REQUIRE(first.size() == ism::mask_cue_count);
    for (std::size_t k = 0; k < first.size(); ++k) {
        CAPTURE(k);
        CHECK(cues[k] == Approx(first[k]).margin(1e-6));
    }
    const ism::MaskCues second = ism::mask_cues(votes, looks, outline, 1);
    CHECK(second[0] == Approx(std::log(3.0)));
    CHECK(second[3] == Approx(std::log(13.0)));
    CHECK(second[4] == Approx(0.025 / 0.177));
    CHECK(second[5] == Approx(1));
    CHECK(second[6] == Approx(-0.5));
    CHECK(second[7] == Approx(-0.1));

    // A single class has no rivals, and background may have no examples.
    const ism::MaskCues alone =
        ism::mask_cues(std::vector<ism::RegionVotes>(1), std::vector<ism::LookDistance>{looks[0], {}}, {}, 0);
    CHECK(alone[0] == 0);
    CHECK(alone[3] == 0);
    CHECK(alone[4] == 0);
    CHECK(alone[6] == Approx(1.5));
    CHECK(alone[7] == Approx(1.5));
}

TEST_CASE("what speaks for a class adds up to the logit, and names whom the region looks like") {
    ism::MaskJudge judge{.bias = 0.5f};
    judge.examples = {{{}, 0, 7}, {{}, 0, 9}};
    ism::MaskCues cues{};
    for (std::size_t k = 0; k < ism::mask_cue_count; ++k) {
        judge.mean[k] = 1, judge.deviation[k] = 2, judge.weights[k] = float(k % 4);
        cues[k] = 1 + float(k);
    }
    const auto reasons = ism::mask_reasons(judge, cues, {.color_example = 1, .shape_example = 0});
    CHECK(reasons.votes == Approx(0.5 * (1 * 1 + 2 * 2 + 3 * 3)));
    CHECK(reasons.color == Approx(0.5 * (1 * 5 + 2 * 6 + 3 * 7)));
    CHECK(reasons.shape == Approx(0.5 * (1 * 9 + 2 * 10)));
    CHECK(reasons.color_object == 9);
    CHECK(reasons.shape_object == 7);
    double outline = 0;
    const ism::MaskCues shares = judge.shares(cues);
    for (std::size_t k = ism::vote_cue_count + ism::look_cue_count; k < ism::mask_cue_count; ++k)
        outline += shares[k];
    CHECK(judge.logit(cues) ==
          Approx(0.5 + reasons.votes + reasons.color + reasons.shape + reasons.look + outline));
}

TEST_CASE("of masks that share much the most probable stays, whatever the class") {
    const auto left = candidate(1, {0, 0, 10, 10}), shifted = candidate(3, {3, 0, 10, 10}, 1),
               far_off = candidate(2, {40, 0, 10, 10}), inner = candidate(5, {41, 1, 3, 3}, 2);
    CHECK(kept({}, {left, shifted, far_off}) == Kept{{1, 3}, {2, 2}});
    CHECK(kept({.max_iou = 0.6, .max_inside = 0.8}, {left, shifted, far_off}) ==
          Kept{{1, 3}, {2, 2}, {0, 1}});
    // A mask within another: the boxes share little, the smaller mask all of itself.
    CHECK(kept({}, {far_off, inner}) == Kept{{1, 5}});
    CHECK(kept({.max_inside = 1}, {far_off, inner}) == Kept{{1, 5}, {0, 2}});
    // Boxes one within the other, masks beside each other.
    auto hollow = far_off;
    for (int y = 1; y < 4; ++y)
        for (int x = 1; x < 4; ++x) hollow.segmentation.mask(x, y) = 0;
    CHECK(kept({}, {hollow, inner}) == Kept{{1, 5}, {0, 2}});
    // Equal scores: the first.
    auto again = left;
    again.class_index = 1;
    CHECK(kept({}, {left, again}) == Kept{{0, 1}});
    CHECK(kept({}, {}).empty());
    static_assert(!ism::MaskSuppression::needs_masks());
    for (const ism::MaskSuppression& bad :
         {ism::MaskSuppression{.max_iou = -0.1}, {.max_iou = NAN}, {.max_inside = 1.1}})
        CHECK_THROWS_AS(check(bad), ism::Error);
}

TEST_CASE("second choices are other classes of the same mask, a little less probable") {
    const auto first = candidate(2, {0, 0, 10, 10}, 0), other_class = candidate(1, {0, 0, 10, 10}, 1),
               other_mask = candidate(1.5, {0, 0, 10, 9}, 2), apart = candidate(4, {50, 50, 8, 8}, 1);
    CHECK(kept({.second_choices = true}, {other_mask, other_class, first, apart}) ==
          Kept{{3, 4}, {2, 2}, {1, std::exp(-1.0)}});
    CHECK(kept({}, {other_mask, other_class, first, apart}) == Kept{{3, 4}, {2, 2}});
}

TEST_CASE("the mask of a rescorer is a sure segmentation") {
    ism::RegionMask region{3, 4, ism::Mask(2, 2, 1)};
    region.mask(1, 0) = 0;
    ism::Detection detection;
    detection.segmentation.x = region.x, detection.segmentation.y = region.y;
    detection.segmentation.mask = region.mask;
    const ism::Frame frame;
    const ism::Model model;
    ism::ThreadPool pool(1);
    const ism::Segmentation sure =
        ism::KeepSegmentation{}.segment(detection, ism::Scene{.frame = frame, .model = model, .pool = pool});
    CHECK((sure.x == 3 && sure.y == 4));
    CHECK(sure.mask == region.mask);
    CHECK(sure.figure(0, 0) == 1);
    CHECK(sure.ground(0, 0) == 0);
    CHECK(sure.figure(1, 0) == 0);
    CHECK(sure.ground(1, 0) == 1);
}
