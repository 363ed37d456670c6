// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "ism/model/box_cues.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include "support/catch.hpp"

#include "ism/core/thread_pool.hpp"
#include "ism/detect/box_colors.hpp"
#include "ism/detect/box_cue_reader.hpp"
#include "ism/detect/voted_boxes.hpp"
#include "ism/hog/describe_cells.hpp"
#include "ism/hog/hog_pyramid.hpp"
#include "ism/train/mean_figures.hpp"

namespace {

/// A picture of one colour with a box of another.
ism::RgbImage box_picture(const ism::Box& box, ism::Rgb figure, ism::Rgb ground) {
    ism::RgbImage picture(200, 160);
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x)
            picture(x, y) =
                x >= box.x && y >= box.y && x < box.x + box.width && y < box.y + box.height ? figure : ground;
    return picture;
}

double overlap(const ism::RgbImage& picture, const ism::Box& box, const ism::ClassFigure& figure) {
    return ism::color_overlap(ism::box_colors(picture, box, figure, ism::LabTable()));
}

}  // namespace

TEST_CASE("colours overlap where a box does not follow an object") {
    const ism::Box box{60, 40, 64, 64};
    const ism::ClassFigure whole(ism::figure_numbers, 1);
    const ism::RgbImage picture = box_picture(box, {200, 30, 30}, {20, 90, 160});
    CHECK(overlap(picture, box, whole) == 0);
    CHECK(overlap(box_picture(box, {9, 9, 9}, {9, 9, 9}), box, whole) == Approx(1));
    // a quarter of the box beside the object, so 3/4 of its figure and 1/5 of its ground are red
    const ism::Box beside{box.x + 16, box.y, box.width, box.height};
    CHECK(overlap(picture, beside, whole) == Approx(std::sqrt(0.75 * 0.2) + std::sqrt(0.25 * 0.8)));
    SECTION("the figure need not fill the box") {
        ism::ClassFigure left(ism::figure_numbers, 0);
        for (std::size_t i = 0; i < left.size(); ++i) left[i] = i % ism::figure_samples < 16;
        CHECK(overlap(picture, {box.x + 32, box.y, box.width, box.height}, left) <
              overlap(picture, {box.x + 32, box.y, box.width, box.height}, whole));
    }
    SECTION("where no ground is to be seen colours tell nothing") {
        const ism::RgbImage crop(64, 64);
        CHECK(overlap(crop, {0, 0, 64, 64}, whole) == 1);
        CHECK(overlap(crop, {500, 500, 64, 64}, whole) == 1);
    }
}

TEST_CASE("a box with the colours of a class and of what is around its objects speaks for it") {
    const ism::Box box{60, 40, 64, 64};
    const ism::ClassFigure whole(ism::figure_numbers, 1);
    const ism::LabTable to_lab;
    const ism::Rgb red{200, 30, 30}, blue{20, 90, 160}, white{250, 250, 250};
    ism::FigureColors known(ism::figure_color_bins, 0);
    known[ism::figure_color_bin(to_lab(red.r, red.g, red.b))] = 2;
    known[ism::figure_color_bin(to_lab(blue.r, blue.g, blue.b))] = -1;
    const auto odds = [&](ism::Rgb figure, ism::Rgb ground) {
        return ism::color_odds(ism::box_colors(box_picture(box, figure, ground), box, whole, to_lab), known);
    };
    CHECK(odds(red, blue) == Approx(2 + 0.5));
    CHECK(odds(red, white) == Approx(2));
    CHECK(odds(white, white) == Approx(0).margin(1e-6));
    CHECK(odds(blue, red) == Approx(-1 - 1));
    const ism::BoxColors seen = ism::box_colors(box_picture(box, red, blue), box, whole, to_lab);
    CHECK(ism::color_odds(seen, {}) == 0);
    CHECK(ism::color_odds({}, known) == 0);
}

TEST_CASE("the figure of a class is the mean of its masks, to both sides") {
    ism::ShapeModel shapes{.class_names = {"a", "b"}, .objects = {}};
    ism::Mask left(8, 8), all(8, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) left(x, y) = x < 4 ? 255 : 0, all(x, y) = 255;
    for (const ism::Mask& mask : {left, all})
        shapes.objects.push_back({.class_index = 0, .width = 100, .height = 50, .mask = mask});
    const std::vector<ism::ClassFigure> figures = ism::mean_figures(shapes);
    REQUIRE(figures.size() == 2);
    REQUIRE(figures[0].size() == ism::figure_numbers);
    const auto middle = std::size_t(16 * ism::figure_samples);
    CHECK(figures[0][middle + 8] == Approx(0.75));  // ½ · (½ + 1)
    CHECK(figures[0][middle + 23] == Approx(0.75));
    CHECK(figures[1] == ism::ClassFigure(ism::figure_numbers, 0));
    shapes.objects.push_back(
        {.class_index = 1, .width = 100, .height = 50, .mask = all});  // a box without a mask
    CHECK(ism::mean_figures(shapes)[1] == figures[1]);
}

TEST_CASE("votes weigh for the boxes that they stand for") {
    ism::ShapeModel shapes{.class_names = {"a", "b"}, .objects = {}};
    shapes.objects.push_back({.class_index = 0, .width = 40, .height = 20});
    shapes.objects.push_back({.class_index = 1, .width = 40, .height = 20});
    std::vector<ism::Occurrence> word(2);
    word[1].class_index = 1, word[1].object = 1;

    shapes.occurrences.push_back(word);
    std::vector<ism::Feature> features(2);
    for (ism::Feature& f : features) f.x = 100, f.y = 50, f.scale = 1;
    features[1].x = 104;
    std::vector<ism::Vote<3>> votes;
    for (const std::uint32_t feature : {0u, 1u})
        votes.push_back({.at = {}, .scale = 1, .weight = 2, .feature = feature, .occurrence = 0});
    votes.push_back({.at = {}, .scale = 1, .weight = 5, .feature = 0, .occurrence = 1});
    ism::VotedBoxes voted(votes, features, shapes);
    const ism::Box box = ism::box_around({100, 50}, 40, 20);
    const double beside = 36.0 / 44.0;  // IoU of a box four pixels to the side
    CHECK(voted.weight(0, box) == Approx(2 + 2 * beside));
    CHECK(voted.weight(1, box) == Approx(5));
    CHECK(voted.weight(1, {80, 40, 80, 40}) == 0);
    CHECK(ism::VotedBoxes().weight(0, box) == 0);
    CHECK(voted.share(0, box) == Approx((2.1 + 2 * beside) / (7.2 + 2 * beside)));
    CHECK(voted.share(1, box) == Approx(1 - voted.share(0, box)));
    CHECK(voted.share(0, {80, 40, 80, 40}) == 0.5);
    std::vector<std::uint32_t> agreeing;
    voted.each_agreeing(0, box, [&](std::uint32_t vote, float, double) { agreeing.push_back(vote); });
    CHECK(agreeing == std::vector<std::uint32_t>{0, 1});
    voted.thin(0, 64);
    CHECK(voted.weight(0, box) == 0);
    CHECK(voted.weight(1, box) == Approx(5));
    for (int i = 0; i < 640; ++i) votes.push_back(votes.front());
    ism::VotedBoxes many(votes, features, shapes);
    many.thin(0, 64);
    CHECK(many.weight(0, box) == Approx(2 * 640));
    ism::VotedBoxes halved(votes, features, shapes);
    halved.thin(0, 2);
    CHECK(halved.weight(0, box) == Approx(2 * 642).margin(2));
}

TEST_CASE("votes agree with a box by the IoU of theirs, wherever it lies") {
    ism::ShapeModel shapes{.class_names = {"a"}, .objects = {}};
    shapes.objects.push_back({.class_index = 0, .width = 40, .height = 20});
    shapes.occurrences.push_back(std::vector<ism::Occurrence>(1));
    ism::Random random(1);
    for (const std::size_t count : {0, 1, 15, 16, 17, 1000})
        for (const float far : {0.0f, 6000.0f}) {
            std::vector<ism::Feature> features(count);
            std::vector<ism::Vote<3>> votes(count);
            for (std::uint32_t i = 0; i < count; ++i) {
                features[i].x = far + float(random.uniform(0, 60));
                features[i].y = far + float(random.uniform(0, 60));
                features[i].scale = float(random.uniform(0.3, 3));
                votes[i] = {.at = {}, .scale = features[i].scale, .weight = 1, .feature = i};
            }
            const ism::VotedBoxes voted(votes, features, shapes);
            for (int k = 0; k < 10; ++k) {
                const ism::Box box =
                    ism::box_around({far + random.uniform(0, 60), far + random.uniform(0, 60)},
                                    random.uniform(5, 80), random.uniform(5, 80));
                std::vector<std::uint32_t> told, expected;
                voted.each_agreeing(0, box, [&](std::uint32_t vote, float, double) { told.push_back(vote); });
                for (std::uint32_t i = 0; i < count; ++i) {
                    const ism::Feature& f = features[i];
                    if (ism::iou(ism::box_around({f.x, f.y}, 40 * f.scale, 20 * f.scale), box) >= 0.5)
                        expected.push_back(i);
                }
                CHECK(told == expected);
            }
        }
}

TEST_CASE("a box is small where it is so in pixels and beside its picture") {
    const ism::TypicalSize typical{.log_px = std::log(600), .log_part = std::log(0.25)};
    const ism::Box box{7, 9, 30, 20};
    CHECK(ism::log_size(box, 60, 40, typical) == Approx(0).margin(1e-9));
    CHECK(ism::log_size(box, 600, 400, typical) == Approx(0).margin(1e-9));           // all of its pixels
    CHECK(ism::log_size({7, 9, 15, 10}, 30, 20, typical) == Approx(0).margin(1e-9));  // as large a part
    CHECK(ism::log_size({7, 9, 15, 10}, 60, 40, typical) == Approx(std::log(0.25)));
    CHECK(ism::log_size({7, 9, 15, 10}, 60, 20, typical) == Approx(std::log(0.5)));
    CHECK(ism::log_size({0, 0, 60, 40}, 60, 40, typical) == 0);
}

TEST_CASE("what a judge of boxes is not given has nothing to say") {
    const ism::Box box{60, 40, 60, 50};
    const ism::RgbImage picture = box_picture(box, {200, 40, 30}, {30, 60, 200});
    ism::ThreadPool pool(1);
    ism::HogPyramid pyramid;
    pyramid.assign(picture, 0, pool);
    const ism::VotedBoxes voted;
    const ism::WordMap words;
    const ism::JudgedImage image{pyramid, picture, voted, words};
    ism::CellScratch scratch;

    const ism::BoxCues none = ism::BoxCueReader({}, image).cues(0, {box, 0.7, false}, scratch);
    CHECK(none.margin == 0.7);
    CHECK(none.word_logit == 0);
    CHECK(none.patch_margin == 0);
    CHECK(none.vote_weight == 0);
    CHECK(none.vote_share == 0.5);
    CHECK(none.color_overlap == 1);
    CHECK(none.color_odds == 0);
    CHECK(none.log_size == 0);

    const std::vector<ism::ClassFigure> figures{ism::ClassFigure(ism::figure_numbers, 1.0f)};
    const std::vector<ism::FigureColors> colors{ism::FigureColors(ism::figure_color_bins, 2.0f)};
    const std::vector<ism::TypicalSize> sizes{{.log_px = std::log(4 * box.area()), .log_part = 0}};
    const ism::BoxCueReader reader({.figures = figures, .colors = colors, .sizes = sizes}, image);
    const ism::BoxCues known = reader.cues(0, {box, 0.7, false}, scratch);
    CHECK(known.color_overlap == Approx(overlap(picture, box, figures[0])));
    CHECK(known.color_odds == Approx(2 * (1 - 0.5)));
    CHECK(known.log_size == Approx(std::log(0.25)));
    const ism::BoxCues other = reader.cues(1, {box, 0.7, false}, scratch);  // a class that is not given
    CHECK(other.color_overlap == 1);
    CHECK(other.log_size == 0);
}

TEST_CASE("cues are worth margins of a template") {
    const ism::CueWeights weights{
        .patches = 0.5, .words = 0.1, .votes = 0.2, .share = 0.4, .contrast = 1, .colors = 0.5, .size = 0.3};
    const ism::BoxCues cues{.margin = 0.5,
                            .word_logit = -2,
                            .patch_margin = -0.8,
                            .vote_weight = 0.9,
                            .vote_share = 0.5,
                            .color_overlap = 0.25,
                            .color_odds = 0.7,
                            .log_size = std::log(0.25)};
    CHECK(weights.margin(cues) ==
          Approx(0.5 - 0.4 - 0.2 + 0 + 0.4 * std::log(0.5) - 0.25 + 0.35 + 0.3 * std::log(0.25)));
    CHECK(ism::CueWeights().margin(cues) == 0.5);
    CHECK(ism::CueWeights{.patches = 2}.margin({.margin = 0.1, .patch_margin = 3}) == Approx(0.1));
    const ism::BoxReasons odds = weights.reasons(cues).in_odds(4, -1);
    CHECK(odds.look == Approx(2));
    CHECK(odds.patches == Approx(-1.6));
    CHECK(odds.words == Approx(-0.8));
    CHECK(odds.votes == Approx(0).margin(1e-9));
    CHECK(odds.share == Approx(1.6 * std::log(0.5)));
    CHECK(odds.contrast == Approx(-1));
    CHECK(odds.colors == Approx(1.4));
    CHECK(odds.size == Approx(1.2 * std::log(0.25)));
    CHECK(odds.sum() == Approx(4 * weights.margin(cues) - 1));
}
