// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/painted.hpp"

#include "ism/evaluate/coco.hpp"
#include "ism/evaluate/table.hpp"

#if defined(STBI_INCLUDE_STB_IMAGE_H)
#error "files are measured against files without a library for images"
#endif

using ism::test::rectangle;

namespace {

// two images of 30×20; the numbers of images and categories are neither in order nor dense
ism::Dataset two_images() {
    ism::Dataset set;
    set.source = "small.json";
    set.class_names = {"cup", "bowl"};
    set.category_ids = {7, 3};
    set.images.resize(2);
    set.images[0].id = 90, set.images[1].id = 4;
    for (ism::DatasetImage& image : set.images) image.width = 30, image.height = 20;
    set.images[0].objects = {{1, 0, {0, 0, 10, 10}, false, ism::compress_mask(rectangle(0, 0, 10, 10))},
                             {2, 1, {12, 0, 18, 20}, true, {}}};
    set.images[1].objects = {{3, 1, {5, 5, 10, 10}, false, {}}};
    return set;
}

ism::Result result_of(std::int64_t image, std::int64_t category, ism::Box box, double score) {
    ism::Result result;
    result.image_id = image, result.category_id = category, result.box = box, result.score = score;
    return result;
}

std::string message_of(const ism::Dataset& set, const std::vector<ism::Result>& results) {
    try {
        static_cast<void>(ism::evaluate(set, results));
    } catch (const ism::Error& error) {
        return error.what();
    }
    return "";
}

// objects and detections of class 0 in image 0
ism::TruthObject truth_of(ism::Box box, bool crowd = false) {
    return {0, 0, box, crowd};
}
ism::FoundObject found_of(double score, ism::Box box, std::size_t image = 0, std::uint32_t class_index = 0) {
    return {image, class_index, box, score};
}

ism::CocoEvaluation by_coco(const std::vector<ism::TruthObject>& truth,
                            const std::vector<ism::FoundObject>& found) {
    const std::vector<std::string> names{"cup", "bowl"};
    return ism::evaluate_coco(truth, found, 2, names);
}

// what the precision 1 up to a recall of a half is worth: 51 of 101 recalls
constexpr double half_recall = 51.0 / 101;

}  // namespace

TEST_CASE("Results are measured against a data set by its own numbers, with masks and crowds") {
    std::vector<ism::Result> results{result_of(90, 7, {0, 0, 10, 9}, 0.9),
                                     result_of(4, 3, {5, 5, 10, 10}, 0.8),
                                     result_of(90, 3, {14, 2, 5, 5}, 0.95),  // in the crowd
                                     result_of(4, 7, {5, 5, 10, 10}, 0.5)};
    results[0].segmentation = ism::compress_mask(rectangle(0, 0, 10, 9));
    const ism::Evaluation evaluation = ism::evaluate(two_images(), results);
    REQUIRE(evaluation.classes.size() == 2);
    CHECK(evaluation.classes[0].name == "cup");
    CHECK(evaluation.classes[0].figures.ap == 1);
    CHECK(evaluation.classes[0].detections == 2);
    CHECK(evaluation.classes[0].figures.mask_iou == Approx(0.9));
    CHECK(evaluation.classes[1].figures.ap == 1);
    CHECK(evaluation.classes[1].detections == 1);
    CHECK(std::isnan(evaluation.classes[1].figures.mask_iou));

    const ism::Evaluation strict = ism::evaluate(two_images(), results, {.iou_threshold = 0.95});
    CHECK(strict.classes[0].figures.ap == 0);
    const ism::Evaluation uiuc =
        ism::evaluate(two_images(), results, {.rule = ism::EvaluateOptions::Rule::uiuc});
    CHECK(uiuc.classes[0].figures.ap == 1);
}

TEST_CASE("Results with numbers or masks that the data set does not know are refused by name") {
    const ism::Dataset set = two_images();
    const std::vector<ism::Result> good{result_of(90, 7, {0, 0, 10, 9}, 0.9)};
    CHECK(message_of(set, good).empty());

    auto results = good;
    results.push_back(result_of(5, 7, {0, 0, 1, 1}, 0.1));
    CHECK(message_of(set, results) ==
          "result 1: image_id: expected an image of data set 'small.json', got 5");
    results[1] = result_of(4, 1, {0, 0, 1, 1}, 0.1);
    CHECK(message_of(set, results) ==
          "result 1: category_id: expected a category of data set 'small.json', got 1");
    results = good;
    results[0].segmentation = ism::compress_mask(ism::Mask(20, 30, 1));
    CHECK(message_of(set, results) == "result 0: mask size: expected 30x20, got 20x30");
    results = good;
    results.push_back(result_of(90, 7, {20, 0, 5, 5}, 0.1));  // also where it is wrong
    results[1].segmentation = ism::compress_mask(ism::Mask(30, 21, 1));
    CHECK(message_of(set, results) == "result 1: mask size: expected 30x20, got 30x21");
    CHECK_THROWS_AS(ism::evaluate(set, good, {.iou_threshold = 0}), ism::Error);
    CHECK_THROWS_AS(ism::evaluate(set, good, {.iou_threshold = 1.5}), ism::Error);
}

TEST_CASE("COCO's rule measures masks as it does boxes") {
    ism::Dataset set = two_images();
    set.images[1].objects[0].segmentation = ism::compress_mask(rectangle(5, 5, 10, 10));
    const auto cut_out = [](std::int64_t image, std::int64_t category, double score, const ism::Mask& mask) {
        ism::Result result = result_of(image, category, ism::mask_box(mask), score);
        result.segmentation = ism::compress_mask(mask);
        return result;
    };
    SECTION("rectangles count as their boxes do, and of a crowd without a mask its box") {
        const std::vector<ism::Result> results{
            cut_out(90, 7, 0.9, rectangle(0, 0, 10, 9)), cut_out(90, 7, 0.8, rectangle(12, 0, 4, 4)),
            cut_out(4, 3, 0.7, rectangle(6, 6, 9, 8)), cut_out(90, 3, 0.95, rectangle(14, 2, 5, 5)),
            cut_out(4, 7, 0.5, rectangle(5, 5, 10, 10))};
        const ism::CocoEvaluation masks = ism::evaluate_coco_masks(set, results);
        CHECK(ism::to_json(masks) == ism::to_json(ism::evaluate_coco(set, results)));
        CHECK(masks.classes[0].figures.ap == Approx(0.9));  // an IoU of .9: nine of ten thresholds
        CHECK(masks.classes[1].detections == 1);            // the other lies in the crowd
    }
    SECTION("what fills half of its box overlaps half") {
        ism::Mask half(30, 20);
        for (int y = 0; y < 10; ++y)
            for (int x = 0; x < 10; ++x) half(x, y) = (x + y) % 2 == 0 || (x == 9 && y == 0) ? 1 : 0;
        const std::vector<ism::Result> results{cut_out(90, 7, 0.9, half)};  // 51 of 100 pixels
        CHECK(ism::evaluate_coco(set, results).classes[0].figures.ap == 1);
        CHECK(ism::evaluate_coco_masks(set, results).classes[0].figures.ap == Approx(0.1));
        CHECK(ism::evaluate_coco_masks(set, results).classes[0].figures.ap50 == 1);
    }
    SECTION("a crowd's mask takes what lies in it, however small") {
        ism::Mask ring = rectangle(12, 0, 18, 20);
        for (int y = 5; y < 15; ++y)
            for (int x = 16; x < 26; ++x) ring(x, y) = 0;
        set.images[0].objects[1].segmentation = ism::compress_mask(ring);
        const auto counted = [&](const ism::Mask& mask) {
            const std::vector<ism::Result> results{cut_out(90, 3, 0.9, mask)};
            return ism::evaluate_coco_masks(set, results).classes[1].detections;
        };
        CHECK(counted(rectangle(12, 0, 3, 3)) == 0);
        CHECK(counted(rectangle(17, 6, 8, 8)) == 1);  // in its box, but not in it
    }
    SECTION("a result without a mask finds nothing; labels and results of boxes alone are refused") {
        std::vector<ism::Result> results{cut_out(90, 7, 0.8, rectangle(0, 0, 10, 10)),
                                         result_of(90, 7, {0, 0, 10, 10}, 0.9)};
        CHECK(ism::evaluate_coco_masks(set, results).classes[0].figures.ap == Approx(0.5));
        results.erase(results.begin());
        CHECK_THROWS_WITH(ism::evaluate_coco_masks(set, results),
                          "results: expected masks (segmentation), got boxes alone");
        set.images[1].objects[0].segmentation = {};
        set.images[1].file = "b.png";
        CHECK_THROWS_WITH(ism::evaluate_coco_masks(set, results),
                          "label of file 'b.png': expected a mask, to measure masks, got a box alone");
        set.images[1].objects.clear();
        CHECK(ism::evaluate_coco_masks(set, {}).classes[0].figures.ap == 0);
    }
}

TEST_CASE("The IoU of masks tells of how many it is where some have none") {
    ism::Dataset set = two_images();
    set.images[1].objects[0].class_index = 0;  // a second cup, without a mask
    std::vector<ism::Result> results{result_of(90, 7, {0, 0, 10, 9}, 0.9),
                                     result_of(4, 7, {5, 5, 10, 10}, 0.8)};
    results[0].segmentation = ism::compress_mask(rectangle(0, 0, 10, 9));
    const ism::Evaluation evaluation = ism::evaluate(set, results);
    CHECK(evaluation.classes[0].masks == 1);
    CHECK(ism::mask_iou_text(evaluation.classes[0]) == "90.0 (1 of 2)");
    CHECK(ism::mask_iou_text(evaluation.classes[1]) == "-");
    CHECK(ism::to_table(evaluation).find("90.0 (1 of 2)\n") != std::string::npos);
    CHECK(nlohmann::json::parse(ism::to_json(evaluation))["classes"]["cup"]["masks"] == 1);
}

TEST_CASE("A result without area finds nothing and is counted") {
    const std::vector<ism::Result> results{result_of(90, 7, {5, 5, 0, 0}, 0.9),
                                           result_of(90, 7, {0, 0, 10, 10}, 0.8)};
    const ism::ClassEvaluation cups = ism::evaluate(two_images(), results).classes[0];
    CHECK(cups.detections == 2);
    CHECK(cups.true_positives == 1);
    CHECK(cups.figures.ap == 0.5);
    CHECK(ism::evaluate_coco(two_images(), results).classes[0].figures.ap50 == 0.5);
}

TEST_CASE("An evaluation as JSON keeps the order of classes and writes null for what was not measured") {
    const auto json = nlohmann::ordered_json::parse(ism::to_json(ism::evaluate(two_images(), {})));
    CHECK(json["classes"].begin().key() == "cup");
    CHECK(json["classes"]["cup"]["ap"] == 0.0);
    CHECK(json["classes"]["cup"]["mask_iou"].is_null());
    CHECK(json["classes"]["bowl"]["objects"] == 1);
    CHECK(json["mean"]["eer"] == 0.0);
    CHECK(json["accuracy"].is_null());

    ism::Dataset one_each = two_images();
    one_each.images[0].objects.resize(1);
    const std::vector<ism::Result> results{result_of(4, 3, {5, 5, 10, 10}, 0.8)};
    const auto with_accuracy = nlohmann::json::parse(ism::to_json(ism::evaluate(one_each, results)));
    CHECK(with_accuracy["accuracy"] == 0.5);
    CHECK(with_accuracy["confusion"]["classes"] == nlohmann::json{"cup", "bowl"});
    CHECK(with_accuracy["confusion"]["images"].dump() == "[[0,0,1],[0,1,0]]");
    CHECK_FALSE(json.contains("confusion"));
}

TEST_CASE("The thresholds of COCO's rule are those of numpy's linspace") {
    for (std::size_t i = 0; i < 10; ++i)
        CHECK(ism::coco_thresholds[i] == Approx(0.5 + 0.05 * double(i)).epsilon(1e-15));
    CHECK(ism::coco_thresholds[8] <= 0.9);
    CHECK(ism::coco_thresholds[9] == 0.95);
}

TEST_CASE("COCO's rule matches anew at each overlap") {
    // 1 overlaps the first object by 9/11, 2 by .9: up to .8 it is found by 1, for .85 and .9 by 2; both
    // overlap the second object by less than a half, or not as well
    const auto result =
        by_coco({truth_of({0, 0, 10, 10}), truth_of({0, 40, 10, 10})},
                {found_of(.9, {0, 1, 10, 10}), found_of(.8, {0, 0, 10, 9}), found_of(.7, {50, 0, 10, 10})});
    const ism::CocoFigures& figures = result.classes[0].figures;
    CHECK(figures.ap50 == Approx(half_recall));
    CHECK(figures.ap75 == Approx(half_recall));
    CHECK(figures.ap == Approx((7 * half_recall + 2 * half_recall / 2) / 10));
    CHECK(figures.recall == Approx(0.45));
    CHECK(result.classes[0].objects == 2);
    CHECK(result.classes[0].detections == 3);
}

TEST_CASE("By COCO's rule crowds take what no object takes, any number of detections") {
    const std::vector<ism::TruthObject> truth{truth_of({0, 0, 100, 50}, true), truth_of({10, 10, 10, 10}),
                                              truth_of({200, 0, 10, 10})};
    const std::vector<ism::FoundObject> found{found_of(.9, {40, 10, 20, 20}), found_of(.9, {42, 10, 20, 20}),
                                              found_of(.8, {10, 10, 10, 6}), found_of(.5, {200, 0, 10, 10})};
    // the third is the object in the crowd up to an overlap of .6, beyond it is part of the crowd
    ism::CocoFigures figures = by_coco(truth, found).classes[0].figures;
    CHECK(figures.ap50 == 1);
    CHECK(figures.ap75 == Approx(half_recall));
    CHECK(figures.ap == Approx(0.3 + 0.7 * half_recall));
    CHECK(figures.recall == Approx(0.65));

    // half of it in the crowd is enough at .5 alone, else it is wrong before any that is right
    auto beside = found;
    beside.push_back(found_of(1, {95, 0, 10, 10}));
    figures = by_coco(truth, beside).classes[0].figures;
    CHECK(figures.ap50 == 1);
    CHECK(figures.ap75 == Approx(half_recall / 2));
    CHECK(figures.ap == Approx((1 + 2 * 2.0 / 3 + 7 * half_recall / 2) / 10));
}

TEST_CASE("By COCO's rule of equal scores the first image and detection count first") {
    const std::vector<ism::TruthObject> truth{truth_of({0, 0, 10, 10})};
    const ism::FoundObject right = found_of(.5, {0, 0, 10, 10}), wrong = found_of(.5, {50, 0, 10, 10}),
                           wrong_there = found_of(.5, {0, 0, 10, 10}, 1);
    CHECK(by_coco(truth, {right, wrong}).mean.ap == 1);
    CHECK(by_coco(truth, {wrong, right}).mean.ap == 0.5);
    CHECK(by_coco(truth, {wrong_there, right}).mean.ap == 1);
}

TEST_CASE("By COCO's rule of equal overlaps the last object is found") {
    // the first detection overlaps both by 9/11; the second is right from .7 to .8 if the first took the last
    const auto result = by_coco({truth_of({0, 0, 10, 10}), truth_of({2, 0, 10, 10})},
                                {found_of(.9, {1, 0, 10, 10}), found_of(.8, {0, 0, 10, 10})});
    CHECK(result.mean.ap == Approx(0.7 + 0.3 * half_recall / 2));
    CHECK(result.mean.recall == Approx(0.7 + 0.3 * 0.5));
}

TEST_CASE("COCO's rule counts the best 100 detections of each image and class") {
    const std::vector<ism::TruthObject> truth{truth_of({0, 0, 10, 10}), {0, 1, {0, 0, 10, 10}}};
    std::vector<ism::FoundObject> found{found_of(.1, {0, 0, 10, 10}), found_of(.1, {0, 0, 10, 10}, 0, 1)};
    for (int i = 0; i < 99; ++i) found.push_back(found_of(.5, {50, 0, 10, 10}));
    CHECK(by_coco(truth, found).classes[0].figures.ap == Approx(0.01));
    found.push_back(found_of(.5, {50, 0, 10, 10}, 1));
    CHECK(by_coco(truth, found).classes[0].figures.ap == Approx(1.0 / 101));
    found.push_back(found_of(.5, {50, 0, 10, 10}));
    const auto result = by_coco(truth, found);
    CHECK(result.classes[0].figures.ap == 0);
    CHECK(result.classes[0].figures.recall == 0);
    CHECK(result.classes[0].detections == 101);
    CHECK(result.classes[1].figures.ap == 1);
}

TEST_CASE("By COCO's rule a class without objects is not part of the mean") {
    const auto result = by_coco({truth_of({0, 0, 10, 10})},
                                {found_of(.5, {0, 0, 10, 10}), found_of(.9, {0, 0, 10, 10}, 0, 1)});
    CHECK(std::isnan(result.classes[1].figures.ap));
    CHECK(std::isnan(result.classes[1].figures.recall));
    CHECK(result.mean.ap == 1);
    CHECK(by_coco({truth_of({0, 0, 10, 10})}, {}).mean.ap == 0);
    CHECK(std::isnan(by_coco({}, {}).mean.ap));
    CHECK_THROWS_AS(by_coco({}, {found_of(.5, {0, 0, 1, 1}, 2)}), ism::Error);
    CHECK_THROWS_AS(by_coco({}, {found_of(std::nan(""), {0, 0, 1, 1})}), ism::Error);
}

TEST_CASE("Results are measured by COCO's rule in the order of the images' numbers") {
    ism::Dataset set = two_images();
    set.images[0].objects[1].class_index = 0;  // the crowd is one of cups
    // image 4 comes before image 90, whichever stands first in the files
    const std::vector<ism::Result> results{result_of(90, 7, {0, 0, 10, 10}, 0.5),
                                           result_of(4, 7, {0, 0, 10, 10}, 0.5),
                                           result_of(90, 7, {14, 2, 5, 5}, 0.95)};
    const ism::CocoEvaluation result = ism::evaluate_coco(set, results);
    CHECK(result.classes[0].figures.ap == 0.5);
    CHECK(result.classes[0].objects == 1);
    CHECK(result.classes[0].detections == 2);  // that in the crowd is not counted
    CHECK(result.mean.ap == 0.25);
    const auto json = nlohmann::json::parse(ism::to_json(result));
    CHECK(json["classes"]["cup"]["ap50"] == 0.5);
    CHECK(json["mean"]["recall"] == 0.5);
    CHECK(ism::to_table(result) ==
          "class  objects  detections  AP %  AP50 %  AP75 %  recall %\n"
          "cup          1           2  50.0    50.0    50.0     100.0\n"
          "bowl         1           0   0.0     0.0     0.0       0.0\n"
          "mean         2           2  25.0    25.0    25.0      50.0\n");
}
