// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <filesystem>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/files.hpp"

#include "ism/dataset/any_dataset.hpp"

using ism::Box;
using ism::FileError;
using ism::test::error_message;
using ism::test::TemporaryFolder;

namespace {

void write_60_by_50(const std::filesystem::path& path) {
    ism::test::write_pnm(path, 60, 50);
}

std::string labelme(const std::string& shapes, const std::string& image = "a.pgm") {
    return R"({"version":"5.2","flags":{},"imageData":"AAAA","imageHeight":50,"imageWidth":60,"imagePath":")" +
           image + R"(","shapes":[)" + shapes + "]}";
}

std::string shape(const std::string& label, const std::string& type, const std::string& points,
                  const std::string& more = R"("group_id":null)") {
    return R"({"label":")" + label + R"(","shape_type":")" + type + R"(","points":)" + points + "," + more +
           "}";
}

/// A mask as labelme 5 paints it: a PNG of one bit a pixel, 5 by 3: .###. ##### ..#..
const std::string painted =
    R"("mask":"iVBORw0KGgoAAAANSUhEUgAAAAUAAAADAQAAAABzTfhVAAAADklEQVR4nGMoYPjBoAAABT4BiSJgh7YAAAAASUVORK5CYII=")";

}  // namespace

TEST_CASE("Shapes of labelme become objects: polygons, circles, rectangles and groups") {
    const TemporaryFolder folder;
    write_60_by_50(folder / "a.pgm");
    write_60_by_50(folder / "b.pgm");
    write_60_by_50(folder / "no_labels.pgm");
    const std::string group = R"("group_id":3)";
    ism::write_file(folder / "a.json",
                    labelme(shape("duck", "polygon", "[[10,10],[20,10],[20,20],[10,20]]") + "," +
                            shape("car", "rectangle", "[[50,40],[30.5,5]]") + "," +
                            shape("duck", "circle", "[[30,25],[30,35]]") + "," +
                            shape("car", "polygon", "[[1,1],[5,1],[5,5],[1,5]]", group) + "," +
                            shape("car", "polygon", "[[11,1],[15,1],[15,5],[11,5]]", group) + "," +
                            shape("duck", "polygon", "[[1,1],[5,1],[5,5],[1,5]]", R"("difficult":true)")));
    ism::write_file(folder / "b.json", labelme("", "..\\\\elsewhere\\\\b.pgm"));
    const ism::Dataset dataset = ism::read_any_dataset(folder.path());
    CHECK(dataset.class_names == std::vector<std::string>{"car", "duck"});
    CHECK_FALSE(dataset.classes_listed);
    REQUIRE(dataset.images.size() == 2);
    CHECK(dataset.images[1].objects.empty());
    CHECK(dataset.images[1].file == folder / "b.pgm");
    const auto& objects = dataset.images[0].objects;
    REQUIRE(objects.size() == 5);
    const std::vector<std::uint32_t> classes = {1, 0, 1, 0, 1};
    const std::vector<std::size_t> areas = {100, 0, 314, 32, 16};
    const std::vector<Box> boxes = {
        {10, 10, 10, 10}, {30.5, 5, 19.5, 35}, {20, 15, 20, 20}, {1, 1, 14, 4}, {1, 1, 4, 4}};
    for (std::size_t i = 0; i < 5; ++i) {
        CAPTURE(i);
        CHECK(objects[i].class_index == classes[i]);
        CHECK(objects[i].crowd == (i == 4));
        CHECK(objects[i].box.x == Approx(boxes[i].x));
        CHECK(objects[i].box.width == Approx(boxes[i].width));
        CHECK(objects[i].box.height == Approx(boxes[i].height));
        const auto area = double(mask_area(read_mask(dataset.images[0], objects[i])));
        CHECK(area == Approx(double(areas[i])).margin(areas[i] == 314 ? 6 : 0));
    }
    const ism::Dataset one = ism::read_any_dataset(folder / "a.json");
    REQUIRE(one.images.size() == 1);
    CHECK(one.images[0].objects == objects);
}

TEST_CASE("Painted masks of labelme lie where their points say, also as parts of an object") {
    const TemporaryFolder folder;
    write_60_by_50(folder / "a.pgm");
    const std::string group = painted + R"(,"group_id":3)";
    ism::write_file(folder / "a.json",
                    labelme(shape("duck", "mask", "[[10,20],[14,22]]", painted) + "," +
                            shape("car", "mask", "[[55.6,47.2],[59.9,49.9]]", group) + "," +
                            shape("car", "mask", "[[54,46],[58,48]]", group) + "," +
                            shape("car", "polygon", "[[10,10],[20,10],[20,20],[10,20]]", R"("group_id":3)")));
    const ism::Dataset dataset = ism::read_any_dataset(folder.path());
    const auto& objects = dataset.images.at(0).objects;
    REQUIRE(objects.size() == 2);
    CHECK(objects[0].box == Box{10, 20, 5, 3});
    const ism::Mask mask = read_mask(dataset.images[0], objects[0]);
    const std::vector<std::string> rows = {".###.", "#####", "..#.."};
    for (int y = 0; y < 50; ++y)
        for (int x = 0; x < 60; ++x) {
            const bool inside = x >= 10 && x < 15 && y >= 20 && y < 23;
            CHECK((mask(x, y) != 0) == (inside && rows[std::size_t(y - 20)][std::size_t(x - 10)] == '#'));
        }
    // Two painted ones that share 4 pixels, and a square.
    CHECK(objects[1].box == Box{10, 10, 50, 40});
    CHECK(mask_area(read_mask(dataset.images[0], objects[1])) == 9 + 9 - 4 + 100);
}

TEST_CASE("Labels of labelme that make no sense are named by file and shape, or left out") {
    const TemporaryFolder folder;
    write_60_by_50(folder / "a.pgm");
    const auto refused = [&](const std::string& json) {
        ism::write_file(folder / "a.json", json);
        const std::string message =
            error_message<FileError>([&] { (void)ism::read_any_dataset(folder.path()); });
        const std::size_t at = message.find("a.json'");
        return at == std::string::npos ? message : message.substr(at + 7);
    };
    const std::string good = shape("duck", "polygon", "[[10,10],[20,10],[20,20]]") + ",";
    CHECK(
        refused(labelme(good + shape("duck", "line", "[[1,1],[5,1]]"))) ==
        ", shape 1: shape_type: expected polygon, rectangle, circle or mask, got 'line', which has no area");
    CHECK(refused(labelme(good + shape("duck", "cuboid", "[[1,1],[5,1]]"))).ends_with("got 'cuboid'"));
    const auto refused_mask = [&](const std::string& points, const std::string& mask) {
        const std::string message = refused(labelme(good + shape("duck", "mask", points, mask)));
        const std::string place = ", shape 1";
        return message.starts_with(place) ? message.substr(place.size()) : message;
    };
    CHECK(refused_mask("[[1,1],[5,3]]", R"("mask":null)") == ": mask: expected a text, got null");
    CHECK(refused_mask("[[1,1],[5,3]]", R"("mask":"####")") ==
          ", mask: base64: expected letters, digits, + and /, got byte 35 at 0");
    CHECK(refused_mask("[[1,1],[5,3]]", R"("mask":"iVBORw0KGgo=")")
              .starts_with(", mask: expected a whole image, got"));
    CHECK(refused_mask("[[1,1],[6,4]]", painted) ==
          ": points: expected the first and last pixel of a mask of 5x3, got 1, 1 and 6, 4");
    CHECK(refused_mask("[[5,3],[1,1]]", painted).ends_with("got 5, 3 and 1, 1"));
    CHECK(refused_mask("[[56,1],[60,3]]", painted) ==
          ": points: expected a mask within 60x50 pixels, got 56, 1 and 60, 3");
    CHECK(refused_mask("[[-1,1],[3,3]]", painted).starts_with(": points: expected a mask within 60x50"));
    CHECK(refused_mask("[[1,1]]", painted) == ": points: expected 2 or more, got an array of 1");
    CHECK(refused(labelme(good + shape("duck", "polygon", "[[1,1],[5,1]]"))) ==
          ", shape 1: points: expected 3 or more, got an array of 2");
    CHECK(refused(labelme(good + shape("duck", "rectangle", "[[1,1],[5]]"))) ==
          ", shape 1: points: expected pairs x, y, got an array of 1");
    CHECK(refused(labelme(good + shape("", "polygon", "[[1,1],[5,1],[5,5]]"))) ==
          ", shape 1: label: expected a text, got an empty one");
    CHECK(refused(labelme(good + shape("duck", "circle", "[[1,1],[1,1]]")))
              .starts_with(", shape 1: box: expected sides of 0.1 to 600 pixels, got 0x0"));
    CHECK(refused(labelme(good + "3")).starts_with(", shape 1: expected an object, got 3"));
    CHECK(refused(R"({"shapes":3,"imagePath":"a.pgm"})") == ": shapes: expected an array, got 3");
    ism::Faults faults;
    ism::write_file(folder / "a.json", labelme(good + shape("dog", "line", "[[1,1],[5,1]]")));
    const ism::Dataset dataset = ism::read_any_dataset(folder.path(), {.faults = &faults});
    CHECK(dataset.images.at(0).objects.size() == 1);
    CHECK(dataset.images[0].incomplete);
    CHECK(dataset.class_names == std::vector<std::string>{"duck"});
    CHECK(faults.size() == 1);

    ism::write_file(folder / "b.json", labelme("", "other.pgm"));
    CHECK(error_message<FileError>([&] {
              (void)ism::read_labelme(folder / "b.json");
          }).ends_with("b.json': expected its image (imagePath, or of the same name), got none"));
    ism::write_file(folder / "b.json",
                    std::string(R"({"shapes":[],"imagePath":"a.pgm","imageWidth":50,"imageHeight":60})"));
    CHECK(error_message<FileError>([&] {
              (void)ism::read_labelme(folder / "b.json");
          }).ends_with("a.pgm': expected 50x60 pixels as its labels say, got 60x50"));
}
