// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/files.hpp"

#include "ism/dataset/coco_results.hpp"

using ism::Box;
using ism::FileError;
using ism::Result;
using ism::test::error_message;
using ism::test::TemporaryFolder;

namespace {

std::string results_error(const std::string& json) {
    const TemporaryFolder folder;
    ism::write_file(folder / "r.json", json);
    const std::string head = "file '" + (folder / "r.json").string() + "'";
    const std::string message = error_message<FileError>([&] { (void)ism::read_results(folder / "r.json"); });
    return message.substr(0, head.size()) == head ? message.substr(head.size()) : message;
}

}  // namespace

TEST_CASE("Results that are written come back equal") {
    const TemporaryFolder folder;
    const ism::Mask mask(6, 5, 1);
    const std::vector<Result> results = {
        {.image_id = 3, .category_id = -2, .box = {-1.5, 2, 3, 1.0 / 3}, .score = 0.1},
        {.image_id = 1,
         .category_id = 7,
         .box = {0, 0, 6, 5},
         .score = -1e-30,
         .probability = 0.625,
         .segmentation = ism::compress_mask(mask),
         .position_m = ism::Point3{0.1, -0.2, 1.3},
         .depth_m = 1.3,
         .scale = 0.7,
         .position_error_m = 0.02,
         .angle_rad = -0.25,
         .class_name = "tea cup"}};
    ism::write_results(folder / "r.json", results);
    const std::vector<Result> read = ism::read_results(folder / "r.json");
    REQUIRE(read.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(read[i].image_id == results[i].image_id);
        CHECK(read[i].category_id == results[i].category_id);
        CHECK(read[i].box == results[i].box);
        CHECK(read[i].score == results[i].score);
        CHECK(read[i].segmentation == results[i].segmentation);
        CHECK(read[i].position_m == results[i].position_m);
        CHECK(read[i].scale == results[i].scale);
        CHECK(read[i].angle_rad == results[i].angle_rad);
        CHECK(std::isnan(read[i].probability) == std::isnan(results[i].probability));
        if (!std::isnan(results[i].probability)) CHECK(read[i].probability == results[i].probability);
    }
    CHECK(std::isnan(read[0].depth_m));
    CHECK(read[1].depth_m == 1.3);
    CHECK(std::isnan(read[0].position_error_m));
    CHECK(read[1].position_error_m == 0.02);
    CHECK((read[0].class_name.empty() && read[1].class_name == "tea cup"));
    const std::string text = ism::read_text(folder / "r.json");  // what is not known is not there
    CHECK(text.find("null") == std::string::npos);
    CHECK(text.find("depth_m") == text.rfind("depth_m"));
    CHECK(text.find("angle_rad") == text.rfind("angle_rad"));

    ism::write_results(folder / "none.json", std::vector<Result>{});
    CHECK(ism::read_results(folder / "none.json").empty());
}

TEST_CASE("Results of other programs are read without what only we write") {
    const TemporaryFolder folder;
    ism::write_file(folder / "r.json", std::string_view(R"([
        {"image_id":1,"category_id":2,"bbox":[1,2,3,4],"score":0.5,"id":9},
        {"image_id":1,"category_id":2,"score":1,"segmentation":{"size":[3,4],"counts":[4,2,6]}},
        {"image_id":1,"category_id":2,"score":1,"bbox":[1,2,0,4],"segmentation":[]}])"));
    const std::vector<Result> results = ism::read_results(folder / "r.json");
    REQUIRE(results.size() == 3);
    CHECK((!results[0].segmentation && !results[0].position_m && std::isnan(results[0].depth_m)));
    CHECK(results[0].scale == 1);
    CHECK(results[1].box == Box{1, 1, 1, 2});
    CHECK((!results[2].segmentation && results[2].box == Box{1, 2, 0, 4}));
}

TEST_CASE("Results that make no sense are refused with the place") {
    const std::string head =
        R"([{"image_id":1,"category_id":2,"score":1,"bbox":[1,2,3,4]},{"image_id":1,"category_id":2)";
    const std::string good = head + R"(,"score":1,"bbox":[1,2,3,4])";
    CHECK(results_error("{}") == ": expected an array of results, got an object");
    CHECK(
        results_error("[}").starts_with(": expected well-formed JSON, got parse error at line 1, column 2"));
    CHECK(results_error(head + "}]") == ", result 1: score: expected a number, got nothing");
    CHECK(results_error(head + R"(,"score":null,"bbox":[1,2,3,4]}])") ==
          ", result 1: score: expected a number, got null");
    CHECK(results_error(head + R"(,"score":1}])") ==
          ", result 1: bbox: expected a box, or a segmentation to take it from, got neither");
    CHECK(results_error(good + R"(,"depth_m":-1}])") ==
          ", result 1: depth_m: expected metres above 0, got -1");
    CHECK(results_error(good + R"(,"position_error_m":-1}])") ==
          ", result 1: position_error_m: expected metres, 0 or more, got -1");
    CHECK(results_error(good + R"(,"angle_rad":"up"}])") ==
          ", result 1: angle_rad: expected a number, got \"up\"");
    CHECK(results_error(good + R"(,"class":7}])") == ", result 1: class: expected a text, got 7");
    CHECK(results_error(good + R"(,"scale":0}])") == ", result 1: scale: expected a number above 0, got 0");
    CHECK(results_error(good + R"(,"probability":1.5}])") ==
          ", result 1: probability: expected a number from 0 to 1, got 1.5");
    CHECK(results_error(good + R"(,"position_m":[1,2]}])") ==
          ", result 1: position_m: expected three numbers x, y, z, got an array of 2");
    CHECK(
        results_error(good + R"(,"segmentation":[[1,1,5,1,5,5]]}])") ==
        ", result 1: segmentation: expected run lengths {size, counts}, as results have them, got polygons");
    CHECK(results_error(head + R"(,"score":1,"bbox":[1,2,-3,4]}])") ==
          ", result 1: bbox: expected a width and height of 0 or more, got -3x4");
    CHECK(results_error(head + R"(,"score":1,"segmentation":[]}])") ==
          ", result 1: bbox: expected a box, or a segmentation to take it from, got neither");
    CHECK(results_error(good + "}]") == "nothing thrown");

    const TemporaryFolder folder;
    const std::vector<Result> bad = {{.box = {0, 0, 1, 1}, .score = std::nan("")}};
    CHECK(error_message<FileError>([&] { ism::write_results(folder / "r.json", bad); }) ==
          "file '" + (folder / "r.json").string() + "', result 0: score: expected a number, got null");
    CHECK_FALSE(std::filesystem::exists(folder / "r.json"));
}
