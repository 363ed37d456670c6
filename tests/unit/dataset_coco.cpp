// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include <cstdint>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "support/files.hpp"

#include "ism/dataset/coco.hpp"
#include "ism/dataset/coco_write.hpp"
#include "ism/dataset/read_images.hpp"

using ism::Box;
using ism::Camera;
using ism::CompressedRle;
using ism::Dataset;
using ism::DatasetImage;
using ism::FileError;
using ism::Image;
using ism::Mask;
using ism::test::error_message;
using ism::test::TemporaryFolder;

namespace {

const std::string categories = R"("categories":[{"id":7,"name":"cup"},{"id":3,"name":"car"}])";
const std::string image_1 = R"({"id":1,"file_name":"images/a.png","width":20,"height":16})";

std::string with_images(const std::string& images) {
    return "{" + categories + R"(,"images":[)" + images + R"(],"annotations":[]})";
}

std::string with_annotations(const std::string& annotations) {
    return "{" + categories + R"(,"images":[)" + image_1 + R"(],"annotations":[)" + annotations + "]}";
}

std::string annotation(const std::string& rest) {
    return with_annotations(R"({"id":5,"image_id":1,"category_id":3)" + rest + "}");
}

Dataset read(const TemporaryFolder& folder, const std::string& json) {
    ism::write_file(folder / "a.json", json);
    return ism::read_dataset(folder / "a.json");
}

// What is wrong with the data set, without the folder's name.
std::string read_error(const std::string& json) {
    const TemporaryFolder folder;
    std::string message = error_message<FileError>([&] { (void)read(folder, json); });
    const std::string path = folder.path().string() + "/";
    for (std::size_t at = message.find(path); at != std::string::npos; at = message.find(path))
        message.erase(at, path.size());
    return message;
}

}  // namespace

TEST_CASE("A data set with everything in it is read") {
    const TemporaryFolder folder;
    const Dataset dataset = read(folder, "{" + categories + R"(,
        "info": {"year": 2026},
        "images": [{"id":1,"file_name":"images/a.png","width":4,"height":3,"depth_file_name":"d.png",
                    "depth_scale":0.001,"camera":{"fx":525.0,"fy":524,"cx":319.5,"cy":239.5}},
                   {"id":-2,"file_name":"../b.png","width":20,"height":16}],
        "annotations": [
            {"id":10,"image_id":-2,"category_id":3,"bbox":[-1.5,2,3,4],"iscrowd":1,"extra":[1]},
            {"id":11,"image_id":1,"category_id":7,"bbox":[0,0,2,2],"segmentation":{"size":[3,4],"counts":"129"}},
            {"id":12,"image_id":1,"category_id":7,"segmentation":{"size":[3,4],"counts":[4,2,6]}},
            {"id":13,"image_id":1,"category_id":3,"segmentation":[[1,1,3,1,3,3,1,3],[0,0,1,0,1,1,0,1]]},
            {"id":14,"image_id":1,"category_id":3,"bbox":[0,0,2,2],"segmentation":[],"iscrowd":false,"position_m":[0.1,-0.2,1]}]})");
    CHECK(dataset.source == folder / "a.json");
    CHECK(dataset.class_names == std::vector<std::string>{"cup", "car"});
    CHECK(dataset.category_ids == std::vector<std::int64_t>{7, 3});
    REQUIRE(dataset.images.size() == 2);
    const DatasetImage& a = dataset.images[0];
    const DatasetImage& b = dataset.images[1];
    CHECK(a.file == folder / "images/a.png");
    CHECK(a.depth_file == folder / "d.png");
    CHECK(a.depth_scale == 0.001);
    CHECK(a.camera == Camera{525, 524, 319.5, 239.5});
    CHECK((a.width == 4 && a.height == 3));
    CHECK(b.file == folder / "../b.png");
    CHECK((b.depth_file.empty() && !b.camera));

    REQUIRE(b.objects.size() == 1);
    CHECK((b.objects[0].class_index == 1 && b.objects[0].crowd));
    CHECK(b.objects[0].box == Box{-1.5, 2, 3, 4});
    CHECK(ism::read_mask(b, b.objects[0]).empty());

    REQUIRE(a.objects.size() == 4);
    CHECK(a.objects[0].class_index == 0);
    CHECK(ism::read_mask(a, a.objects[0]) ==
          Mask(4, 3, std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}));
    CHECK(ism::read_mask(a, a.objects[1]) ==
          Mask(4, 3, std::vector<std::uint8_t>{0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}));
    CHECK(a.objects[1].box == Box{1, 1, 1, 2});
    CHECK(ism::read_mask(a, a.objects[2]) ==
          Mask(4, 3, std::vector<std::uint8_t>{1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0}));
    CHECK(a.objects[2].box == Box{0, 0, 3, 3});
    CHECK((ism::read_mask(a, a.objects[3]).empty() && !a.objects[3].crowd));
    CHECK((a.objects[3].position_m == ism::Point3{0.1, -0.2, 1} && !a.objects[2].position_m));
}

TEST_CASE("A data set that is none is refused with the place") {
    CHECK(
        read_error("{\n  \"images\": [1,,2]}")
            .starts_with("file 'a.json': expected well-formed JSON, got parse error at line 2, column 16: "));
    CHECK(read_error("").starts_with(
        "file 'a.json': expected well-formed JSON, got parse error at line 1, column 1"));
    CHECK(read_error("[1e999]").starts_with("file 'a.json': expected well-formed JSON, got "));
    CHECK(read_error("[1]") == "file 'a.json': expected an object, got an array of 1");
    CHECK(read_error("{}") == "file 'a.json': images: expected an array, got nothing");
    CHECK(read_error(R"({"annotations":[]})") == "file 'a.json': categories: expected an array, got nothing");
    CHECK(read_error("{" + categories + "}") == "file 'a.json': images: expected an array, got nothing");
    CHECK(read_error("{" + categories + R"(,"images":3})") ==
          "file 'a.json': images: expected an array, got 3");
    CHECK(read_error(R"({"categories":[{"name":"cup"}]})") ==
          "file 'a.json', category: id: expected a whole number, got nothing");
    CHECK(read_error(R"({"categories":[{"id":1,"name":""}]})") ==
          "file 'a.json', category with id 1: name: expected a text, got an empty one");
    CHECK(read_error(R"({"categories":[{"id":1,"name":"cup"},{"id":1,"name":"car"}]})") ==
          "file 'a.json', category with id 1: id: expected each id once, got it twice");
    CHECK(read_error(R"({"categories":[{"id":1,"name":"cup"},{"id":2,"name":"cup"}]})") ==
          "file 'a.json', category with id 2: name: expected each name once, got 'cup' twice");
}

TEST_CASE("An image record that makes no sense is refused with the place") {
    const std::string head = R"({"id":1,"file_name":"a.png","width":20,"height":16)";
    const std::string at = "file 'a.json', image with id 1: ";
    CHECK(read_error(with_images("3")) == "file 'a.json', image: expected an object, got 3");
    CHECK(read_error(with_images(R"({"file_name":"a.png"})")) ==
          "file 'a.json', image: id: expected a whole number, got nothing");
    CHECK(read_error(with_images(R"({"id":"1"})")) ==
          "file 'a.json', image: id: expected a whole number, got \"1\"");
    CHECK(read_error(with_images(R"({"id":1.5})")) ==
          "file 'a.json', image: id: expected a whole number, got 1.5");
    CHECK(read_error(with_images(R"({"id":18446744073709551615})")) ==
          "file 'a.json', image: id: expected a whole number, got 18446744073709551615");
    CHECK(read_error(with_images(R"({"id":1})")) == at + "file_name: expected a text, got nothing");
    CHECK(read_error(with_images(R"({"id":1,"file_name":"a.png","width":20})")) ==
          at + "height: expected a whole number, got nothing");
    CHECK(read_error(with_images(R"({"id":1,"file_name":"a.png","width":-20,"height":16})")) ==
          at + "width, height: expected 1 to 134217728 pixels, sides up to 1048576, got -20x16");
    CHECK(read_error(with_images(head + "}," + head + "}")) ==
          at + "id: expected each id once, got it twice");
    CHECK(read_error(with_images(head + R"(,"depth_file_name":"d.png"})")) ==
          at + "depth_scale: expected a number, got nothing");
    CHECK(read_error(with_images(head + R"(,"depth_file_name":"d.png","depth_scale":0})")) ==
          at + "depth_scale: expected metres per unit above 0, got 0");
    CHECK(read_error(with_images(head + R"(,"depth_file_name":"d.png","depth_scale":"mm"})")) ==
          at + "depth_scale: expected a number, got \"mm\"");
    CHECK(read_error(with_images(head + R"(,"camera":{"fx":1,"fy":1,"cx":1}})")) ==
          "file 'a.json', image with id 1, camera: cy: expected a number, got nothing");
    CHECK(read_error(with_images(head + R"(,"camera":{"fx":0,"fy":1,"cx":1,"cy":1}})")) ==
          at + "camera focal lengths fx, fy (pixels): expected 1 to 1e+07, got 0, 1");
    CHECK(read_error(with_images(head + R"(,"depth_file_name":null,"camera":null})")) == "nothing thrown");
}

TEST_CASE("An annotation that makes no sense is refused with the place") {
    const std::string own = "file 'a.json', annotation with id 5: ";
    const std::string at = "file 'a.json', annotation with id 5 of image 1 ('images/a.png'): ";
    const std::string box = R"(,"bbox":[1,2,3,4])";
    CHECK(read_error(with_annotations(R"({"image_id":1})")) ==
          "file 'a.json', annotation: id: expected a whole number, got nothing");
    CHECK(read_error(with_annotations(R"({"id":5,"image_id":2})")) ==
          own + "image_id: expected the id of one of its images, got 2");
    CHECK(read_error(with_annotations(R"({"id":5,"image_id":1,"category_id":1})")) ==
          at + "category_id: expected the id of one of its categories, got 1");
    CHECK(
        read_error(with_annotations(R"({"id":5,"image_id":1,"category_id":3,"bbox":[1,2,3,4]},{"id":5})")) ==
        own + "id: expected each id once, got it twice");
    CHECK(read_error(annotation("")) ==
          at + "bbox: expected a box, or a segmentation to take it from, got neither");
    CHECK(read_error(annotation(box + R"(,"position_m":[1,2,-3])")) ==
          at + "position_m: expected a place before the camera, z above 0, got z = -3");
    CHECK(read_error(annotation(box + R"(,"position_m":[1,2])")) ==
          at + "position_m: expected three numbers x, y, z, got an array of 2");
    CHECK(read_error(annotation(R"(,"bbox":[1,2,3])")) ==
          at + "bbox: expected four numbers x, y, width, height, got an array of 3");
    CHECK(read_error(annotation(R"(,"bbox":[1,2,-3,4])")) ==
          at + "bbox: expected a width and height above 0, got -3x4");
    CHECK(read_error(annotation(R"(,"bbox":[1,2,null,4])")) == at + "bbox: expected a number, got null");
    CHECK(read_error(annotation(R"(,"bbox":[1,2,1e300,4])")) ==
          at + "bbox: expected pixels up to 1e9, got 1e+300");
    CHECK(read_error(annotation(box + R"(,"iscrowd":"no")")) ==
          at + "iscrowd: expected a whole number, got \"no\"");
    CHECK(read_error(annotation(box + R"(,"segmentation":"x")")) ==
          at + "segmentation: expected run lengths or polygons, got \"x\"");
    CHECK(read_error(annotation(box + R"(,"segmentation":{"size":[16,21],"counts":[336]})")) ==
          at + "segmentation size: expected 20x16, got 21x16");
    CHECK(read_error(annotation(box + R"(,"segmentation":{"size":[16,20],"counts":[319]})")) ==
          at + "run lengths of a 20x16 mask: expected a sum of 320, got 319");
    CHECK(read_error(annotation(box + R"(,"segmentation":{"size":[16,20],"counts":[-1,321]})")) ==
          at + "segmentation counts: expected run lengths of 0 or more, got -1");
    CHECK(read_error(annotation(box + R"(,"segmentation":{"size":[16,20],"counts":"o"})")) ==
          at + "packed run lengths: expected a whole last number, got a part of it");
    CHECK(read_error(annotation(box + R"(,"segmentation":{"size":[16,20]})")) ==
          at + "counts: expected run lengths, got nothing");
    CHECK(read_error(annotation(R"(,"segmentation":{"size":[16,20],"counts":[320]})"))
              .ends_with("mask: expected at least one figure pixel, got none"));
    CHECK(read_error(annotation(box + R"(,"segmentation":[[1,2,3,4]])")) ==
          at + "segmentation: expected polygons of 6, 8, ... numbers, got an array of 4");
    CHECK(read_error(annotation(box + R"(,"segmentation":[[1,2,3,4,"5",6]])")) ==
          at + "segmentation: expected a number, got \"5\"");
}

TEST_CASE("A data set cut anywhere or with any character changed is read or refused") {
    const TemporaryFolder folder;
    const std::string json =
        "{" + categories + R"(,"images":[{"id":1,"file_name":"a.png","width":4,"height":3,)" +
        R"("depth_file_name":"d.png","depth_scale":0.1,"camera":{"fx":1,"fy":1,"cx":1,"cy":1}}],)" +
        R"("annotations":[{"id":1,"image_id":1,"category_id":3,"bbox":[1,1,2,2],"iscrowd":0,)" +
        R"("segmentation":{"size":[3,4],"counts":[4,2,6]}},{"id":2,"image_id":1,"category_id":3,)" +
        R"("segmentation":[[1,1,3,1,3,3]]}]})";
    REQUIRE(read(folder, json).images.size() == 1);
    const auto try_to_read = [&](const std::string& text) {
        try {
            (void)ism::detail::dataset_from_json(ism::detail::parse_json(text, "text"), "a.json");
            return true;
        } catch (const FileError&) {
            return false;
        }
    };
    for (std::size_t count = 0; count < json.size(); ++count)
        REQUIRE_FALSE(try_to_read(json.substr(0, count)));
    int refused = 0;
    for (std::size_t i = 0; i < json.size(); ++i)
        for (const char c : {'\0', '"', '[', '{', '-', '9', 'x', '\xff'}) {
            std::string changed = json;
            changed[i] = c;
            refused += !try_to_read(changed);
        }
    CHECK(refused > int(json.size()) * 4);
}

TEST_CASE("A frame is read with its depth in metres and its camera") {
    const TemporaryFolder folder;
    Image<std::uint8_t> gray(20, 16);
    ism::RawDepth depth(20, 16);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 20; ++x)
            gray(x, y) = std::uint8_t(10 * x + y), depth(x, y) = std::uint16_t(100 * x + y);
    ism::write_png(folder / "a.png", gray);
    ism::write_png16(folder / "d.png", depth);
    DatasetImage image{.id = 1,
                       .file = folder / "a.png",
                       .depth_file = folder / "d.png",
                       .width = 20,
                       .height = 16,
                       .depth_scale = 0.002,
                       .camera = Camera{500, 500, 10, 8}};
    const ism::Frame frame = ism::read_frame(image);
    CHECK(frame.gray == ism::to_gray(gray));
    CHECK(frame.depth_m == ism::to_metres(depth, 0.002));
    CHECK(frame.camera == image.camera);

    image.objects = {{.id = 1, .class_index = 2, .box = {1, 2, 3, 4}, .crowd = true},
                     {.id = 2, .class_index = 1, .box = {1, 1, 2, 2}},
                     {.id = 3,
                      .class_index = 0,
                      .box = {0, 0, 20, 16},
                      .segmentation = ism::compress_mask(Mask(20, 16, 1))}};
    const ism::TrainingImage training = ism::read_training_image(image);
    REQUIRE(training.objects.size() == 2);
    CHECK((training.objects[0].class_index == 1 && training.objects[0].mask.empty()));
    CHECK((training.objects[1].class_index == 0 && training.objects[1].mask == Mask(20, 16, 1)));
    CHECK(training.objects[0].box == Box{1, 1, 2, 2});
    CHECK(training.name == (folder / "a.png").string());

    const std::string color_file = "file '" + (folder / "a.png").string() + "'";
    const std::string depth_file = "file '" + (folder / "d.png").string() + "'";
    const auto error = [&] {
        return error_message<FileError>([&] { (void)ism::read_training_image(image); });
    };
    image.objects[2].segmentation = ism::compress_mask(Mask(20, 15, 1));
    CHECK(error() == color_file + ", annotation 3: mask size: expected 20x16, got 20x15");
    image.objects[2].segmentation = ism::compress_mask(Mask(20, 16, 0));
    CHECK(error() == color_file + ", annotation 3: mask: expected at least one figure pixel, got none");
    image.objects.pop_back();
    ism::write_png16(folder / "d.png", ism::RawDepth(20, 16));
    CHECK(error() == "nothing thrown");
    CHECK(ism::read_frame(image).depth_m.empty());
    ism::write_png16(folder / "d.png", ism::RawDepth(20, 17, 1));
    CHECK(error() == depth_file + ": expected 20x16 pixels as its picture has, got 20x17");
    image.width = 21;
    CHECK(error() == color_file + ": expected 21x16 pixels as its data set says, got 20x16");
}

TEST_CASE("A data set is written to a bare file name, and its files are named from there") {
    const TemporaryFolder folder;
    const ism::test::WorkingFolder inside(folder.path());
    const Dataset dataset{.class_names = {"cup"},
                          .category_ids = {1},
                          .images = {{.id = 1, .file = "images/a.png", .width = 20, .height = 16}}};
    ism::write_dataset("out.json", dataset);
    CHECK(ism::read_text("out.json").find(R"("file_name":"images/a.png")") != std::string::npos);
    CHECK(ism::read_dataset("out.json").images == dataset.images);
}

TEST_CASE("A data set that is written comes back equal, in the same bytes every time") {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "labels");
    Mask mask(20, 16);
    mask(3, 4) = mask(4, 4) = mask(4, 5) = 1;
    Dataset dataset{.class_names = {"cup", "car \"x\" \xc3\xa9"}, .category_ids = {9, -1}};
    dataset.images = {{.id = 4,
                       .file = folder / "images/a.png",
                       .depth_file = folder / "d.png",
                       .width = 20,
                       .height = 16,
                       .depth_scale = 0.001,
                       .camera = Camera{525.25, 525, 9.5, 7.5}},
                      {.id = 2, .file = folder / "labels/b.png", .width = 30, .height = 20}};
    dataset.images[0].objects = {
        {.id = 3, .class_index = 1, .box = {3, 4, 2, 2}, .segmentation = ism::compress_mask(mask)},
        {.id = 1,
         .class_index = 0,
         .box = {-1.25, 0.1, 3, 1.0 / 3},
         .crowd = true,
         .position_m = ism::Point3{0.3, -1.0 / 3, 1.25}},
        {.id = 2,
         .class_index = 0,
         .box = {1, 1, 4, 4},
         .segmentation = std::vector<ism::Polygon>{{{1, 1}, {5, 1}, {1, 5.5}}}}};
    ism::write_dataset(folder / "labels/a.json", dataset);
    const Dataset read = ism::read_dataset(folder / "labels/a.json");
    CHECK(read.class_names == dataset.class_names);
    CHECK(read.category_ids == dataset.category_ids);
    REQUIRE(read.images.size() == 2);
    CHECK(read.images[0].objects == dataset.images[0].objects);
    CHECK(read.images[0].camera == dataset.images[0].camera);
    CHECK(read.images[0].file == folder / "labels/../images/a.png");
    CHECK(read.images[0].depth_file == folder / "labels/../d.png");
    CHECK(read.images[1] == dataset.images[1]);
    ism::write_dataset(folder / "labels/b.json", read);
    CHECK(ism::read_text(folder / "labels/b.json") == ism::read_text(folder / "labels/a.json"));
    CHECK(ism::read_text(folder / "labels/a.json").find(R"("area":3,"bbox":[3,4,2,2])") != std::string::npos);

    const std::string before = ism::read_text(folder / "labels/a.json");
    const auto error = [&] {
        return error_message<FileError>([&] { ism::write_dataset(folder / "labels/a.json", dataset); });
    };
    dataset.images[0].objects[1].id = 3;
    CHECK(error().ends_with("annotation with id 3: id: expected each id once, got it twice"));
    dataset.images[0].objects[1] = {.id = 8, .class_index = 2, .box = {1, 1, 1, 1}};
    CHECK(error().ends_with("annotation 8: class index: expected below 2, got 2"));
    dataset.images[0].objects[1] = {.id = 8, .box = {1, 1, ism::no_depth, 1}};
    CHECK(error().ends_with("bbox: expected a number, got null"));
    CHECK(ism::read_text(folder / "labels/a.json") == before);
}

TEST_CASE("Boxes that no object can have are refused with the annotation") {
    const std::string place =
        "file 'a.json', annotation with id 5 of image 1 ('images/a.png'): box: expected ";
    const auto error = [&](const std::string& box) { return read_error(annotation(",\"bbox\":" + box)); };
    CHECK(error("[0,10,1e9,1e-3]") == place + "sides of 0.1 to 200 pixels, got 1e+09x0.001");
    CHECK(error("[10,10,1e-200,1e-200]") == place + "sides of 0.1 to 200 pixels, got 1e-200x1e-200");
    CHECK(error("[0,10,2e7,1e-9]") == place + "sides of 0.1 to 200 pixels, got 2e+07x1e-09");
    CHECK(error("[0,10,150,0.1]") == place + "one side at most 1000 times the other, got 150x0.1");
    CHECK(error("[20,3,4,5]") == place + "a part in the image of 20x16, got 20, 3, 4, 5");
    CHECK(error("[19,15,4,5]") == "nothing thrown");
}

TEST_CASE("Classes selected keep their images and background alone, in the order asked for") {
    const auto image = [](std::int64_t id, std::vector<std::size_t> classes) {
        DatasetImage made{.id = id, .file = "a.png", .width = 20, .height = 16};
        for (const std::size_t c : classes)
            made.objects.push_back(
                {.id = 10 * id + std::int64_t(c), .class_index = std::uint32_t(c), .box = {1, 1, 2, 2}});
        return made;
    };
    const Dataset dataset{.class_names = {"cup", "car", "cow"},
                          .category_ids = {5, 6, 7},
                          .images = {image(1, {0, 2}), image(2, {1}), image(3, {}), image(4, {2, 1, 0})}};
    const Dataset part = ism::select_classes(dataset, std::vector<std::string>{"cow", "cup"});
    CHECK(part.class_names == std::vector<std::string>{"cow", "cup"});
    CHECK(part.category_ids == std::vector<std::int64_t>{7, 5});
    REQUIRE(part.images.size() == 3);
    CHECK(part.images[0].id == 1);
    CHECK(part.images[1].id == 3);
    CHECK(part.images[2].id == 4);
    REQUIRE(part.images[2].objects.size() == 2);
    CHECK((part.images[2].objects[0].id == 42 && part.images[2].objects[0].class_index == 0));
    CHECK((part.images[2].objects[1].id == 40 && part.images[2].objects[1].class_index == 1));

    const auto error = [&](std::vector<std::string> names) {
        return error_message([&] { (void)ism::select_classes(dataset, names); });
    };
    CHECK(error({"dog"}) == "class to select: expected one of: cup, car, cow, got 'dog'");
    CHECK(error({"cow", "cow"}) == "class to select: expected each name once, got 'cow' twice");
    CHECK(error({}) == "classes to select: expected at least one of: cup, car, cow, got none");
}

TEST_CASE("Without annotations, or without categories too, there are images alone") {
    const TemporaryFolder folder;
    const Dataset named = read(folder, "{" + categories + R"(,"images":[)" + image_1 + "]}");
    CHECK(named.class_names == std::vector<std::string>{"cup", "car"});
    REQUIRE(named.images.size() == 1);
    CHECK(named.images[0].objects.empty());
    CHECK(read(folder, R"({"images":[)" + image_1 + "]}").class_names.empty());
}

TEST_CASE("An empty category 0 that others name as their supercategory is no class") {
    const TemporaryFolder folder;
    const auto names = [&](const std::string& given, int category_of_object) {
        return read(folder, R"({"categories":[)" + given + R"(],"images":[)" + image_1 +
                                R"(],"annotations":[{"id":1,"image_id":1,"bbox":[1,2,3,4],"category_id":)" +
                                std::to_string(category_of_object) + "}]}")
            .class_names;
    };
    using Names = std::vector<std::string>;
    const std::string group = R"({"id":0,"name":"cars","supercategory":"none"},)";
    const std::string car = R"({"id":1,"name":"car","supercategory":"cars"})";
    CHECK(names(group + car, 1) == Names{"car"});
    CHECK(names(group + car, 0) == Names{"cars", "car"});  // it has an object: a class
    CHECK(names(group + R"({"id":1,"name":"car"})", 1) == Names{"cars", "car"});
    // also where the group is called as its class is
    CHECK(names(R"({"id":0,"name":"cars"},{"id":1,"name":"cars","supercategory":"cars"})", 1) ==
          Names{"cars"});
    CHECK(names(R"({"id":0,"name":"a","supercategory":"a"},{"id":1,"name":"b"})", 1) == Names{"a", "b"});
}

TEST_CASE("With a list of faults a bad annotation alone is left out") {
    const TemporaryFolder folder;
    ism::write_file(folder / "a.json",
                    with_annotations(R"({"id":1,"image_id":1,"category_id":3,"bbox":[1,2,3,4]},
        {"id":2,"image_id":1,"category_id":3,"bbox":[1,2,0,4]},
        {"id":3,"image_id":9,"category_id":3,"bbox":[1,2,3,4]},
        {"id":4,"image_id":1,"category_id":5,"bbox":[1,2,3,4]},
        {"id":5,"image_id":1,"category_id":3,"bbox":[1,2,3,4],"segmentation":[[1,2,3]]},
        {"id":1,"image_id":1,"category_id":3,"bbox":[1,2,3,4]}, 7,
        {"id":6,"image_id":1,"category_id":7,"segmentation":[[1,2,9,2,9,8]]})"));
    ism::Faults faults;
    const Dataset dataset = ism::read_dataset(folder / "a.json", &faults);
    REQUIRE(dataset.images[0].objects.size() == 2);
    CHECK(dataset.images[0].objects[1].id == 6);
    // What no label covers there may be what the bad ones told.
    const ism::DatasetImage& image = dataset.images[0];
    CHECK(image.incomplete);
    CHECK(ism::ignored_boxes(image) ==
          std::vector{ism::Box{0, 0, double(image.width), double(image.height)}});
    REQUIRE(faults.size() == 6);
    CHECK(faults[0].ends_with("bbox: expected a width and height above 0, got 0x4"));
    CHECK(faults[1].ends_with("annotation with id 3: image_id: expected the id of one of its images, got 9"));
    for (const std::string& fault : faults) CHECK(fault.find("a.json") != std::string::npos);
    CHECK(error_message<FileError>([&] { (void)ism::read_dataset(folder / "a.json"); }) == faults[0]);
}

TEST_CASE("File names count from the JSON's folder, or from where the first image is") {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "annotations");
    ism::write_file(folder / "annotations/a.json", "{" + categories + R"(,"images":[)" + image_1 + "]}");
    const auto file = [&] { return ism::read_dataset(folder / "annotations/a.json").images.at(0).file; };
    CHECK(file() == folder / "annotations/images/a.png");  // nowhere
    for (const char* name :
         {"images/images/a.png", "annotations/images/images/a.png", "annotations/images/a.png"}) {
        CAPTURE(name);
        std::filesystem::create_directories((folder / name).parent_path());
        ism::write_file(folder / name, std::string("x"));
        CHECK(file() == folder / name);
    }
}
