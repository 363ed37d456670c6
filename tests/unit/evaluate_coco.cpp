// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <string>
#include <vector>

#include "support/catch.hpp"

#include "ism/evaluate/coco.hpp"

#if defined(STBI_INCLUDE_STB_IMAGE_H)
#error "files are measured against files without a library for images"
#endif

namespace {

ism::Mask rectangle(int x0, int y0, int width, int height) {
    ism::Mask mask(30, 20);
    for (int y = y0; y < y0 + height; ++y)
        for (int x = x0; x < x0 + width; ++x) mask(x, y) = 1;
    return mask;
}

// two images of 30×20; the numbers of images and categories are neither in order nor dense
ism::Dataset small_set() {
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

}  // namespace

TEST_CASE("Results are measured against a data set by its own numbers, with masks and crowds") {
    std::vector<ism::Result> results{result_of(90, 7, {0, 0, 10, 9}, 0.9),
                                     result_of(4, 3, {5, 5, 10, 10}, 0.8),
                                     result_of(90, 3, {14, 2, 5, 5}, 0.95),  // in the crowd
                                     result_of(4, 7, {5, 5, 10, 10}, 0.5)};
    results[0].segmentation = ism::compress_mask(rectangle(0, 0, 10, 9));
    const ism::Evaluation evaluation = ism::evaluate(small_set(), results);
    REQUIRE(evaluation.classes.size() == 2);
    CHECK(evaluation.classes[0].name == "cup");
    CHECK(evaluation.classes[0].figures.ap == 1);
    CHECK(evaluation.classes[0].detections == 2);
    CHECK(evaluation.classes[0].figures.mask_iou == Approx(0.9));
    CHECK(evaluation.classes[1].figures.ap == 1);
    CHECK(evaluation.classes[1].detections == 1);
    CHECK(std::isnan(evaluation.classes[1].figures.mask_iou));

    const ism::Evaluation strict = ism::evaluate(small_set(), results, {.iou_threshold = 0.95});
    CHECK(strict.classes[0].figures.ap == 0);
    const ism::Evaluation uiuc =
        ism::evaluate(small_set(), results, {.rule = ism::EvaluateOptions::Rule::uiuc});
    CHECK(uiuc.classes[0].figures.ap == 1);
}

TEST_CASE("Results with numbers or masks that the data set does not know are refused by name") {
    const ism::Dataset set = small_set();
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
    CHECK_THROWS_AS(ism::evaluate(set, good, {.iou_threshold = 0}), ism::Error);
    CHECK_THROWS_AS(ism::evaluate(set, good, {.iou_threshold = 1.5}), ism::Error);
}

TEST_CASE("An evaluation as JSON keeps the order of classes and writes null for what was not measured") {
    const auto json = nlohmann::ordered_json::parse(ism::to_json(ism::evaluate(small_set(), {})));
    CHECK(json["classes"].begin().key() == "cup");
    CHECK(json["classes"]["cup"]["ap"] == 0.0);
    CHECK(json["classes"]["cup"]["mask_iou"].is_null());
    CHECK(json["classes"]["bowl"]["objects"] == 1);
    CHECK(json["mean"]["eer"] == 0.0);
    CHECK(json["accuracy"].is_null());

    ism::Dataset one_each = small_set();
    one_each.images[0].objects.resize(1);
    const std::vector<ism::Result> results{result_of(4, 3, {5, 5, 10, 10}, 0.8)};
    const auto with_accuracy = nlohmann::json::parse(ism::to_json(ism::evaluate(one_each, results)));
    CHECK(with_accuracy["accuracy"] == 0.5);
}
