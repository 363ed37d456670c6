// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <limits>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/files.hpp"
#include "support/painted.hpp"

#include "ism/dataset/to_results.hpp"
#include "ism/evaluate/detections.hpp"

using ism::test::error_message;
using ism::test::rectangle;

namespace {

// Two images of 30×20 with a cup, and a bowl in the second whose mask nobody knows.
ism::Dataset small_set() {
    ism::Dataset set{.source = "small.json", .class_names = {"cup", "bowl"}, .category_ids = {7, 3}};
    set.images.resize(2);
    set.images[0].id = 90, set.images[1].id = 4;
    for (ism::DatasetImage& image : set.images) image.width = 30, image.height = 20;
    set.images[0].objects = {{.id = 1,
                              .class_index = 0,
                              .box = {0, 0, 10, 10},
                              .segmentation = ism::compress_mask(rectangle(0, 0, 10, 10))}};
    set.images[1].objects = {{.id = 2,
                              .class_index = 0,
                              .box = {20, 5, 10, 10},
                              .segmentation = ism::compress_mask(rectangle(20, 5, 10, 10))},
                             {.id = 3, .class_index = 1, .box = {0, 0, 8, 8}}};
    return set;
}

// A detection whose mask is its box from (x, y) on, 12×10, cut off at the right edge where it reaches out.
ism::Detection detection(unsigned class_index, int x, int y, double score) {
    ism::Detection found;
    found.class_index = class_index, found.score = score;
    found.box = {double(x), double(y), 10, 10};
    found.segmentation.x = x, found.segmentation.y = y;
    found.segmentation.mask = ism::Mask(12, 10, 1);
    return found;
}

std::vector<ism::Detections> small_detections() {
    std::vector<ism::Detections> found(2);
    found[0].objects = {detection(0, 0, 0, 0.9), detection(1, 15, 8, 0.2)};
    found[1].objects = {detection(1, 0, 0, 0.8), detection(0, 20, 5, 0.7), detection(0, 20, 5, 0.1)};
    return found;
}

}  // namespace

TEST_CASE("Detections become results with the data set's numbers and masks of the image's size") {
    const ism::Dataset set = small_set();
    ism::Detections found = small_detections()[1];
    found.objects[0].position_m = ism::Point3{1, 2, 3};
    found.objects[0].depth_m = 3, found.objects[0].scale = 0.5;
    const auto results = ism::to_results(found, set.images[1], set.category_ids);
    REQUIRE(results.size() == 3);
    CHECK(results[0].image_id == 4);
    CHECK(results[0].category_id == 3);
    CHECK(results[0].score == 0.8);
    CHECK(results[0].position_m == ism::Point3{1, 2, 3});
    CHECK(results[0].depth_m == 3);
    CHECK(results[0].scale == 0.5);
    CHECK(results[1].category_id == 7);
    CHECK(results[1].box == ism::Box{20, 5, 10, 10});
    REQUIRE(results[1].segmentation);
    CHECK(ism::decompress_mask(*results[1].segmentation) == rectangle(20, 5, 10, 10));
    CHECK_FALSE(results[1].position_m);

    const std::vector<std::int64_t> one = {7};
    CHECK(error_message([&] { (void)ism::to_results(found, set.images[1], one); }) ==
          "class of a detection: expected one of 1 categories, got 1");
}

TEST_CASE("Results have boxes within the image and the model's names and numbers of classes") {
    const ism::DatasetImage image = small_set().images[0];
    ism::Detections found;
    found.objects = {detection(1, 25, 15, 0.9), detection(0, -4, -3, 0.8), detection(0, 40, 2, 0.7)};
    ism::ShapeModel shapes{.class_names = {"cup", "bowl"}, .category_ids = {70, 30}};
    const auto results = ism::to_results(found, image, shapes);
    REQUIRE(results.size() == 2);  // the third is not in the image
    CHECK(results[0].box == ism::Box{25, 15, 5, 5});
    CHECK(results[1].box == ism::Box{0, 0, 6, 7});
    CHECK((results[0].category_id == 30 && results[0].class_name == "bowl"));
    CHECK((results[1].category_id == 70 && results[1].class_name == "cup"));
    shapes.category_ids.clear();
    CHECK(ism::to_results(found, image, shapes)[0].category_id == 2);
}

TEST_CASE("A result is of the class that it names, whatever its number") {
    const ism::Dataset set = small_set();
    std::vector<ism::Result> results = {
        {.image_id = 90, .category_id = 3, .box = {0, 0, 10, 10}, .score = 1, .class_name = "cup"}};
    CHECK(ism::evaluate(set, results).classes[0].true_positives == 1);
    results[0].category_id = 1234;
    CHECK(ism::evaluate(set, results).classes[0].true_positives == 1);
    results[0].class_name = "goose";
    CHECK(error_message([&] { (void)ism::evaluate(set, results); }) ==
          "result 0: class: expected a category of data set 'small.json', got 'goose'");
}

TEST_CASE("Detections are measured as the results made of them") {
    const ism::Dataset set = small_set();
    std::vector<ism::Detections> found = small_detections();
    for (const int y : {-4, -30}) found[0].objects.push_back(detection(0, -3, y, 0.05));
    const ism::Evaluation direct = ism::evaluate(set, found);
    CHECK(direct.classes[0].objects == 2);
    CHECK(direct.classes[0].detections == 4);  // one of the two is in the image
    CHECK(direct.classes[0].true_positives == 2);
    CHECK(direct.classes[1].true_positives == 1);
    CHECK(direct.classes[0].figures.ap == 1);
    // 100 of 120 pixels in the first image; at the right edge all 100
    CHECK(direct.classes[0].figures.mask_iou == Approx((100.0 / 120 + 1) / 2));
    CHECK(std::isnan(direct.classes[1].figures.mask_iou));

    std::vector<ism::Result> results;
    for (std::size_t i = 0; i < found.size(); ++i)
        for (const ism::Result& result : ism::to_results(found[i], set.images[i], set.category_ids))
            results.push_back(result);
    CHECK(ism::to_json(direct) == ism::to_json(ism::evaluate(set, results)));
    CHECK(ism::to_json(ism::evaluate(set, found, {.iou_threshold = 0.3})) ==
          ism::to_json(ism::evaluate(set, results, ism::IouRule{0.3})));
    ism::Dataset crowded = set;
    crowded.images[0].objects[0].crowd = true;
    CHECK(ism::evaluate(crowded, found).classes[0].objects == 1);
    CHECK(ism::evaluate(crowded, found).classes[0].detections == 2);  // those that meet the crowd are ignored
    ism::Dataset incomplete = set;
    for (ism::DatasetImage& image : incomplete.images) image.incomplete = true;
    const ism::Evaluation partly = ism::evaluate(incomplete, found);
    CHECK(partly.classes[0].objects == 2);
    CHECK(partly.classes[0].detections == 2);  // what is no labelled object may be one of those left out
    CHECK(partly.classes[0].true_positives == 2);
    const ism::CocoEvaluation by_coco = ism::evaluate_coco(incomplete, results);
    CHECK(by_coco.classes[0].objects == 2);
    CHECK(by_coco.classes[0].figures.ap50 == 1);
}

TEST_CASE("Detections that are not those of the data set are refused") {
    const ism::Dataset set = small_set();
    std::vector<ism::Detections> found = small_detections();
    found.pop_back();
    CHECK(error_message([&] { (void)ism::evaluate(set, found); }) ==
          "images with detections: expected 2, got 1");
    found = small_detections();
    found[0].objects[0].class_index = 2;
    CHECK(error_message([&] { (void)ism::evaluate(set, found); }) ==
          "class of a found object: expected below 2, got 2");
    CHECK_THROWS_AS(ism::evaluate(set, small_detections(), {.iou_threshold = 0}), ism::Error);
    found = small_detections();
    found[1].objects[0].box.x = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH(ism::evaluate(set, found),
                      Catch::StartsWith("box of a found object: expected finite numbers"));
}
